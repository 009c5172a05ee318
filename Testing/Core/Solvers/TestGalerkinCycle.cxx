#include "Solvers/Multigrid/GalerkinCycle.h"

#include "Solvers/Direct/CholeskySolver.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/StationaryIteration.h"
#include "Solvers/Multigrid/NestedIteration.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/MatrixOperator.h"
#include "Support/TbbContext.h"
#include "TorusProblem.h"

#include <gtest/gtest.h>

using namespace dmg;

namespace
{

template <class Scalar>
class AnyGalerkinCycle : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyGalerkinCycle, Scalars);

struct MultigridOptions
{
  GalerkinOptions Coarsening;
  CycleOptions Cycle;
};

/// The iterations around a cycle.
template <class Scalar>
class MultigridSolver
{
public:
  MultigridSolver(const SparseMatrix<Scalar>& matrix, const std::vector<SparseMatrix<Scalar>>& prolongations,
    const MultigridOptions& options, const ExecutionContext& context)
    : A(matrix)
    , Cycle(SparseMatrix<Scalar>(matrix), prolongations, options.Coarsening, options.Cycle, context)
  {
  }

  void Update(const SparseMatrix<Scalar>& matrix, const ExecutionContext& context)
  {
    this->A = matrix;
    this->Cycle.Update(SparseMatrix<Scalar>(matrix), context);
  }
  void SolveByConjugateGradients(const Vector<Scalar>& b, const StoppingCriteria& stop, Vector<Scalar>& x,
    SolveReport& report, const ExecutionContext& context)
  {
    ConjugateGradient<Scalar>(test::MatrixOperator<Scalar>(this->A), this->Cycle, b, stop, x, report, context);
  }
  void SolveByCycles(const Vector<Scalar>& b, const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report,
    const ExecutionContext& context)
  {
    StationaryIteration<Scalar>(test::MatrixOperator<Scalar>(this->A), this->Cycle, b, stop, x, report, context);
  }
  const std::vector<LevelReport>& Levels() const { return this->Cycle.Levels(); }
  long long Bytes() const { return this->Cycle.Bytes(); }

private:
  SparseMatrix<Scalar> A;
  GalerkinCycle<Scalar> Cycle;
};

template <class Scalar>
std::vector<Eigen::Triplet<Scalar>> Entries(const SparseMatrix<Scalar>& A)
{
  std::vector<Eigen::Triplet<Scalar>> entries;
  for (int i = 0; i < A.rows(); ++i)
  {
    for (typename SparseMatrix<Scalar>::InnerIterator entry(A, i); entry; ++entry)
    {
      entries.emplace_back(i, entry.col(), entry.value());
    }
  }
  return entries;
}

}

TYPED_TEST(AnyGalerkinCycle, AllThreeSolversAgree)
{
  const auto problem = test::MakeGridProblem<TypeParam>(6, 4);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3301);
  Vector<TypeParam> expected;
  CholeskySolver<TypeParam>(problem.A).Solve(b, expected);
  MultigridSolver<TypeParam> solver(problem.A, problem.P, {}, SerialContext());
  SolveReport report;
  Vector<TypeParam> x, y;
  solver.SolveByConjugateGradients(b, { 1e-10, 100 }, x, report, SerialContext());
  EXPECT_LE((problem.A * x - b).norm(), 1.001e-10 * b.norm());
  EXPECT_LE((x - expected).norm(), 1e-10 * b.norm() / 0.0048);
  solver.SolveByCycles(b, { 1e-10, 100 }, y, report, SerialContext());
  EXPECT_LE((y - expected).norm(), 1e-10 * b.norm() / 0.0048);

  solver.SolveByConjugateGradients(b, { 2e-10, 100 }, x, report, SerialContext());
  EXPECT_EQ(report.Iterations.size(), 1u);
}

