#include "Solvers/Kernels/ArrangedMatrix.h"
#include "Solvers/Kernels/SweepOrder.h"
#include "Solvers/Multigrid/Smoother.h"

#include "Support/DenseAlgebra.h"
#include "Support/GridProblem.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

template <class Scalar>
using Matrix = test::Dense<Scalar>;

/// The grid Laplacian in some order, with unit diagonal.
enum class Ordered
{
  ByTwoColours,  ///< a chessboard
  ByManyColours, ///< its square
  ByTiles,
  ByTilesOfPairs ///< two coupled unknowns at each place
};

template <class Scalar>
struct OrderedGrid
{
  OrderedGrid(int depth, Ordered ordered)
  {
    SparseMatrix<Scalar> A = test::MakeGridProblem<Scalar>(depth, 1).A / Scalar(4.0);
    if (ordered == Ordered::ByManyColours)
    {
      A = SparseMatrix<Scalar>(A * A).pruned();
      const Vector<Scalar> root = A.diagonal().cwiseSqrt().cwiseInverse();
      A = root.asDiagonal() * A * root.asDiagonal();
    }
    if (ordered == Ordered::ByTilesOfPairs)
    {
      A = InPairs(A);
    }
    const bool byTiles = ordered == Ordered::ByTiles || ordered == Ordered::ByTilesOfPairs;
    const SweepOrder order = byTiles ? Tiling(A) : Colouring(A);
    const std::vector<int> places = Inverse(order.Unknowns);
    this->A = Permuted(A, order.Unknowns, places, SerialContext());
    this->Parts.Begins = order.Begins;
    this->Parts.ColoursOfTiles = order.ColoursOfTiles;
    this->Parts.HavePairs = ordered == Ordered::ByTilesOfPairs;
    const Vector<double> ones = Vector<double>::Ones(A.rows());
    if (this->Parts.HavePairs)
    {
      ArrangePairs(A, order.Unknowns, places, ones, this->Parts.Lower, this->Parts.Upper, SerialContext());
    }
    else
    {
      this->Parts.Lower = this->A.template triangularView<Eigen::StrictlyLower>();
      this->Parts.Upper = this->A.template triangularView<Eigen::StrictlyUpper>();
    }
  }

  int Size() const { return static_cast<int>(this->A.rows()); }

  SparseMatrix<Scalar> A;
  TriangularParts<Scalar> Parts;

private:
  /// Each entry times a matrix of two rows, with ones on its diagonal.
  static SparseMatrix<Scalar> InPairs(const SparseMatrix<Scalar>& A)
  {
    std::vector<Eigen::Triplet<Scalar>> entries;
    for (int i = 0; i < A.rows(); ++i)
    {
      for (typename SparseMatrix<Scalar>::InnerIterator entry(A, i); entry; ++entry)
      {
        for (const int k : { 0, 1, 2, 3 })
        {
          const double coupling = k % 2 == k / 2 ? 1.0 : 0.3;
          entries.emplace_back(2 * i + k / 2, 2 * static_cast<int>(entry.col()) + k % 2, entry.value() * coupling);
        }
      }
    }
    return test::FromTriplets(2 * static_cast<int>(A.rows()), 2 * static_cast<int>(A.cols()), entries);
  }
};

constexpr Ordered AllOrders[] = { Ordered::ByTwoColours, Ordered::ByManyColours, Ordered::ByTiles,
  Ordered::ByTilesOfPairs };

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
class AnySmoother : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnySmoother, Scalars);

}

TYPED_TEST(AnySmoother, GaussSeidelSolvesTriangles)
{
  for (const auto& [ordered, sweeps] : { std::pair(Ordered::ByTwoColours, 0), std::pair(Ordered::ByTwoColours, 1),
         std::pair(Ordered::ByTwoColours, 2), std::pair(Ordered::ByTwoColours, 3), std::pair(Ordered::ByManyColours, 1),
         std::pair(Ordered::ByManyColours, 2), std::pair(Ordered::ByManyColours, 5), std::pair(Ordered::ByTiles, 0),
         std::pair(Ordered::ByTiles, 1), std::pair(Ordered::ByTiles, 2), std::pair(Ordered::ByTiles, 3),
         std::pair(Ordered::ByTilesOfPairs, 1), std::pair(Ordered::ByTilesOfPairs, 2) })
  {
    SCOPED_TRACE(static_cast<int>(ordered));
    SCOPED_TRACE(sweeps);
    const OrderedGrid<TypeParam> grid(4, ordered);
    ASSERT_EQ(grid.Parts.Begins.size() > 3u, ordered != Ordered::ByTwoColours);
    const auto b = test::RandomVector<TypeParam>(grid.Size(), 2801);
    const Matrix<TypeParam> A(grid.A);
    const Matrix<TypeParam> up = test::InverseOfLower(A);
    const Matrix<TypeParam> down = up.adjoint();
    const auto smoother = Smoother<TypeParam>::New(grid.Parts, { sweeps, sweeps });
    Vector<TypeParam> x = Vector<TypeParam>::Constant(grid.Size(), NaN); // whatever was there
    const Vector<TypeParam> r = smoother->PreSmooth(b, x, SerialContext());

    Vector<TypeParam> expected = Vector<TypeParam>::Zero(grid.Size());
    const auto sweepUp = [&] { expected += up * (b - A * expected); };
    const auto sweepDown = [&] { expected += down * (b - A * expected); };
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
    EXPECT_LE((x - expected).norm(), std::max(1, 2 * sweeps) * 20 * Epsilon * b.norm()); // each sweep rounds
  }
}

