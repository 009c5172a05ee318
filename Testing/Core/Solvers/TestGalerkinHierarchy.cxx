#include "Solvers/Multigrid/GalerkinHierarchy.h"

#include "Solvers/Multigrid/SmoothedProlongation.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
bool AreIdentical(const SparseMatrix<Scalar>& A, const SparseMatrix<Scalar>& B)
{
  return A.nonZeros() == B.nonZeros() &&
    std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.rows() + 1, B.outerIndexPtr()) &&
    std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr()) &&
    std::equal(A.valuePtr(), A.valuePtr() + A.nonZeros(), B.valuePtr());
}

template <class Scalar>
class AnyGalerkinHierarchy : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyGalerkinHierarchy, Scalars);

}

TYPED_TEST(AnyGalerkinHierarchy, CoarseMatricesAreGalerkinProducts)
{
  const auto problem = test::MakeGridProblem<TypeParam>(6, 4);
  const GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  ASSERT_EQ(hierarchy.NumberOfLevels(), 4);
  SparseMatrix<TypeParam> A = problem.A;
  for (int level = 0; level < 3; ++level)
  {
    // In the order of the hierarchy, by Eigen's products.
    const SparseMatrix<TypeParam>& P = hierarchy.Prolongation(level);
    const SparseMatrix<TypeParam> AP = hierarchy.Matrix(level) * P;
    const SparseMatrix<TypeParam> expected = SparseMatrix<TypeParam>(P.adjoint()) * AP;
    EXPECT_LE((hierarchy.Matrix(level + 1) - expected).norm(), 50 * Epsilon * expected.norm());

    // The order changes neither sizes nor norms.
    A = SparseMatrix<TypeParam>(problem.P[level].adjoint()) * SparseMatrix<TypeParam>(A * problem.P[level]);
    EXPECT_EQ(A.rows(), hierarchy.NumberOfUnknowns(level + 1));
    EXPECT_NEAR(A.norm(), expected.norm(), 50 * Epsilon * A.norm());
    EXPECT_EQ(hierarchy.Levels()[level + 1].NonZeros, A.nonZeros());
    EXPECT_EQ(hierarchy.Levels()[level + 1].Unknowns, A.rows());
  }
}

TYPED_TEST(AnyGalerkinHierarchy, OrderIsAPermutation)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 3);
  const GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const std::vector<int>& order = hierarchy.FinestOrder();
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < problem.A.rows(); ++i)
  {
    ASSERT_EQ(sorted[i], i);
    for (int j = 0; j < problem.A.rows(); ++j)
    {
      EXPECT_EQ(hierarchy.Matrix(0).coeff(i, j), problem.A.coeff(order[i], order[j]));
    }
  }
}

TYPED_TEST(AnyGalerkinHierarchy, ChildrenFollowEachOther)
{
  // Aggregation: unknown i has the parent i mod 8, so the order must gather what is 8 apart.
  SparseMatrix<TypeParam> A(64, 64);
  A.setIdentity();
  std::vector<Eigen::Triplet<TypeParam>> entries;
  for (int i = 0; i < 64; ++i)
  {
    entries.emplace_back(i, i % 8, TypeParam(1.0));
  }
  const GalerkinHierarchy<TypeParam> hierarchy(A, { test::FromTriplets(64, 8, entries) }, {}, SerialContext());
  for (int i = 0; i < 64; ++i)
  {
    EXPECT_EQ(hierarchy.Prolongation(0).innerIndexPtr()[i], i / 8);
  }
}