TYPED_TEST(AnyGalerkinCycle, UpdateHasTheBitsOfANewSolver)
{
  auto problem = test::MakeGridProblem<TypeParam>(6, 4);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3302);
  const MultigridOptions options;
  MultigridSolver<TypeParam> updated(problem.A, problem.P, options, SerialContext());
  for (int i = 0; i < problem.A.rows(); i += 10)
  {
    problem.A.coeffRef(i, i) += 50.0;
  }
  updated.Update(problem.A, SerialContext());
  MultigridSolver<TypeParam> fresh(problem.A, problem.P, options, test::TbbContext(3));
  SolveReport report;
  Vector<TypeParam> x, y;
  updated.SolveByConjugateGradients(b, {}, x, report, SerialContext());
  fresh.SolveByConjugateGradients(b, {}, y, report, test::TbbContext(3));
  EXPECT_EQ(x, y);
  EXPECT_EQ(updated.Bytes(), fresh.Bytes());
}

TYPED_TEST(AnyGalerkinCycle, UpdateMayChangeThePrecision)
{
  // Natural boundary conditions, held by one unknown: strongly, weakly (a nearly singular matrix,
  // for which the cycle works in double precision), and strongly again.
  auto problem = test::MakeGridProblem<TypeParam>(6, 4);
  SparseMatrix<TypeParam>& A = problem.A;
  for (int i = 0; i < A.rows(); ++i)
  {
    A.coeffRef(i, i) = A.outerIndexPtr()[i + 1] - A.outerIndexPtr()[i] - 1;
  }
  const auto natural = A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 3305);
  A.coeffRef(1000, 1000) += 1.0;
  const MultigridOptions options;
  MultigridSolver<TypeParam> updated(A, problem.P, options, SerialContext());
  const long long bytes = updated.Bytes();
  for (const double weight : { 1e-9, 1.0 })
  {
    A = natural;
    A.coeffRef(1000, 1000) += weight;
    updated.Update(A, SerialContext());
    MultigridSolver<TypeParam> fresh(A, problem.P, options, SerialContext());
    SolveReport report;
    Vector<TypeParam> x, y;
    updated.SolveByConjugateGradients(b, {}, x, report, SerialContext());
    fresh.SolveByConjugateGradients(b, {}, y, report, SerialContext());
    EXPECT_EQ(x, y);
    EXPECT_EQ(updated.Bytes(), fresh.Bytes());
  }
  EXPECT_EQ(updated.Bytes(), bytes);
}