// With any diagonal, and without unknowns that are held.
TYPED_TEST(AnySmoother, WithADiagonalItIsGaussSeidelOfTheFreeUnknowns)
{
  const OrderedGrid<TypeParam> grid(4, Ordered::ByManyColours);
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
  const Matrix<TypeParam> up = test::InverseOfLower(A);
  const Matrix<TypeParam> down = up.adjoint();
  const auto withoutHeld = [&inverse](const Vector<TypeParam>& v)
  { return Vector<TypeParam>((inverse.array() > 0.0).template cast<TypeParam>() * v.array()); };
  const Vector<TypeParam> b = withoutHeld(test::RandomVector<TypeParam>(grid.Size(), 2803));
  for (const int sweeps : { 1, 2, 3 })
  {
    SCOPED_TRACE(sweeps);
    const auto smoother = Smoother<TypeParam>::NewWithDiagonal(grid.Parts, inverse, { sweeps, sweeps });
    Vector<TypeParam> x(grid.Size()), r(grid.Size());
    r = smoother->PreSmooth(b, x, SerialContext());
    Vector<TypeParam> expected = Vector<TypeParam>::Zero(grid.Size());
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      const Vector<TypeParam> residual = b - A * expected;
      expected += sweep % 2 == 0 ? up * residual : down * residual;
    }
    EXPECT_LE((x - expected).norm(), 20 * Epsilon * b.norm());
    EXPECT_LE((withoutHeld(r) - (b - A * expected)).norm(), 20 * Epsilon * b.norm());
  }
}

TYPED_TEST(AnySmoother, PostIsTheAdjointOfPre)
{
  for (const Ordered ordered : AllOrders)
  {
    const OrderedGrid<TypeParam> grid(4, ordered);
    const auto smoother = Smoother<TypeParam>::New(grid.Parts, { 3, 3 });
    const auto pre = Densified<TypeParam>(grid.Size(),
      [&](const Vector<TypeParam>& b, Vector<TypeParam>& x)
      {
        Vector<TypeParam> r(b.size());
        r = smoother->PreSmooth(b, x, SerialContext());
        const Vector<TypeParam> residual = b - grid.A * x;
        EXPECT_LE((r - residual).norm(), 20 * Epsilon);
      });
    const auto post = Densified<TypeParam>(grid.Size(),
      [&](const Vector<TypeParam>& b, Vector<TypeParam>& x) { smoother->PostSmooth(b, x, SerialContext()); });
    EXPECT_LE((post - pre.adjoint()).norm(), 20 * Epsilon * pre.norm());
  }
}

TYPED_TEST(AnySmoother, HasTheSameBitsForAnyNumberOfThreads)
{
  for (const Ordered ordered : AllOrders)
  {
    const OrderedGrid<TypeParam> grid(8, ordered);
    const auto b = test::RandomVector<TypeParam>(grid.Size(), 2802);
    std::vector<Vector<TypeParam>> results;
    for (const int threads : { 1, 2, 3, 8 })
    {
      const test::TbbContext context(threads);
      const auto smoother = Smoother<TypeParam>::New(grid.Parts, { 2, 2 });
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

TEST(Smoother, PairsAreTakenAtOnce)
{
  const OrderedGrid<double> grid(5, Ordered::ByTilesOfPairs);
  TriangularParts<float> parts;
  parts.Begins = grid.Parts.Begins;
  parts.ColoursOfTiles = grid.Parts.ColoursOfTiles;
  parts.HavePairs = true;
  parts.Lower = grid.Parts.Lower.cast<float>();
  parts.Upper = grid.Parts.Upper.cast<float>();
  const auto b = test::RandomVector<double>(grid.Size(), 2804);
  const auto exact = Smoother<double>::New(grid.Parts, {});
  const auto smoother = Smoother<float>::New(parts, {});
  Vector<double> expected(grid.Size());
  Vector<float> x(grid.Size());
  const Vector<double> expectedResidual = exact->PreSmooth(b, expected, SerialContext());
  const Vector<float> r = smoother->PreSmooth(b.cast<float>(), x, SerialContext());
  EXPECT_LE((x.cast<double>() - expected).norm(), 1e-6 * expected.norm());
  EXPECT_LE((r.cast<double>() - expectedResidual).norm(), 1e-6 * b.norm());
}
