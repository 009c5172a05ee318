#include "Solvers/Multigrid/NestedIteration.h"

#include "Solvers/Direct/CholeskySolver.h"
#include "Support/DenseAlgebra.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;

namespace
{

using test::Dense;
using test::Densified;

template <class Scalar>
class AnyNestedIteration : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyNestedIteration, Scalars);

template <class Scalar>
Vector<Scalar> SolveByCholesky(const SparseMatrix<Scalar>& A, const Vector<Scalar>& b)
{
  Vector<Scalar> x;
  CholeskySolver<Scalar>(A).Solve(b, x);
  return x;
}

NestedOptions StartingAt(int level, bool maySweep = true)
{
  NestedOptions options;
  options.Coarsening.CoarsestLevel = level;
  options.MaySweep = maySweep;
  return options;
}

/// Poisson's equation on 2^depth - 1 nodes a side of a line or a cube, with (multi)linear
/// interpolation; boundary values are zero.
test::GridProblem<double> MakePoisson(int dimension, int depth, int levels)
{
  const auto kronecker = [](const SparseMatrix<double>& A, const SparseMatrix<double>& B)
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < A.rows(); ++i)
    {
      for (SparseMatrix<double>::InnerIterator a(A, i); a; ++a)
      {
        for (int k = 0; k < B.rows(); ++k)
        {
          for (SparseMatrix<double>::InnerIterator b(B, k); b; ++b)
          {
            entries.emplace_back(static_cast<int>(i * B.rows() + k), static_cast<int>(a.col() * B.cols() + b.col()),
              a.value() * b.value());
          }
        }
      }
    }
    return test::FromTriplets(static_cast<int>(A.rows() * B.rows()), static_cast<int>(A.cols() * B.cols()), entries);
  };
  const int n = (1 << depth) - 1;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
  {
    entries.emplace_back(i, i, 2.0);
    if (i > 0)
    {
      entries.emplace_back(i, i - 1, -1.0);
      entries.emplace_back(i - 1, i, -1.0);
    }
  }
  const SparseMatrix<double> line = test::FromTriplets(n, n, entries);
  SparseMatrix<double> identity(n, n);
  identity.setIdentity();
  test::GridProblem<double> problem;
  problem.A = line;
  SparseMatrix<double> identityBefore = identity;
  for (int d = 1; d < dimension; ++d)
  {
    const SparseMatrix<double> before = kronecker(problem.A, identity);
    problem.A = before + kronecker(identityBefore, line);
    identityBefore = kronecker(identityBefore, identity);
  }
  for (int level = 1; level < levels; ++level)
  {
    const int coarse = (1 << (depth - level)) - 1;
    entries.clear();
    for (int j = 0; j < coarse; ++j)
    {
      entries.emplace_back(2 * j, j, 0.5);
      entries.emplace_back(2 * j + 1, j, 1.0);
      entries.emplace_back(2 * j + 2, j, 0.5);
    }
    const SparseMatrix<double> ofLine = test::FromTriplets(2 * coarse + 1, coarse, entries);
    SparseMatrix<double> P = ofLine;
    for (int d = 1; d < dimension; ++d)
    {
      P = kronecker(P, ofLine);
    }
    problem.P.push_back(P);
  }
  return problem;
}

}