TYPED_TEST(AnyGalerkinCycle, SolvesAroundUnknownsThatNothingSees)
{
  // Every tenth fine unknown is eliminated, a whole square among them, so that some coarse unknowns
  // see nothing any more.
  const auto problem = test::MakeGridProblem<TypeParam>(6, 4);
  const int n = 63;
  std::vector<int> rowOf(n * n, -1);
  int free = 0;
  for (int y = 0; y < n; ++y)
  {
    for (int x = 0; x < n; ++x)
    {
      if ((x + 3 * y) % 10 != 0 && !(x < 20 && y < 20))
      {
        rowOf[y * n + x] = free++;
      }
    }
  }
  std::vector<Eigen::Triplet<TypeParam>> entries, transfers;
  for (const auto& entry : Entries(problem.A))
  {
    if (rowOf[entry.row()] >= 0 && rowOf[entry.col()] >= 0)
    {
      entries.emplace_back(rowOf[entry.row()], rowOf[entry.col()], entry.value());
    }
  }
  for (const auto& entry : Entries(problem.P[0]))
  {
    if (rowOf[entry.row()] >= 0)
    {
      transfers.emplace_back(rowOf[entry.row()], entry.col(), entry.value());
    }
  }
  const auto A = test::FromTriplets(free, free, entries);
  auto P = problem.P;
  P[0] = test::FromTriplets(free, static_cast<int>(P[0].cols()), transfers);
  MultigridSolver<TypeParam> solver(A, P, {}, SerialContext());
  const GalerkinHierarchy<TypeParam> hierarchy(A, P, {}, SerialContext());
  ASSERT_EQ(hierarchy.Diagonal(1).minCoeff(), 0.0);
  ASSERT_EQ(hierarchy.Diagonal(3).minCoeff(), 0.0);

  const auto b = test::RandomVector<TypeParam>(free, 3303);
  Vector<TypeParam> expected, x;
  CholeskySolver<TypeParam>(A).Solve(b, expected);
  SolveReport report;
  solver.SolveByConjugateGradients(b, { 1e-10, 30 }, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  EXPECT_LE((x - expected).norm(), 1e-10 * b.norm() / 0.0048);
}

TYPED_TEST(AnyGalerkinCycle, SingularButConsistentSystemsConverge)
{
  // The natural boundary condition: diagonals lowered to the number of neighbours, kernel = constants.
  const int n = 63;
  auto A = test::MakeGridProblem<double>(6, 1).A;
  for (int i = 0; i < A.rows(); ++i)
  {
    A.coeffRef(i, i) = A.outerIndexPtr()[i + 1] - A.outerIndexPtr()[i] - 1;
  }
  // Piecewise constant on squares of 3 x 3.
  std::vector<Eigen::Triplet<double>> first, second;
  for (int y = 0; y < n; ++y)
  {
    for (int x = 0; x < n; ++x)
    {
      first.emplace_back(y * n + x, (y / 3) * 21 + x / 3, 1.0);
    }
  }
  for (int y = 0; y < 21; ++y)
  {
    for (int x = 0; x < 21; ++x)
    {
      second.emplace_back(y * 21 + x, (y / 3) * 7 + x / 3, 1.0);
    }
  }
  const SparseMatrix<TypeParam> scalarA = A.template cast<TypeParam>();
  const std::vector<SparseMatrix<TypeParam>> P = { test::FromTriplets(n * n, 441, first).template cast<TypeParam>(),
    test::FromTriplets(441, 49, second).template cast<TypeParam>() };
  Vector<TypeParam> b = test::RandomVector<TypeParam>(n * n, 3304);
  b.array() -= b.mean();
  MultigridSolver<TypeParam> solver(scalarA, P, {}, SerialContext());
  SolveReport report;
  Vector<TypeParam> x;
  solver.SolveByConjugateGradients(b, { 1e-8, 50 }, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  EXPECT_LE((b - scalarA * x).norm(), 1.001e-8 * b.norm());
  // The smallest positive eigenvalue bounds what is left without the kernel.
  x.array() -= x.mean();
  EXPECT_LE(x.norm(), b.norm() / (2.0 - 2.0 * std::cos(std::acos(-1.0) / n)));
}

TYPED_TEST(AnyGalerkinCycle, NearlyZeroDiagonalsSurvive)
{
  // Three more pieces, each a path of three unknowns with random weights, held by 1e-14 of its
  // stiffness. Their coarse unknowns carry constants, of an energy that is rounding error mostly,
  // and are handed on from level to level. One more coarse unknown has no child at all.
  auto problem = test::MakeGridProblem<TypeParam>(5, 4);
  const int grid = static_cast<int>(problem.A.rows());
  constexpr int pieces = 3;
  test::Random random(3306);
  auto entries = Entries(problem.A);
  Vector<TypeParam> b = test::RandomVector<TypeParam>(grid + 3 * pieces, 3307);
  for (int piece = 0; piece < pieces; ++piece)
  {
    const int first = grid + 3 * piece;
    for (const int i : { first, first + 1 })
    {
      const double weight = random.Uniform(0.1, 1.0);
      const TypeParam coupling = weight * test::Phase<TypeParam>(random.Uniform(0.0, 6.0));
      entries.emplace_back(i, i, TypeParam(weight * (1.0 + 1e-14)));
      entries.emplace_back(i + 1, i + 1, TypeParam(weight));
      entries.emplace_back(i, i + 1, -coupling);
      entries.emplace_back(i + 1, i, -Eigen::numext::conj(coupling));
    }
  }
  const SparseMatrix<TypeParam> A = test::FromTriplets(grid + 9, grid + 9, entries);
  for (std::size_t level = 0; level < problem.P.size(); ++level)
  {
    const SparseMatrix<TypeParam>& P = problem.P[level];
    const int rows = static_cast<int>(P.rows());
    const int columns = static_cast<int>(P.cols());
    auto transfers = Entries(P);
    for (int piece = 0; piece < pieces; ++piece)
    {
      if (level > 0)
      {
        transfers.emplace_back(rows + piece, columns + piece, TypeParam(1.0));
        continue;
      }
      // Constant up to the phases along the path.
      const int first = grid + 3 * piece;
      TypeParam value = 1.0 / 3.0;
      for (const int i : { first, first + 1, first + 2 })
      {
        transfers.emplace_back(i, columns + piece, value);
        if (i < first + 2)
        {
          const TypeParam coupling = A.coeff(i + 1, i);
          value *= -coupling / std::abs(coupling);
        }
      }
    }
    problem.P[level] =
      test::FromTriplets(rows + (level == 0 ? 3 * pieces : pieces + 1), columns + pieces + 1, transfers);
  }
  const GalerkinHierarchy<TypeParam> hierarchy(A, problem.P, {}, SerialContext());
  for (int level = 1; level < hierarchy.NumberOfLevels(); ++level)
  {
    EXPECT_EQ((hierarchy.Diagonal(level).array() == 0.0).count(), pieces + 1);
  }

  // Without loads on the pieces the solution is the grid's, whoever solves.
  b.tail(3 * pieces).setZero();
  Vector<TypeParam> expected = Vector<TypeParam>::Zero(b.size()), onGrid;
  const SparseMatrix<TypeParam> gridA = A.topLeftCorner(grid, grid);
  CholeskySolver<TypeParam>(gridA).Solve(b.head(grid), onGrid);
  expected.head(grid) = onGrid;
  for (const CyclePrecision precision : { CyclePrecision::Single, CyclePrecision::Double })
  {
    MultigridOptions options;
    options.Cycle.Precision = precision;
    MultigridSolver<TypeParam> solver(A, problem.P, options, SerialContext());
    SolveReport report;
    Vector<TypeParam> x;
    solver.SolveByConjugateGradients(b, { 1e-10, 30 }, x, report, SerialContext());
    EXPECT_TRUE(report.Converged);
    EXPECT_LE((x - expected).norm(), 1e-7 * expected.norm());
  }
  NestedIteration<TypeParam> nested(A, problem.P, {}, SerialContext());
  SolveReport report;
  Vector<TypeParam> x;
  nested.Solve(b, { 100 }, x, report, SerialContext());
  EXPECT_EQ(x.tail(3 * pieces).norm(), 0.0);
  EXPECT_LE((x - expected).norm(), 0.01 * expected.norm());
}

TEST(GalerkinCycle, OneFormsOnATorusConverge)
{
  const auto problem = test::MakeTorusProblem(48, 4);
  for (int i = 0; i < problem.A.rows(); ++i)
  {
    ASSERT_EQ(problem.A.outerIndexPtr()[i + 1] - problem.A.outerIndexPtr()[i], 11);
  }
  const auto b = test::RandomVector<double>(problem.A.rows(), 3308);
  Vector<double> expected;
  CholeskySolver<double>(problem.A).Solve(b, expected);
  for (const CyclePrecision precision : { CyclePrecision::Automatic, CyclePrecision::Double })
  {
    MultigridOptions options;
    options.Cycle.Precision = precision;
    MultigridSolver<double> solver(problem.A, problem.P, options, SerialContext());
    SolveReport report;
    Vector<double> x, y;
    solver.SolveByConjugateGradients(b, { 1e-10, 100 }, x, report, SerialContext());
    EXPECT_TRUE(report.Converged) << report.Iterations.back().RelativeResidual;
    EXPECT_LE((x - expected).norm(), 1e-5 * expected.norm());
    SolveReport ofThreads;
    solver.SolveByConjugateGradients(b, { 1e-10, 100 }, y, ofThreads, test::TbbContext(3));
    EXPECT_EQ(x, y);
  }
  // Circulations are kept: around each coarse triangle, the fine edges sum to the coarse.
  const int n = 48;
  const test::TorusGrid fine(n), coarse(n / 2);
  const auto coarseForm = test::RandomVector<double>(problem.P[0].cols(), 3309);
  const Vector<double> fineForm = problem.P[0] * coarseForm;
  const auto around = [](const test::TorusGrid& grid, const Vector<double>& form, int x, int y)
  {
    return form[grid.Edge(x, y, test::TorusGrid::Right)] + form[grid.Edge(x + 1, y, test::TorusGrid::Up)] -
      form[grid.Edge(x, y, test::TorusGrid::Diagonal)];
  };
  for (int k = 0; k < n / 2; ++k)
  {
    const double circulation = around(coarse, coarseForm, k, 3);
    for (const auto& [dx, dy] : { std::pair(0, 0), std::pair(1, 0), std::pair(1, 1) })
    {
      EXPECT_NEAR(around(fine, fineForm, 2 * k + dx, 6 + dy), circulation / 4.0, 1e-14);
    }
  }
}

TYPED_TEST(AnyGalerkinCycle, FewerLevelsAndOtherSweepsConvergeToo)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 4);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3310);
  Vector<TypeParam> expected;
  CholeskySolver<TypeParam>(problem.A).Solve(b, expected);
  std::size_t cyclesBefore = 1000;
  for (const int sweeps : { 1, 2, 4, 8 })
  {
    std::size_t cycles = 0;
    for (const int coarsest : { 0, 1, 3, 7 })
    {
      MultigridOptions options;
      options.Coarsening.CoarsestLevel = coarsest;
      options.Cycle.Smoothing.PreSweeps = options.Cycle.Smoothing.PostSweeps = sweeps;
      MultigridSolver<TypeParam> solver(problem.A, problem.P, options, SerialContext());
      EXPECT_EQ(static_cast<int>(solver.Levels().size()), std::min(coarsest + 1, 4));
      SolveReport report;
      Vector<TypeParam> x;
      solver.SolveByCycles(b, { 1e-10, 100 }, x, report, SerialContext());
      EXPECT_TRUE(report.Converged);
      EXPECT_LE((x - expected).norm(), 1e-9 * b.norm() / 0.0190);
      cycles = report.Iterations.size();
    }
    EXPECT_LE(cycles, cyclesBefore) << "more sweeps never need more cycles";
    cyclesBefore = cycles;
  }
}

