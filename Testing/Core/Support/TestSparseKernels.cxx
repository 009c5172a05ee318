#include "Support/SparseKernels.h"

#include "Support/Errors.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <limits>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

Complex RandomNumber(test::Random& random, Complex*)
{
  return random.Number();
}

double RandomNumber(test::Random& random, double*)
{
  return random.Uniform(-1.0, 1.0);
}

/// Random entries, a few per row; some rows are empty.
template <class Scalar>
SparseMatrix<Scalar> RandomMatrix(int rows, int columns, unsigned seed)
{
  test::Random random(seed);
  std::vector<Eigen::Triplet<Scalar>> entries;
  for (int i = 0; i < rows; ++i)
  {
    for (int count = random.Index(6); count > 0; --count)
    {
      const Scalar value = RandomNumber(random, static_cast<Scalar*>(nullptr));
      entries.emplace_back(i, random.Index(columns), value);
    }
  }
  SparseMatrix<Scalar> A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

template <class Scalar>
Vector<Scalar> RandomVector(int size, unsigned seed)
{
  test::Random random(seed);
  Vector<Scalar> x(size);
  for (Scalar& number : x)
  {
    number = RandomNumber(random, static_cast<Scalar*>(nullptr));
  }
  return x;
}

template <class Scalar>
bool AreIdentical(const SparseMatrix<Scalar>& A, const SparseMatrix<Scalar>& B)
{
  return A.rows() == B.rows() && A.cols() == B.cols() && A.nonZeros() == B.nonZeros() &&
    std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.rows() + 1, B.outerIndexPtr()) &&
    std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr()) &&
    std::equal(A.valuePtr(), A.valuePtr() + A.nonZeros(), B.valuePtr());
}

template <class Scalar>
class AnySparseKernels : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnySparseKernels, Scalars);

}

TYPED_TEST(AnySparseKernels, MultiplyIsTheProductOfEigen)
{
  const auto A = RandomMatrix<TypeParam>(500, 300, 2601);
  const auto x = RandomVector<TypeParam>(300, 2602);
  Vector<TypeParam> y;
  Multiply(A, x, y, SerialContext());
  const Vector<TypeParam> expected = A * x;
  EXPECT_LE((y - expected).template lpNorm<Eigen::Infinity>(), 10 * Epsilon * A.norm());
}

TYPED_TEST(AnySparseKernels, AdjointIsThatOfEigen)
{
  for (const int rows : { 40, 9000 }) // the larger is worked on in bands
  {
    const auto A = RandomMatrix<TypeParam>(rows, 700, 2603);
    const SparseMatrix<TypeParam> expected = A.adjoint();
    EXPECT_TRUE(AreIdentical(Adjoint(A, test::TbbContext(3)), expected));
  }
}

TYPED_TEST(AnySparseKernels, SymmetricFromLowerIsTheWhole)
{
  for (const int rows : { 30, 9000 })
  {
    const auto some = RandomMatrix<TypeParam>(rows, rows, 2620);
    const SparseMatrix<TypeParam> expected = some + SparseMatrix<TypeParam>(some.adjoint());
    const SparseMatrix<TypeParam> lower = expected.template triangularView<Eigen::Lower>();
    EXPECT_TRUE(AreIdentical(SymmetricFromLower(lower, SerialContext()), expected));
    EXPECT_TRUE(AreIdentical(SymmetricFromLower(lower, test::TbbContext(3)), expected));
  }
}

TYPED_TEST(AnySparseKernels, AddInPatternIsTheSum)
{
  for (const int rows : { 0, 40, 9000 })
  {
    const auto A = RandomMatrix<TypeParam>(rows, 700, 2630);
    // Every third entry, some rows empty.
    SparseMatrix<TypeParam> B = A;
    int count = 0;
    B.prune([&count](Eigen::Index row, Eigen::Index, const TypeParam&) { return ++count % 3 == 0 && row % 5 != 2; });
    B *= 2.5;
    const SparseMatrix<TypeParam> expected = A + B;
    for (const int threads : { 1, 3 })
    {
      SparseMatrix<TypeParam> sum = A;
      AddInPattern(sum, B, test::TbbContext(threads));
      EXPECT_TRUE(AreIdentical(sum, expected));
    }
  }
}