TYPED_TEST(AnyNestedIteration, EnoughSweepsEqualCholesky)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 3);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3501);
  const auto expected = SolveByCholesky(problem.A, b);
  NestedIteration<TypeParam> nested(problem.A, problem.P, {}, SerialContext());
  SolveReport report;
  Vector<TypeParam> x;
  // Gauss-Seidel contracts by at most cos^2(pi / 16) = 0.962 per sweep: 0.962^800 < 1e-13.
  const std::vector<int> sweeps = nested.Solve(b, { 800 }, x, report, SerialContext());
  EXPECT_LE((x - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(sweeps, (std::vector<int>{ 800, 800, 0 }));
  EXPECT_TRUE(report.Converged);
  ASSERT_EQ(report.Iterations.size(), 2u);
  EXPECT_EQ(report.Iterations[0].RelativeResidual, 1.0);
  EXPECT_LE(report.Iterations[1].RelativeResidual, 1e-12);
}

// Conjugate gradients lower the energy with every step, and a V(1,1)-cycle makes the condition number of
// this problem less than 2, so that a step divides the error by 5 or more.
TYPED_TEST(AnyNestedIteration, CyclesOnEachLevelConverge)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 4);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3507);
  const auto expected = SolveByCholesky(problem.A, b);
  NestedIteration<TypeParam> nested(problem.A, problem.P, {}, SerialContext());
  ConvergenceMeasure<TypeParam> measure;
  measure.Reference = expected;
  SweepOptions options;
  options.Sweeps = 0;
  options.Cycles = 16;
  SolveReport report;
  Vector<TypeParam> x;
  nested.Solve(b, options, x, report, SerialContext(), &measure);
  EXPECT_LE((x - expected).norm(), 1e-10 * expected.norm());
  // Rows: the start, the coarsest solution, one for each level after its steps.
  const std::vector<int> levels = { 0, 3, 2, 1, 0 };
  ASSERT_EQ(report.Iterations.size(), levels.size());
  for (std::size_t k = 0; k < levels.size(); ++k)
  {
    EXPECT_EQ(report.Iterations[k].Level, levels[k]);
  }
  double former = report.Iterations[1].Error;
  for (options.Cycles = 1; options.Cycles <= 4; ++options.Cycles)
  {
    SolveReport ofFew;
    nested.Solve(b, options, x, ofFew, SerialContext(), &measure);
    EXPECT_LT(ofFew.Iterations.back().Error, former);
    former = ofFew.Iterations.back().Error;
  }

  options.Cycles = 16;
  nested.Solve(b, options, x, report, SerialContext());
  Vector<TypeParam> inParallel;
  nested.Solve(b, options, inParallel, report, test::TbbContext(3));
  EXPECT_EQ(inParallel, x);
  options.Cycles = -1;
  EXPECT_THROW(nested.Solve(b, options, x, report, SerialContext()), InvalidInput);
}

TEST(NestedIteration, SolvesPoissonProblemsOnALineAndInACube)
{
  for (const int dimension : { 1, 3 })
  {
    const auto problem = MakePoisson(dimension, 4, 3);
    const auto b = test::RandomVector<double>(problem.A.rows(), 3502);
    const auto expected = SolveByCholesky(problem.A, b);
    NestedIteration<double> nested(problem.A, problem.P, {}, SerialContext());
    SolveReport report;
    Vector<double> x;
    nested.Solve(b, { 800 }, x, report, SerialContext());
    EXPECT_LE((x - expected).norm(), 1e-12 * expected.norm());
    if (dimension == 1)
    {
      // Linear interpolation on a line meets the solution at the coarse nodes exactly, and between
      // them where b is zero, if only coarse nodes carry a right-hand side.
      Vector<double> atCoarse = Vector<double>::Zero(15);
      atCoarse[3] = 1.0;
      atCoarse[11] = -2.0;
      nested.Solve(atCoarse, { 0 }, x, report, SerialContext());
      EXPECT_LE((x - SolveByCholesky(problem.A, atCoarse)).norm(), 1e-10);
    }
  }
}

TYPED_TEST(AnyNestedIteration, StartingAtTheFinestLevelIsCholesky)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3503);
  NestedIteration<TypeParam> nested(problem.A, problem.P, StartingAt(0), SerialContext());
  EXPECT_EQ(nested.Levels().size(), 1u);
  SolveReport report;
  Vector<TypeParam> x;
  nested.Solve(b, {}, x, report, SerialContext());
  const auto expected = SolveByCholesky(problem.A, b);
  // The factor's diagonal is lifted by 1e-12; the condition number is 400.
  EXPECT_LE((x - expected).norm(), 1e-9 * expected.norm());
  EXPECT_THROW(NestedIteration<TypeParam>(problem.A, problem.P, StartingAt(-1), SerialContext()), InvalidInput);
}

TYPED_TEST(AnyNestedIteration, WithoutSweepsItIsCoarseProlongation)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 3);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3504);
  for (const int level : { 1, 2 })
  {
    Dense<TypeParam> P = Densified(problem.P[0]);
    if (level == 2)
    {
      P = test::Product(P, Densified(problem.P[1]));
    }
    const Dense<TypeParam> coarseA = test::GalerkinProduct(Densified(problem.A), P);
    const Vector<TypeParam> expected = P * test::Solved<TypeParam>(coarseA, P.adjoint() * b);
    for (const bool maySweep : { false, true })
    {
      NestedIteration<TypeParam> coarse(problem.A, problem.P, StartingAt(level, maySweep), SerialContext());
      ConvergenceMeasure<TypeParam> measure;
      SolveReport report;
      Vector<TypeParam> x;
      coarse.Solve(b, { 0 }, x, report, SerialContext(), &measure);
      EXPECT_LE((x - expected).norm(), 1e-9 * expected.norm());
      ASSERT_EQ(report.Iterations.size(), 2u);
      EXPECT_EQ(report.Iterations[1].Level, level);
      EXPECT_NEAR(report.Iterations[1].RelativeResidual, (b - problem.A * expected).norm() / b.norm(), 1e-9);
    }
  }
}