TYPED_TEST(AnyGalerkinHierarchy, PairsStayTogether)
{
  // Pair k takes from pair k mod 4, each unknown most from the other component: alone, the two would part.
  SparseMatrix<TypeParam> A(64, 64);
  A.setIdentity();
  std::vector<Eigen::Triplet<TypeParam>> entries;
  for (int i = 0; i < 64; ++i)
  {
    const int parent = i / 2 % 4 * 2;
    entries.emplace_back(i, parent, TypeParam(i % 2 == 0 ? 0.5 : 1.0));
    entries.emplace_back(i, parent + 1, TypeParam(i % 2 == 0 ? 1.0 : 0.5));
  }
  const GalerkinHierarchy<TypeParam> hierarchy(A, { test::FromTriplets(64, 8, entries) }, {}, SerialContext());
  const std::vector<int>& order = hierarchy.FinestOrder();
  for (int i = 0; i < 64; i += 2)
  {
    EXPECT_EQ(order[i] % 2, 0);
    EXPECT_EQ(order[i + 1], order[i] + 1);
    EXPECT_EQ(hierarchy.Prolongation(0).innerIndexPtr()[2 * i], i / 16 * 2);
  }
}

TYPED_TEST(AnyGalerkinHierarchy, UpdateHasTheBitsOfANewHierarchy)
{
  auto problem = test::MakeGridProblem<TypeParam>(6, 4);
  GalerkinHierarchy<TypeParam> updated(problem.A, problem.P, {}, SerialContext());
  for (int i = 0; i < problem.A.rows(); i += 7)
  {
    problem.A.coeffRef(i, i) += 0.3;
  }
  const long long bytes = updated.Bytes();
  updated.ForgetMatrices();
  EXPECT_LT(updated.Bytes(), bytes);
  updated.Update(problem.A, SerialContext());
  EXPECT_EQ(updated.Bytes(), bytes);
  GalerkinHierarchy<TypeParam> fresh(problem.A, problem.P, {}, SerialContext());
  for (int level = 0; level < 4; ++level)
  {
    EXPECT_TRUE(AreIdentical(updated.Matrix(level), fresh.Matrix(level)));
    EXPECT_EQ(updated.Diagonal(level), fresh.Diagonal(level));
  }
  const auto b = test::RandomVector<TypeParam>(updated.NumberOfUnknowns(3), 2902);
  Vector<TypeParam> x, y;
  updated.CoarsestSolver().Solve(b, x);
  fresh.CoarsestSolver().Solve(b, y);
  EXPECT_EQ(x, y);

  // A matrix that is given away comes back empty, and makes no difference.
  SparseMatrix<TypeParam> given = problem.A;
  GalerkinHierarchy<TypeParam> owner(std::move(given), problem.P, {}, SerialContext());
  EXPECT_EQ(given.nonZeros(), 0);
  given = problem.A;
  updated.Update(std::move(given), SerialContext());
  EXPECT_EQ(given.nonZeros(), 0);
  for (int level = 0; level < 4; ++level)
  {
    EXPECT_TRUE(AreIdentical(owner.Matrix(level), fresh.Matrix(level)));
    EXPECT_TRUE(AreIdentical(updated.Matrix(level), fresh.Matrix(level)));
  }
}

TYPED_TEST(AnyGalerkinHierarchy, HasTheSameBitsForAnyNumberOfThreads)
{
  const auto problem = test::MakeGridProblem<TypeParam>(8, 4);
  const GalerkinHierarchy<TypeParam> serial(problem.A, problem.P, {}, SerialContext());
  for (const int threads : { 1, 2, 3, 8 })
  {
    const GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, test::TbbContext(threads));
    for (int level = 0; level < 4; ++level)
    {
      EXPECT_TRUE(AreIdentical(serial.Matrix(level), hierarchy.Matrix(level)));
    }
  }
}