TYPED_TEST(AnyGalerkinCycle, SizesOfVectorsAreChecked)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  MultigridSolver<TypeParam> solver(problem.A, problem.P, {}, SerialContext());
  SolveReport report;
  Vector<TypeParam> x;
  EXPECT_THROW(
    solver.SolveByConjugateGradients(Vector<TypeParam>::Ones(7), {}, x, report, SerialContext()), InvalidInput);
  x.setZero(7);
  EXPECT_THROW(
    solver.SolveByCycles(Vector<TypeParam>::Ones(problem.A.rows()), {}, x, report, SerialContext()), InvalidInput);
}

TYPED_TEST(AnyGalerkinCycle, LevelsAreReported)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  MultigridSolver<TypeParam> solver(problem.A, problem.P, {}, SerialContext());
  SolveReport report;
  report.Levels = solver.Levels();
  // Five points on the finest level, nine on the others.
  const auto points = [](int n, int corners) { return n * n + 4 * n * (n - 1) + corners * (n - 1) * (n - 1); };
  ASSERT_EQ(report.Levels.size(), 3u);
  EXPECT_EQ(report.Levels[0].NonZeros, points(31, 0));
  EXPECT_EQ(report.Levels[1].NonZeros, points(15, 4));
  EXPECT_EQ(report.Levels[2].NonZeros, points(7, 4));
  EXPECT_DOUBLE_EQ(
    report.OperatorComplexity(), 1.0 + (points(15, 4) + points(7, 4)) / static_cast<double>(points(31, 0)));
}