TYPED_TEST(AnyNestedIteration, SweepsAreGaussSeidel)
{
  // One coarse unknown that nothing sees, so that the sweeps start from zero. On a path the colours
  // are even and odd; sweeps go from the last colour to the first.
  std::vector<Eigen::Triplet<TypeParam>> entries;
  const int n = 9;
  for (int i = 0; i < n; ++i)
  {
    entries.emplace_back(i, i, TypeParam(2.0 + i));
    if (i > 0)
    {
      const TypeParam coupling = test::Phase<TypeParam>(0.7 * i);
      entries.emplace_back(i, i - 1, coupling);
      entries.emplace_back(i - 1, i, Eigen::numext::conj(coupling));
    }
  }
  const SparseMatrix<TypeParam> A = test::FromTriplets(n, n, entries);
  SparseMatrix<TypeParam> P(n, 1);
  P.makeCompressed();
  const auto b = test::RandomVector<TypeParam>(n, 3505);
  NestedIteration<TypeParam> nested(A, { P }, {}, SerialContext());
  SolveReport report;
  Vector<TypeParam> x;
  Vector<TypeParam> expected = Vector<TypeParam>::Zero(n);
  for (int sweeps = 1; sweeps <= 3; ++sweeps)
  {
    for (const int parity : { 1, 0 })
    {
      for (int i = parity; i < n; i += 2)
      {
        const TypeParam row = (A.row(i) * expected)(0);
        expected[i] += (b[i] - row) / A.coeff(i, i);
      }
    }
    nested.Solve(b, { sweeps }, x, report, SerialContext());
    EXPECT_LE((x - expected).norm(), 1e-14);
  }
}

TYPED_TEST(AnyNestedIteration, HistoryFollowsTheLevels)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3506);
  NestedIteration<TypeParam> nested(problem.A, problem.P, {}, SerialContext());
  ConvergenceMeasure<TypeParam> measure;
  measure.EnergyConstant = 7.0;
  const Vector<double> mass = test::RandomVector<double>(problem.A.rows(), 3507).array() + 2.0;
  measure.Mass = &mass;
  measure.Reference = SolveByCholesky(problem.A, b);
  SolveReport report, other;
  Vector<TypeParam> x, y;
  nested.Solve(b, { 4 }, x, report, SerialContext(), &measure);
  const std::vector<int> levels = { 0, 2, 1, 0, 0, 0, 0 };
  ASSERT_EQ(report.Iterations.size(), levels.size());
  for (std::size_t k = 0; k < levels.size(); ++k)
  {
    EXPECT_EQ(report.Iterations[k].Level, levels[k]);
    EXPECT_EQ(report.Iterations[k].Iteration, static_cast<int>(k));
    if (k > 0)
    {
      // Every step minimises the energy over some subspace beyond the iterate.
      EXPECT_LT(report.Iterations[k].Energy, report.Iterations[k - 1].Energy);
      EXPECT_GE(report.Iterations[k].Seconds, report.Iterations[k - 1].Seconds);
    }
  }
  EXPECT_EQ(report.Iterations.back().Seconds, report.SolveSeconds);

  // The last row by its definitions.
  EXPECT_NEAR(report.Iterations.back().Energy, 7.0 + Eigen::numext::real(x.dot(problem.A * x - 2.0 * b)),
    1e-11 * std::abs(report.Iterations.back().Energy));
  const Vector<TypeParam> error = x - measure.Reference;
  const auto norm = [&mass](const Vector<TypeParam>& v) { return std::sqrt(v.cwiseAbs2().dot(mass)); };
  EXPECT_NEAR(report.Iterations.back().Error, norm(error) / norm(measure.Reference), 1e-13);
  EXPECT_NEAR(report.Iterations.back().MassResidual, norm(b - problem.A * x) / norm(b), 1e-13);

  nested.Solve(b, { 4 }, y, other, SerialContext());
  EXPECT_EQ(x, y) << "watching must not change what is watched";
  nested.Solve(b, { 4 }, y, other, test::TbbContext(3));
  EXPECT_EQ(x, y);
}