TYPED_TEST(AnyGalerkinHierarchy, UnknownsThatNothingSeesAreInactive)
{
  // Two unknowns are added to the coarse level: one without children, and one that carries the
  // kernel of a piece of the fine level, of energy zero up to rounding.
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  const int fine = static_cast<int>(problem.A.rows());
  const int coarse = static_cast<int>(problem.P[0].cols());
  std::vector<Eigen::Triplet<TypeParam>> entries, transfers;
  for (int i = 0; i < fine; ++i)
  {
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(problem.A, i); entry; ++entry)
    {
      entries.emplace_back(i, entry.col(), entry.value());
    }
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(problem.P[0], i); entry; ++entry)
    {
      transfers.emplace_back(i, entry.col(), entry.value());
    }
  }
  // A path of three with random weights: its Laplacian does not sum to zero exactly.
  entries.emplace_back(fine, fine, TypeParam(0.1));
  entries.emplace_back(fine, fine + 1, TypeParam(-0.1));
  entries.emplace_back(fine + 1, fine, TypeParam(-0.1));
  entries.emplace_back(fine + 1, fine + 1, TypeParam(0.1 + 0.7));
  entries.emplace_back(fine + 1, fine + 2, TypeParam(-0.7));
  entries.emplace_back(fine + 2, fine + 1, TypeParam(-0.7));
  entries.emplace_back(fine + 2, fine + 2, TypeParam(0.7));
  for (int i = 0; i < 3; ++i)
  {
    transfers.emplace_back(fine + i, coarse + 1, TypeParam(1.0 / 3.0));
  }
  GalerkinHierarchy<TypeParam> hierarchy(test::FromTriplets(fine + 3, fine + 3, entries),
    { test::FromTriplets(fine + 3, coarse + 2, transfers) }, {}, SerialContext());
  const Vector<double>& diagonal = hierarchy.Diagonal(1);
  EXPECT_EQ(diagonal[coarse], 0.0);
  EXPECT_EQ(diagonal[coarse + 1], 0.0);
  EXPECT_GT(diagonal.head(coarse).minCoeff(), 0.0);

  // The factor exists, and unknowns with zero right-hand side stay out of the solution.
  Vector<TypeParam> b = test::RandomVector<TypeParam>(coarse + 2, 2903);
  b.tail(2).setZero();
  Vector<TypeParam> x;
  hierarchy.CoarsestSolver().Solve(b, x);
  EXPECT_EQ(x[coarse], TypeParam(0.0));
  EXPECT_EQ(x[coarse + 1], TypeParam(0.0));
}

TYPED_TEST(AnyGalerkinHierarchy, TheFinestProlongationCanBeSmoothed)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  GalerkinOptions options;
  options.FinestProlongationSteps = 2;
  const GalerkinHierarchy<TypeParam> plain(problem.A, problem.P, {}, SerialContext());
  const GalerkinHierarchy<TypeParam> smoothed(problem.A, problem.P, options, SerialContext());
  SparseMatrix<TypeParam> expected = plain.Prolongation(0);
  SmoothProlongation(plain.Matrix(0), expected, 2, SerialContext());
  EXPECT_TRUE(AreIdentical(smoothed.Prolongation(0), expected));
  EXPECT_TRUE(AreIdentical(smoothed.Prolongation(1), plain.Prolongation(1)));
}

TYPED_TEST(AnyGalerkinHierarchy, SizesMustChain)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  EXPECT_THROW(GalerkinHierarchy<TypeParam>(problem.A, { problem.P[1] }, {}, SerialContext()), InvalidInput);
  EXPECT_THROW(GalerkinHierarchy<TypeParam>(problem.P[0], {}, {}, SerialContext()), InvalidInput);
}

TYPED_TEST(AnyGalerkinHierarchy, NegativeOrInfiniteDiagonalsAreNamed)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  for (const double value : { -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    SparseMatrix<TypeParam> A = problem.A;
    A.coeffRef(17, 17) = value;
    try
    {
      GalerkinHierarchy<TypeParam> hierarchy(A, problem.P, {}, SerialContext());
      FAIL() << value << " was accepted";
    }
    catch (const SolverFailure& failure)
    {
      EXPECT_NE(std::string(failure.what()).find("entry 17 on level 0"), std::string::npos) << failure.what();
    }
  }
}

TYPED_TEST(AnyGalerkinHierarchy, CanBeCancelledAtEveryCheckpoint)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  const test::TbbContext all(2);
  GalerkinHierarchy<TypeParam>(problem.A, problem.P, {}, all);
  for (std::size_t count = 1; count <= all.Progress().size(); ++count)
  {
    test::TbbContext context(2);
    context.CancelAfter(static_cast<int>(count));
    EXPECT_THROW(GalerkinHierarchy<TypeParam>(problem.A, problem.P, {}, context), Cancelled);
  }
}
