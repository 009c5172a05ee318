#include "Solvers/Smoother.h"

#include "GridProblem.h"
#include "Support/SparseKernels.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// The grid Laplacian by colours, with unit diagonal: a chessboard; its square has more colours.
template <class Scalar>
struct ColouredGrid
{
  explicit ColouredGrid(int depth, bool isSquared = false)
  {
    SparseMatrix<Scalar> A = test::MakeGridProblem<Scalar>(depth, 1).A / Scalar(4.0);
    if (isSquared)
    {
      A = SparseMatrix<Scalar>(A * A).pruned();
      const Vector<Scalar> root = A.diagonal().cwiseSqrt().cwiseInverse();
      A = root.asDiagonal() * A * root.asDiagonal();
    }
    const ColourOrder order = Colouring(A);
    std::vector<int> places(order.Unknowns.size());
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      places[order.Unknowns[k]] = static_cast<int>(k);
    }
    this->A = Permuted(A, order.Unknowns, places, SerialContext());
    this->Parts.Begins = order.Begins;
    this->Parts.Lower = this->A.template triangularView<Eigen::StrictlyLower>();
    this->Parts.Upper = this->A.template triangularView<Eigen::StrictlyUpper>();
  }

  int Size() const { return static_cast<int>(this->A.rows()); }

  SparseMatrix<Scalar> A;
  TriangularParts<Scalar> Parts;
};

/// B of x = B b, column by column, where smooth(b, x) starts from x = 0.
template <class Scalar, class Smooth>
Matrix<Scalar> Densified(int size, const Smooth& smooth)
{
  Matrix<Scalar> B(size, size);
  for (int j = 0; j < size; ++j)
  {
    const Vector<Scalar> b = Vector<Scalar>::Unit(size, j);
    Vector<Scalar> x = Vector<Scalar>::Zero(size);
    smooth(b, x);
    B.col(j) = x;
  }
  return B;
}

template <class Scalar>
class TestSmoother : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(TestSmoother, Scalars);

}

TYPED_TEST(TestSmoother, ColoursSeparateNeighbours)
{
  const SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(5, 1).A;
  const SparseMatrix<TypeParam> wider = A * A; // neighbours of neighbours
  for (const SparseMatrix<TypeParam>& matrix : { A, wider })
  {
    const ColourOrder order = Colouring(matrix);
    std::vector<int> sorted = order.Unknowns;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> colours(matrix.rows());
    for (int i = 0; i < matrix.rows(); ++i)
    {
      ASSERT_EQ(sorted[i], i);
    }
    for (std::size_t colour = 0; colour + 1 < order.Begins.size(); ++colour)
    {
      ASSERT_LT(order.Begins[colour], order.Begins[colour + 1]);
      for (int k = order.Begins[colour]; k < order.Begins[colour + 1]; ++k)
      {
        colours[order.Unknowns[k]] = static_cast<int>(colour);
      }
    }
    ASSERT_EQ(order.Begins.back(), matrix.rows());
    for (int i = 0; i < matrix.rows(); ++i)
    {
      for (typename SparseMatrix<TypeParam>::InnerIterator entry(matrix, i); entry; ++entry)
      {
        EXPECT_TRUE(entry.col() == i || colours[entry.col()] != colours[i]);
      }
    }
  }
  EXPECT_EQ(Colouring(A).Begins.size(), 3u) << "a chessboard has two colours";
}

TYPED_TEST(TestSmoother, GaussSeidelSolvesTriangles)
{
  for (const auto& [isSquared, sweeps] : std::vector<std::pair<bool, int>>{
         { false, 0 }, { false, 1 }, { false, 2 }, { false, 3 }, { true, 1 }, { true, 2 }, { true, 5 } })
  {
    SCOPED_TRACE(sweeps);
    const ColouredGrid<TypeParam> grid(4, isSquared);
    ASSERT_EQ(grid.Parts.Begins.size() > 4u, isSquared);
    const auto b = test::RandomVector<TypeParam>(grid.Size(), 2801);
    const Matrix<TypeParam> A(grid.A);
    const auto smoother = Smoother<TypeParam>::New(
      grid.Parts, { SmootherKind::GaussSeidel, sweeps, sweeps }, SerialContext());
    Vector<TypeParam> x(grid.Size()), r(grid.Size());
    r = smoother->PreSmooth(b, x, SerialContext());

    Vector<TypeParam> expected = Vector<TypeParam>::Zero(grid.Size());
    const auto sweepUp = [&]
    { expected += A.template triangularView<Eigen::Lower>().solve(b - A * expected); };
    const auto sweepDown = [&]
    { expected += A.template triangularView<Eigen::Upper>().solve(b - A * expected); };
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      sweep % 2 == 0 ? sweepUp() : sweepDown();
    }
    EXPECT_LE((x - expected).norm(), 20 * Epsilon * b.norm());
    EXPECT_LE((r - (b - A * expected)).norm(), 20 * Epsilon * b.norm());

    for (int sweep = sweeps; sweep-- > 0;) // the last one before the correction is answered first
    {
      sweep % 2 == 0 ? sweepDown() : sweepUp();
    }
    smoother->PostSmooth(b, x, SerialContext());
    EXPECT_LE((x - expected).norm(), 20 * Epsilon * b.norm());
  }
}

