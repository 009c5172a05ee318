#include "Solvers/BlockSmoother.h"

#include "GridProblem.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;

namespace
{

/// A sum of squares and blocks for it; columns of B have length 1.
struct Squares
{
  SparseMatrix<double> B;
  UnknownBlocks Blocks;

  int Size() const { return static_cast<int>(this->B.cols()); }
  Eigen::MatrixXd Matrix() const
  {
    const Eigen::MatrixXd B(this->B);
    return B.transpose() * B;
  }
};

SparseMatrix<double> WithUnitColumns(const SparseMatrix<double>& B)
{
  const SparseMatrix<double> squares = B.cwiseAbs2();
  const Vector<double> lengths = (squares.transpose() * Vector<double>::Ones(B.rows())).cwiseSqrt();
  return B * lengths.cwiseInverse().asDiagonal();
}

/// Differences of neighbours on a path of \p size unknowns, and the unknowns themselves with less
/// weight; blocks of four, each half of which the next one shares. \pre size is even, at least 4
Squares Path(int size)
{
  test::Random random(3101);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i)
  {
    const double weight = random.Uniform(0.2, 1.0);
    entries.emplace_back(i, i, -weight);
    entries.emplace_back(i, (i + 1) % size, weight);
    entries.emplace_back(size + i, i, random.Uniform(0.1, 0.3));
  }
  Squares path{ WithUnitColumns(test::FromTriplets(2 * size, size, entries)), {} };
  for (int first = 0; first + 4 <= size; first += 2)
  {
    for (int i = first; i < first + 4; ++i)
    {
      path.Blocks.Unknowns.push_back(i);
    }
    path.Blocks.EndBlock();
  }
  return path;
}

/// As around a vertex of \p blades faces: one square holds all unknowns, two per blade, so that no
/// two blocks are independent; others hold neighbours.
Squares Fan(int blades)
{
  test::Random random(3102);
  std::vector<Eigen::Triplet<double>> entries;
  const int size = 2 * blades;
  for (int i = 0; i < size; ++i)
  {
    entries.emplace_back(0, i, random.Uniform(-0.2, 0.2));
    entries.emplace_back(1 + i, i, 1.0);
    entries.emplace_back(1 + i, (i + 2) % size, random.Uniform(-0.8, 0.8));
  }
  Squares fan{ WithUnitColumns(test::FromTriplets(1 + size, size, entries)), {} };
  for (int blade = 0; blade < blades; ++blade)
  {
    fan.Blocks.Unknowns.push_back(2 * blade);
    fan.Blocks.Unknowns.push_back(2 * blade + 1);
    fan.Blocks.EndBlock();
  }
  return fan;
}

template <class Value>
Vector<Value> RandomVector(int size, unsigned seed)
{
  return test::RandomVector<double>(size, seed).cast<Value>();
}

template <class Value>
using Matrix = Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic>;

/// The matrix of what smooth(b, x) makes of b.
template <class Value, class Smooth>
Matrix<Value> Densified(int size, const Smooth& smooth)
{
  Matrix<Value> S(size, size);
  for (int j = 0; j < size; ++j)
  {
    const Vector<Value> b = Vector<Value>::Unit(size, j);
    Vector<Value> x = Vector<Value>::Zero(size);
    smooth(b, x);
    S.col(j) = x;
  }
  return S;
}

template <class Value>
class TestBlockSmoother : public ::testing::Test
{
protected:
  static constexpr double Epsilon = std::numeric_limits<Value>::epsilon();

  /// PreSmooth, its residual compared with b - A x, then PostSmooth.
  static void ExpectSymmetric(const Squares& squares, int sweeps)
  {
    BlockSmoother<Value> smoother(squares.B, squares.Blocks, sweeps, SerialContext());
    const Matrix<Value> A = squares.Matrix().cast<Value>();
    const auto pre = Densified<Value>(squares.Size(),
      [&](const Vector<Value>& b, Vector<Value>& x)
      {
        Vector<Value> r(b.size());
        smoother.PreSmooth(b, x, r, SerialContext());
        EXPECT_LE((r - (b - A * x)).norm(), 100 * Epsilon);
      });
    const auto post = Densified<Value>(squares.Size(),
      [&](const Vector<Value>& b, Vector<Value>& x)
      { smoother.PostSmooth(b, x, SerialContext()); });
    EXPECT_LE((post - pre.transpose()).norm(), 200 * Epsilon * pre.norm());
    const auto both = Densified<Value>(squares.Size(),
      [&](const Vector<Value>& b, Vector<Value>& x)
      {
        Vector<Value> r(b.size());
        smoother.PreSmooth(b, x, r, SerialContext());
        smoother.PostSmooth(b, x, SerialContext());
      });
    EXPECT_LE((both - both.transpose()).norm(), 200 * Epsilon * both.norm());
    const Eigen::SelfAdjointEigenSolver<Matrix<Value>> spectrum(both);
    EXPECT_GT(spectrum.eigenvalues().minCoeff(), 0.0);
  }
};
using Values = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TestBlockSmoother, Values);

}