TYPED_TEST(AnySparseKernels, PermutedMovesRowsAndColumns)
{
  const auto A = RandomMatrix<TypeParam>(50, 40, 2604);
  std::vector<int> rowOrder(50);
  for (int k = 0; k < 50; ++k)
  {
    rowOrder[k] = (7 * k + 3) % 50;
  }
  std::vector<int> columnPlaces(40);
  for (int j = 0; j < 40; ++j)
  {
    columnPlaces[j] = (11 * j + 5) % 40;
  }
  const auto B = Permuted(A, rowOrder, columnPlaces, SerialContext());
  ASSERT_EQ(A.nonZeros(), B.nonZeros());
  for (int k = 0; k < 50; ++k)
  {
    for (int j = 0; j < 40; ++j)
    {
      EXPECT_EQ(B.coeff(k, columnPlaces[j]), A.coeff(rowOrder[k], j));
    }
  }
}

TYPED_TEST(AnySparseKernels, TripleProductIsTheProductOfEigen)
{
  const auto R = RandomMatrix<TypeParam>(1300, 2000, 2605); // three bands
  const auto A = RandomMatrix<TypeParam>(2000, 1500, 2606);
  const auto P = RandomMatrix<TypeParam>(1500, 900, 2607);
  const auto C = TripleProduct(R, A, P, SerialContext());

  const SparseMatrix<TypeParam> AP = A * P;
  const SparseMatrix<TypeParam> expected = R * AP;
  EXPECT_EQ(C.nonZeros(), expected.nonZeros());
  EXPECT_LE((C - expected).norm(), 10 * Epsilon * R.norm() * AP.norm());
  for (int i = 0; i < C.rows(); ++i)
  {
    for (int k = C.outerIndexPtr()[i] + 1; k < C.outerIndexPtr()[i + 1]; ++k)
    {
      ASSERT_LT(C.innerIndexPtr()[k - 1], C.innerIndexPtr()[k]) << "columns of row " << i;
    }
  }
}

TYPED_TEST(AnySparseKernels, ProductIsThatOfEigen)
{
  const auto A = RandomMatrix<TypeParam>(1300, 2000, 2613); // three bands
  const auto B = RandomMatrix<Complex>(2000, 900, 2614);
  const SparseMatrix<Complex> C = Product(A, B, SerialContext());
  const SparseMatrix<Complex> expected = SparseMatrix<Complex>(A.template cast<Complex>()) * B;
  EXPECT_EQ(C.nonZeros(), expected.nonZeros());
  EXPECT_LE((C - expected).norm(), 10 * Epsilon * A.norm() * B.norm());
  for (int i = 0; i < C.rows(); ++i)
  {
    for (int k = C.outerIndexPtr()[i] + 1; k < C.outerIndexPtr()[i + 1]; ++k)
    {
      ASSERT_LT(C.innerIndexPtr()[k - 1], C.innerIndexPtr()[k]) << "columns of row " << i;
    }
  }
}

TYPED_TEST(AnySparseKernels, NormalMatrixIsThatOfEigen)
{
  for (const int columns : { 30, 1300 }) // the larger is worked on in bands
  {
    const auto B = RandomMatrix<TypeParam>(2 * columns, columns, 2615);
    const SparseMatrix<TypeParam> A = NormalMatrix(B, SerialContext());
    const SparseMatrix<TypeParam> adjoint = B.adjoint();
    const SparseMatrix<TypeParam> expected = adjoint * B;
    EXPECT_EQ(A.nonZeros(), expected.nonZeros());
    EXPECT_LE((A - expected).norm(), 10 * Epsilon * B.squaredNorm());
    const SparseMatrix<TypeParam> transposed = A.adjoint();
    EXPECT_LE((A - transposed).norm(), 10 * Epsilon * A.norm());
    EXPECT_GE(A.diagonal().real().minCoeff(), 0.0);
  }
}