TYPED_TEST(AnyNestedIteration, TheErrorRuleStopsWhereTheErrorsSay)
{
  // One coarse level, so that a run with a fixed number shows the errors after each sweep.
  const auto problem = test::MakeGridProblem<TypeParam>(5, 2);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3508);
  NestedIteration<TypeParam> nested(problem.A, problem.P, {}, SerialContext());
  ConvergenceMeasure<TypeParam> measure;
  measure.Reference = SolveByCholesky(problem.A, b);
  SolveReport fixed, report;
  Vector<TypeParam> x;
  nested.Solve(b, { 300 }, x, fixed, SerialContext(), &measure);
  for (const double improvement : { 0.3, 0.1, 0.03 })
  {
    int expected = 1; // rows: start, coarsest, then sweeps
    while (fixed.Iterations[expected + 1].Error <= (1.0 - improvement) * fixed.Iterations[expected].Error)
    {
      ++expected;
    }
    measure.LeastImprovement = improvement;
    const auto sweeps = nested.Solve(b, { 300 }, x, report, SerialContext(), &measure);
    EXPECT_EQ(sweeps, (std::vector<int>{ expected, 0 }));
    EXPECT_EQ(report.Iterations.back().Error, fixed.Iterations[expected + 1].Error);
    EXPECT_TRUE(report.Converged);
  }
  measure.LeastImprovement = 1e-9;
  EXPECT_EQ(nested.Solve(b, { 2 }, x, report, SerialContext(), &measure)[0], 2);
}

TYPED_TEST(AnyNestedIteration, TheErrorRuleComparesProlongedIterates)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3509);
  ConvergenceMeasure<TypeParam> measure;
  measure.Reference = SolveByCholesky(problem.A, b);
  SolveReport report;
  Vector<TypeParam> x;
  NestedIteration<TypeParam> nested(problem.A, problem.P, {}, SerialContext());
  measure.LeastImprovement = 0.01;
  const auto sweeps = nested.Solve(b, { 1000 }, x, report, SerialContext(), &measure);
  // By hand on level 1: the same sweeps as two-level iterations of its own system.
  const SparseMatrix<TypeParam> R = problem.P[0].adjoint();
  const SparseMatrix<TypeParam> coarseA = R * SparseMatrix<TypeParam>(problem.A * problem.P[0]);
  NestedIteration<TypeParam> coarse(coarseA, { problem.P[1] }, {}, SerialContext());
  const auto errorAfter = [&](int number)
  {
    Vector<TypeParam> y;
    SolveReport ignored;
    coarse.Solve(R * b, { number }, y, ignored, SerialContext());
    return (problem.P[0] * y - measure.Reference).norm() / measure.Reference.norm();
  };
  int expected = 1;
  while (errorAfter(expected) <= 0.99 * errorAfter(expected - 1))
  {
    ++expected;
  }
  EXPECT_EQ(sweeps[1], expected);
  EXPECT_NEAR(report.Iterations[2].Error, errorAfter(expected), 1e-10);
}

TYPED_TEST(AnyNestedIteration, InputIsCheckedAndZeroIsSolvedByZero)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  NestedIteration<TypeParam> nested(problem.A, problem.P, {}, SerialContext());
  SolveReport report;
  Vector<TypeParam> x;
  Vector<TypeParam> b = Vector<TypeParam>::Zero(225);
  nested.Solve(b, {}, x, report, SerialContext());
  EXPECT_EQ(x, b);
  EXPECT_EQ(report.Iterations.back().RelativeResidual, 0.0);
  EXPECT_THROW(nested.Solve(Vector<TypeParam>::Ones(7), {}, x, report, SerialContext()), InvalidInput);
  EXPECT_THROW(nested.Solve(b, { -1 }, x, report, SerialContext()), InvalidInput);
  b[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(nested.Solve(b, {}, x, report, SerialContext()), InvalidInput);
}

TYPED_TEST(AnyNestedIteration, CanBeCancelledAtEveryCheckpoint)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  const auto b = test::RandomVector<TypeParam>(problem.A.rows(), 3511);
  for (const bool maySweep : { true, false })
  {
    const NestedOptions options = StartingAt(2, maySweep);
    const test::TbbContext all(2);
    NestedIteration<TypeParam> nested(problem.A, problem.P, options, all);
    SolveReport report;
    Vector<TypeParam> x;
    const auto built = all.Progress().size();
    nested.Solve(b, {}, x, report, all);
    EXPECT_GE(all.Progress().size() - built, maySweep ? 20u : 2u);
    for (std::size_t count = 1; count <= all.Progress().size(); ++count)
    {
      test::TbbContext context(2);
      context.CancelAfter(static_cast<int>(count));
      const auto run = [&]
      {
        NestedIteration<TypeParam> cancelled(problem.A, problem.P, options, context);
        cancelled.Solve(b, {}, x, report, context);
      };
      EXPECT_THROW(run(), Cancelled);
    }
  }
}