// With any diagonal, and without unknowns that are held.
TYPED_TEST(TestSmoother, WithDiagonalIsGaussSeidelOfTheFreeUnknowns)
{
  const ColouredGrid<TypeParam> grid(4, true);
  Vector<double> inverse(grid.Size());
  Matrix<TypeParam> A(grid.A);
  for (int i = 0; i < grid.Size(); ++i)
  {
    inverse[i] = i % 7 == 2 ? 0.0 : 1.0 / (1.0 + i % 3);
    A(i, i) = i % 7 == 2 ? 1.0 : 1.0 + i % 3;
    if (i % 7 == 2)
    {
      A.row(i).head(i).setZero();
      A.row(i).tail(grid.Size() - 1 - i).setZero();
      A.col(i).head(i).setZero();
      A.col(i).tail(grid.Size() - 1 - i).setZero();
    }
  }
  const auto withoutHeld = [&inverse](const Vector<TypeParam>& v) {
    return Vector<TypeParam>((inverse.array() > 0.0).template cast<TypeParam>() * v.array());
  };
  const Vector<TypeParam> b = withoutHeld(test::RandomVector<TypeParam>(grid.Size(), 2803));
  for (const int sweeps : { 1, 2, 3 })
  {
    SCOPED_TRACE(sweeps);
    const auto smoother = Smoother<TypeParam>::NewWithDiagonal(
      grid.Parts, inverse, { SmootherKind::GaussSeidel, sweeps, sweeps });
    Vector<TypeParam> x(grid.Size()), r(grid.Size());
    r = smoother->PreSmooth(b, x, SerialContext());
    Vector<TypeParam> expected = Vector<TypeParam>::Zero(grid.Size());
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      const Vector<TypeParam> residual = b - A * expected;
      expected += sweep % 2 == 0
        ? Vector<TypeParam>(A.template triangularView<Eigen::Lower>().solve(residual))
        : Vector<TypeParam>(A.template triangularView<Eigen::Upper>().solve(residual));
    }
    EXPECT_LE((x - expected).norm(), 20 * Epsilon * b.norm());
    EXPECT_LE((withoutHeld(r) - (b - A * expected)).norm(), 20 * Epsilon * b.norm());
  }
}

TEST(TestChebyshevSmoother, LeavesThePolynomialOfLottes)
{
  // On an eigenvector the error is multiplied by W_k(1 - 2 t) / (2 k + 1), where t is the eigenvalue
  // over the upper bound and W_k Chebyshev's polynomial of the fourth kind,
  // W_k(cos s) = sin((k + 1/2) s) / sin(s / 2). The bound is the row sum, 2, for these grids.
  const ColouredGrid<double> grid(4);
  const Eigen::SelfAdjointEigenSolver<Matrix<double>> modes{ Matrix<double>(grid.A) };
  for (const int degree : { 1, 2, 3, 4 })
  {
    SCOPED_TRACE(degree);
    const auto smoother = Smoother<double>::New(
      grid.Parts, { SmootherKind::Chebyshev, degree, degree }, SerialContext());
    for (const int mode : { 0, 5, 100, grid.Size() - 1 })
    {
      const double eigenvalue = modes.eigenvalues()[mode];
      const Vector<double> b = modes.eigenvectors().col(mode);
      Vector<double> x(grid.Size()), r(grid.Size());
      r = smoother->PreSmooth(b, x, SerialContext());
      const double angle = std::acos(1.0 - 2.0 * eigenvalue / 2.0);
      const double factor =
        std::sin((degree + 0.5) * angle) / std::sin(angle / 2.0) / (2.0 * degree + 1.0);
      EXPECT_LE((r - factor * b).norm(), 500 * Epsilon);
      EXPECT_LE((x - (1.0 - factor) / eigenvalue * b).norm(), 500 * Epsilon / eigenvalue);
    }
  }
}

TYPED_TEST(TestSmoother, PostIsTheAdjointOfPre)
{
  const ColouredGrid<TypeParam> grid(4);
  for (const SmootherKind kind : { SmootherKind::GaussSeidel, SmootherKind::Chebyshev })
  {
    const auto smoother = Smoother<TypeParam>::New(grid.Parts, { kind, 3, 3 }, SerialContext());
    const auto pre = Densified<TypeParam>(grid.Size(),
      [&](const Vector<TypeParam>& b, Vector<TypeParam>& x)
      {
        Vector<TypeParam> r(b.size());
        r = smoother->PreSmooth(b, x, SerialContext());
        const Vector<TypeParam> residual = b - grid.A * x;
        EXPECT_LE((r - residual).norm(), 20 * Epsilon);
      });
    const auto post = Densified<TypeParam>(grid.Size(),
      [&](const Vector<TypeParam>& b, Vector<TypeParam>& x)
      { smoother->PostSmooth(b, x, SerialContext()); });
    EXPECT_LE((post - pre.adjoint()).norm(), 20 * Epsilon * pre.norm());
  }
}

TYPED_TEST(TestSmoother, SameBitsForAnyNumberOfThreads)
{
  const ColouredGrid<TypeParam> grid(8);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 2802);
  for (const SmootherKind kind : { SmootherKind::GaussSeidel, SmootherKind::Chebyshev })
  {
    std::vector<Vector<TypeParam>> results;
    for (const int threads : { 1, 2, 3, 8 })
    {
      const test::TbbContext context(threads);
      const auto smoother = Smoother<TypeParam>::New(grid.Parts, { kind, 2, 2 }, context);
      Vector<TypeParam> x(grid.Size()), r(grid.Size());
      r = smoother->PreSmooth(b, x, context);
      smoother->PostSmooth(b, x, context);
      results.push_back(x + r);
    }
    for (const Vector<TypeParam>& result : results)
    {
      EXPECT_EQ(result, results[0]);
    }
  }
}