TYPED_TEST(AnySparseKernels, SumsAreThoseOfLongDouble)
{
  const auto x = RandomVector<TypeParam>(10000, 2608);
  const auto y = RandomVector<TypeParam>(10000, 2609);
  std::complex<long double> dot = 0;
  long double squaredNorm = 0;
  for (int i = 0; i < 10000; ++i)
  {
    const std::complex<long double> a(x[i]);
    dot += std::conj(a) * std::complex<long double>(y[i]);
    squaredNorm += std::norm(a);
  }
  const double scale = 10000 * Epsilon * x.norm() * y.norm();
  EXPECT_LE(std::abs(Complex(dot) - Complex(Dot(x, y, SerialContext()))), scale);
  EXPECT_NEAR(static_cast<double>(squaredNorm), SquaredNorm(x, SerialContext()), 10000 * Epsilon * x.squaredNorm());
}

TYPED_TEST(AnySparseKernels, HasTheSameBitsForAnyNumberOfThreads)
{
  const auto A = RandomMatrix<TypeParam>(30000, 30000, 2610);
  const auto P = RandomMatrix<TypeParam>(30000, 6000, 2611);
  const auto x = RandomVector<TypeParam>(30000, 2612);
  const SerialContext serial;
  const SparseMatrix<TypeParam> R = Adjoint(P, serial);
  const SparseMatrix<TypeParam> C = TripleProduct(R, A, P, serial);
  const SparseMatrix<TypeParam> normal = NormalMatrix(P, serial);
  const auto Q = RandomMatrix<Complex>(30000, 6000, 2616);
  const SparseMatrix<Complex> product = Product(A, Q, serial);
  Vector<TypeParam> y;
  Multiply(A, x, y, serial);
  for (const int threads : { 1, 2, 3, 8 })
  {
    SCOPED_TRACE(threads);
    const test::TbbContext context(threads);
    EXPECT_TRUE(AreIdentical(R, Adjoint(P, context)));
    EXPECT_TRUE(AreIdentical(C, TripleProduct(R, A, P, context)));
    EXPECT_TRUE(AreIdentical(normal, NormalMatrix(P, context)));
    EXPECT_TRUE(AreIdentical(product, Product(A, Q, context)));
    Vector<TypeParam> z;
    Multiply(A, x, z, context);
    EXPECT_EQ(y, z);
    EXPECT_EQ(Dot(x, y, serial), Dot(x, y, context));
    EXPECT_EQ(SquaredNorm(x, serial), SquaredNorm(x, context));
  }
}

TEST(Offsets, CountsThatDoNotFitAreRefused)
{
  std::vector<int> counts = { 0, 2, 0, 3 };
  EXPECT_EQ(OffsetsFromCounts(counts), 5);
  EXPECT_EQ(counts, (std::vector<int>{ 0, 2, 2, 5 }));
  counts = { 0, std::numeric_limits<int>::max(), 1 };
  EXPECT_THROW(OffsetsFromCounts(counts), InvalidInput);
}

TEST(Offsets, RowsGetTheRoomTheyAskFor)
{
  constexpr int rows = 40000;
  SparseMatrix<Complex> matrix(rows, 3);
  MakeRoom(matrix, test::TbbContext(3), [](int row) { return row % 4; });
  for (int row = 0; row < rows; ++row)
  {
    // 0 + 1 + 2 + 3 in each four rows.
    ASSERT_EQ(matrix.outerIndexPtr()[row], row / 4 * 6 + row % 4 * (row % 4 - 1) / 2);
  }
  EXPECT_EQ(matrix.outerIndexPtr()[rows], rows / 4 * 6);
  EXPECT_EQ(matrix.nonZeros(), rows / 4 * 6);
}

TEST(Pairs, AreAnEvenColumnAndTheNext)
{
  const auto matrixOf = [](std::vector<std::pair<int, int>> places)
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [row, column] : places)
    {
      entries.emplace_back(row, column, 1.0);
    }
    SparseMatrix<double> matrix(3, 8);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  };
  EXPECT_TRUE(HasPairs(matrixOf({})));
  EXPECT_TRUE(HasPairs(matrixOf({ { 0, 2 }, { 0, 3 }, { 2, 0 }, { 2, 1 }, { 2, 6 }, { 2, 7 } })));
  EXPECT_FALSE(HasPairs(matrixOf({ { 0, 2 }, { 0, 3 }, { 2, 1 }, { 2, 2 } })));
  EXPECT_FALSE(HasPairs(matrixOf({ { 0, 2 }, { 0, 4 } })));
  EXPECT_FALSE(HasPairs(matrixOf({ { 0, 2 }, { 0, 3 }, { 0, 4 } })));
}