TYPED_TEST(TestBlockSmoother, OneBlockIsTheInverse)
{
  Squares path = Path(12);
  path.Blocks = {};
  for (int i = 0; i < path.Size(); ++i)
  {
    path.Blocks.Unknowns.push_back((5 * i) % path.Size());
  }
  path.Blocks.EndBlock();
  const Eigen::MatrixXd A = path.Matrix();
  // A ridge of 1e-6 keeps the block invertible: each sweep leaves 1e-6 / lambda of an eigenvector.
  const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().minCoeff();
  ASSERT_GT(lowest, 5e-3);
  const Vector<double> exact = test::RandomVector<double>(path.Size(), 3103);
  const Vector<TypeParam> b = (A * exact).cast<TypeParam>();
  const double rounding = 20 * TestFixture::Epsilon / lowest;
  for (const int sweeps : { 1, 2, 3 })
  {
    BlockSmoother<TypeParam> smoother(path.B, path.Blocks, sweeps, SerialContext());
    Vector<TypeParam> x(path.Size()), r(path.Size());
    smoother.PreSmooth(b, x, r, SerialContext());
    const double ridge = std::pow(1e-6 / lowest, sweeps);
    EXPECT_LE((x.template cast<double>() - exact).norm(), (ridge + rounding) * exact.norm());
    EXPECT_LE(r.norm(), (ridge + rounding) * b.norm());
  }
}

TYPED_TEST(TestBlockSmoother, DisjointBlocksAreGaussSeidelByBlocks)
{
  // Blocks 0, 2, 4 share no square, nor do 1, 3, 5: two colours, each its blocks' inverses.
  Squares path = Path(12);
  path.Blocks = {};
  for (int i = 0; i < path.Size(); ++i)
  {
    path.Blocks.Unknowns.push_back(i);
    if (i % 2 == 1)
    {
      path.Blocks.EndBlock();
    }
  }
  const Eigen::MatrixXd A = path.Matrix();
  const Vector<double> b = test::RandomVector<double>(path.Size(), 3104);
  Vector<double> expected = Vector<double>::Zero(path.Size());
  for (const int parity : { 0, 1 })
  {
    for (int i = 2 * parity; i < path.Size(); i += 4)
    {
      const Vector<double> residual = b - A * expected;
      expected.segment<2>(i) += A.block<2, 2>(i, i).llt().solve(residual.segment<2>(i));
    }
  }
  BlockSmoother<TypeParam> smoother(path.B, path.Blocks, 1, SerialContext());
  Vector<TypeParam> x(path.Size()), r(path.Size());
  smoother.PreSmooth(b.cast<TypeParam>(), x, r, SerialContext());
  EXPECT_LE((x.template cast<double>() - expected).norm(), 1e-5 * expected.norm()); // the ridge
}

TYPED_TEST(TestBlockSmoother, PostIsTheAdjointOfPre)
{
  for (const int sweeps : { 1, 2, 3 })
  {
    SCOPED_TRACE(sweeps);
    this->ExpectSymmetric(Path(40), sweeps);
    this->ExpectSymmetric(Fan(20), sweeps);
    this->ExpectSymmetric(Fan(100), sweeps); // blocks without a colour, one after the other
  }
}

TYPED_TEST(TestBlockSmoother, SweepsReduceTheEnergyOfTheError)
{
  // Also where blocks run out of colours. Each step of a block minimises the energy over it.
  for (const Squares& squares : { Path(200), Fan(100) })
  {
    const Eigen::MatrixXd A = squares.Matrix();
    const Vector<double> exact = test::RandomVector<double>(squares.Size(), 3105);
    const Vector<TypeParam> b = (A * exact).cast<TypeParam>();
    double previous = exact.dot(A * exact);
    for (int sweeps = 1; sweeps <= 4; ++sweeps)
    {
      BlockSmoother<TypeParam> smoother(squares.B, squares.Blocks, sweeps, SerialContext());
      Vector<TypeParam> x(squares.Size()), r(squares.Size());
      smoother.PreSmooth(b, x, r, SerialContext());
      EXPECT_LE((r.template cast<double>() - A * (exact - x.template cast<double>())).norm(),
        50 * TestFixture::Epsilon * b.norm());
      const Vector<double> error = exact - x.template cast<double>();
      const double energy = error.dot(A * error);
      EXPECT_LT(energy, previous);
      previous = energy;
    }
  }
}

TYPED_TEST(TestBlockSmoother, SameBitsForAnyNumberOfThreads)
{
  // More blocks of a colour than a thread takes at once; and blocks without a colour.
  for (const Squares& squares : { Path(20000), Fan(150) })
  {
    const auto b = RandomVector<TypeParam>(squares.Size(), 3106);
    std::vector<Vector<TypeParam>> results;
    for (const int threads : { 1, 2, 5 })
    {
      const test::TbbContext context(threads);
      BlockSmoother<TypeParam> smoother(squares.B, squares.Blocks, 2, context);
      Vector<TypeParam> x(squares.Size()), r(squares.Size());
      smoother.PreSmooth(b, x, r, context);
      smoother.PostSmooth(b, x, context);
      Vector<TypeParam> both(2 * squares.Size());
      both << x, r;
      results.push_back(both);
    }
    ASSERT_TRUE(results[0].allFinite());
    for (const Vector<TypeParam>& result : results)
    {
      EXPECT_EQ(result, results[0]);
    }
  }
}

TYPED_TEST(TestBlockSmoother, UnknownsOutsideTheBlocksStay)
{
  Squares path = Path(12);
  path.Blocks.Unknowns.resize(4);
  path.Blocks.Offsets = { 0, 4 };
  BlockSmoother<TypeParam> smoother(path.B, path.Blocks, 2, SerialContext());
  const auto b = RandomVector<TypeParam>(12, 3107);
  Vector<TypeParam> x(12), r(12);
  smoother.PreSmooth(b, x, r, SerialContext());
  EXPECT_EQ(x.tail(8), Vector<TypeParam>::Zero(8));
  const auto start = RandomVector<TypeParam>(12, 3108);
  x = start;
  smoother.PostSmooth(b, x, SerialContext());
  EXPECT_EQ(x.tail(8), start.tail(8));
}
