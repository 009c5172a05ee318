#include "Solvers/Krylov/ConjugateGradient.h"

#include "Solvers/Direct/CholeskySolver.h"
#include "Solvers/Multigrid/GalerkinCycle.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/MatrixOperator.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// B = scale I.
template <class Scalar>
class Scaling : public Preconditioner<Scalar>
{
public:
  explicit Scaling(double factor)
    : Factor(factor)
  {
  }
  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext&) override { z = this->Factor * r; }

private:
  const double Factor;
};

/// B = diag(factors).
template <class Scalar>
class DiagonalScaling : public Preconditioner<Scalar>
{
public:
  explicit DiagonalScaling(const Vector<double>& factors)
    : Factors(factors)
  {
  }
  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext&) override
  {
    z = this->Factors.asDiagonal() * r;
  }

private:
  const Vector<double> Factors;
};

CycleOptions WithPrecision(CyclePrecision precision)
{
  CycleOptions options;
  options.Precision = precision;
  return options;
}

/// A grid problem with a V(2,2)-cycle.
template <class Scalar>
struct CyclePreconditioned
{
  CyclePreconditioned(int depth, int levels, CyclePrecision precision = CyclePrecision::Single)
    : Problem(test::MakeGridProblem<Scalar>(depth, levels))
    , Cycle(SparseMatrix<Scalar>(this->Problem.A), this->Problem.P, {}, WithPrecision(precision), SerialContext())
  {
  }

  const SparseMatrix<Scalar>& A() const { return this->Problem.A; }
  test::MatrixOperator<Scalar> Operator() const { return test::MatrixOperator<Scalar>(this->Problem.A); }
  int Size() const { return static_cast<int>(this->Problem.A.rows()); }

  const test::GridProblem<Scalar> Problem;
  GalerkinCycle<Scalar> Cycle;
};

template <class Scalar>
double RelativeResidual(const SparseMatrix<Scalar>& A, const Vector<Scalar>& b, const Vector<Scalar>& x)
{
  return (b - A * x).norm() / b.norm();
}

/// |r|_B / |x|_A by the definition.
template <class Scalar>
double RelativeEnergyNorm(CyclePreconditioned<Scalar>& grid, const Vector<Scalar>& b, const Vector<Scalar>& x)
{
  const Vector<Scalar> r = b - grid.A() * x;
  Vector<Scalar> z;
  grid.Cycle.Apply(r, z, SerialContext());
  return std::sqrt(std::abs(r.dot(z)) / std::abs(x.dot(grid.A() * x)));
}

template <class Scalar>
class AnyConjugateGradient : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyConjugateGradient, Scalars);

}

TYPED_TEST(AnyConjugateGradient, AgreesWithCholesky)
{
  CyclePreconditioned<TypeParam> grid(7, 5);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 3101);
  Vector<TypeParam> expected;
  CholeskySolver<TypeParam>(grid.A()).Solve(b, expected);
  for (const double tolerance : { 1e-4, 1e-8, 1e-12 })
  {
    SolveReport report;
    Vector<TypeParam> x;
    ConjugateGradient(grid.Operator(), grid.Cycle, b, { tolerance, 100 }, x, report, SerialContext());
    EXPECT_TRUE(report.Converged);
    EXPECT_TRUE(report.Warnings.empty());
    EXPECT_LE(RelativeResidual(grid.A(), b, x), tolerance * (1.0 + 1e-6));
    // The smallest eigenvalue of the scalar Laplacian is 2 (2 - 2 cos(pi / 128)) = 1.2e-3; a magnetic
    // field only raises it.
    EXPECT_LE((x - expected).norm(), tolerance * b.norm() / 1.2e-3 + 1e-12 * expected.norm());
  }
}

TYPED_TEST(AnyConjugateGradient, IterationsDoNotGrowWithTheGrid)
{
  std::vector<int> iterations;
  for (int depth = 5; depth <= 8; ++depth)
  {
    CyclePreconditioned<TypeParam> grid(depth, depth - 2);
    const auto b = test::RandomVector<TypeParam>(grid.Size(), 3102);
    SolveReport report;
    Vector<TypeParam> x;
    ConjugateGradient(grid.Operator(), grid.Cycle, b, { 1e-8, 100 }, x, report, SerialContext());
    ASSERT_TRUE(report.Converged);
    iterations.push_back(report.Iterations.back().Iteration);
  }
  // V(2,2) with red-black Gauss-Seidel contracts by less than 0.1 (Trottenberg, Oosterlee and
  // Schueller, Multigrid, 2001), so eight steps suffice even without acceleration.
  EXPECT_LE(iterations.back(), 8);
  EXPECT_LE(iterations.back(), iterations.front() + 1);
}

TYPED_TEST(AnyConjugateGradient, SinglePrecisionInTheCycleCostsNoIteration)
{
  std::vector<int> iterations;
  for (const CyclePrecision precision : { CyclePrecision::Single, CyclePrecision::Double })
  {
    CyclePreconditioned<TypeParam> grid(7, 5, precision);
    const auto b = test::RandomVector<TypeParam>(grid.Size(), 3103);
    SolveReport report;
    Vector<TypeParam> x;
    ConjugateGradient(grid.Operator(), grid.Cycle, b, { 1e-12, 100 }, x, report, SerialContext());
    EXPECT_TRUE(report.Converged);
    EXPECT_LE(RelativeResidual(grid.A(), b, x), 1.001e-12);
    iterations.push_back(report.Iterations.back().Iteration);
  }
  EXPECT_EQ(iterations[0], iterations[1]);
}

TYPED_TEST(AnyConjugateGradient, HistoryStartsAtTheStartAndEndsAtTheTruth)
{
  CyclePreconditioned<TypeParam> grid(5, 3);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 3104);
  SolveReport report;
  Vector<TypeParam> x;
  ConjugateGradient(grid.Operator(), grid.Cycle, b, { 1e-10, 100 }, x, report, SerialContext());
  ASSERT_GE(report.Iterations.size(), 2u);
  EXPECT_EQ(report.Iterations.front().RelativeResidual, 1.0);
  for (std::size_t i = 0; i < report.Iterations.size(); ++i)
  {
    EXPECT_EQ(report.Iterations[i].Iteration, static_cast<int>(i));
    EXPECT_GE(report.Iterations[i].Seconds, i == 0 ? 0.0 : report.Iterations[i - 1].Seconds);
  }
  EXPECT_GE(report.SolveSeconds, report.Iterations.back().Seconds);
  EXPECT_EQ(report.Returned, report.Iterations.back().Iteration);
  const double truth = RelativeEnergyNorm(grid, b, x);
  EXPECT_NEAR(report.Iterations.back().RelativeResidual, truth, 1e-5 * truth); // cycles in single precision

  x.resize(0);
  StoppingCriteria stop{ 1e-10, 100 };
  stop.MayEstimate = true;
  ConjugateGradient(grid.Operator(), grid.Cycle, b, stop, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  const double estimated = RelativeEnergyNorm(grid, b, x);
  EXPECT_LE(report.Iterations.back().RelativeResidual, 2.0 * estimated);
  EXPECT_GE(report.Iterations.back().RelativeResidual, 0.5 * estimated);
}

// B is the inverse of A = I but for one unknown, of which b has 1e-9 and B makes 1e8 times too much. After one step that
// unknown is all of the residual: |r|_B is 1e4 |r| = 1e3, where it was |r| = 7 before.
TYPED_TEST(AnyConjugateGradient, ResidualThatTheRatioBeforeMakesSmallIsNotConverged)
{
  constexpr int size = 50;
  SparseMatrix<TypeParam> A(size, size);
  A.setIdentity();
  Vector<double> inverse = Vector<double>::Ones(size);
  inverse[7] = 1e8;
  Vector<TypeParam> b = Vector<TypeParam>::Ones(size);
  b[7] = 1e-9;
  DiagonalScaling<TypeParam> B(inverse);
  const auto measured = [&](const Vector<TypeParam>& x)
  {
    const Vector<TypeParam> r = b - x;
    return std::sqrt(r.cwiseAbs2().dot(inverse)) / x.norm();
  };
  for (const bool mayEstimate : { false, true })
  {
    StoppingCriteria stop{ 0.1, 100 };
    stop.MayEstimate = mayEstimate;
    SolveReport report;
    Vector<TypeParam> x;
    ConjugateGradient(test::MatrixOperator(A), B, b, stop, x, report, SerialContext());
    EXPECT_TRUE(report.Converged);
    EXPECT_LE(measured(x), 0.1);
    ASSERT_EQ(report.Iterations.size(), 3u) << "B A has two eigenvalues";
    EXPECT_NEAR(report.Iterations[1].RelativeResidual, 1e3 / std::sqrt(49.0), 1.0);

    stop.MaximumIterations = 1;
    x.resize(0);
    ConjugateGradient(test::MatrixOperator(A), B, b, stop, x, report, SerialContext());
    EXPECT_FALSE(report.Converged);
    EXPECT_EQ(report.Returned, 0);
    EXPECT_EQ(x.norm(), 0.0);
    EXPECT_EQ(report.Iterations[0].RelativeResidual, 1.0);
  }
}

// A V-cycle is close to the inverse, so that the residual in its norm is the error in the energy norm.
TYPED_TEST(AnyConjugateGradient, ResidualsAreErrorsInTheEnergyNorm)
{
  CyclePreconditioned<TypeParam> grid(6, 4);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 3114);
  Vector<TypeParam> solution;
  CholeskySolver<TypeParam>(grid.A()).Solve(b, solution);
  const auto energyNorm = [&grid](const Vector<TypeParam>& v) { return std::sqrt(std::abs(v.dot(grid.A() * v))); };
  for (const double tolerance : { 1e-2, 1e-4, 1e-6, 1e-8 })
  {
    SolveReport report;
    Vector<TypeParam> x;
    ConjugateGradient(grid.Operator(), grid.Cycle, b, { tolerance, 100 }, x, report, SerialContext());
    const double error = energyNorm(x - solution) / energyNorm(solution);
    EXPECT_LE(error, 2.0 * report.Iterations.back().RelativeResidual);
    EXPECT_GE(error, 0.5 * report.Iterations.back().RelativeResidual);
  }
}

TYPED_TEST(AnyConjugateGradient, StartsFromTheGivenVector)
{
  CyclePreconditioned<TypeParam> grid(5, 3);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 3105);
  SolveReport report;
  Vector<TypeParam> x;
  ConjugateGradient(grid.Operator(), grid.Cycle, b, { 1e-10, 100 }, x, report, SerialContext());
  const int fromZero = report.Iterations.back().Iteration;

  const Vector<TypeParam> solution = x;
  ConjugateGradient(grid.Operator(), grid.Cycle, b, { 1e-9, 100 }, x, report, SerialContext());
  EXPECT_EQ(report.Iterations.size(), 1u);
  EXPECT_EQ(x, solution);

  x += 1e-5 * test::RandomVector<TypeParam>(grid.Size(), 3106);
  ConjugateGradient(grid.Operator(), grid.Cycle, b, { 1e-10, 100 }, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  EXPECT_LT(report.Iterations.back().Iteration, fromZero);
}

TYPED_TEST(AnyConjugateGradient, ZeroRightHandSideHasTheSolutionZero)
{
  CyclePreconditioned<TypeParam> grid(4, 2);
  const Vector<TypeParam> zero = Vector<TypeParam>::Zero(grid.Size());
  Vector<TypeParam> x = test::RandomVector<TypeParam>(grid.Size(), 3107);
  SolveReport report;
  ConjugateGradient(grid.Operator(), grid.Cycle, zero, {}, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  EXPECT_EQ(x, zero);
  EXPECT_EQ(report.Iterations.size(), 1u);
  EXPECT_EQ(report.Iterations[0].RelativeResidual, 0.0);
}

TYPED_TEST(AnyConjugateGradient, TheLimitLeavesTheBestVector)
{
  // Eigenvalues from 1 to 10^4 and no preconditioner: residuals go up and down. Stop where one is
  // worse than the best before it.
  SparseMatrix<TypeParam> A(200, 200);
  for (int i = 0; i < 200; ++i)
  {
    A.insert(i, i) = std::pow(10.0, 4.0 * i / 199.0);
  }
  A.makeCompressed();
  const auto b = test::RandomVector<TypeParam>(200, 3113);
  Scaling<TypeParam> identity(1.0);
  SolveReport report;
  Vector<TypeParam> x;
  ConjugateGradient(test::MatrixOperator(A), identity, b, { 1e-10, 10000 }, x, report, SerialContext());
  ASSERT_TRUE(report.Converged);
  double best = 1.0;
  int limit = 0;
  for (const IterationReport& row : report.Iterations)
  {
    if (best < 1.0 && row.RelativeResidual > best)
    {
      limit = row.Iteration;
      break;
    }
    best = std::min(best, row.RelativeResidual);
  }
  ASSERT_GT(limit, 0) << "residuals that only fall test nothing";

  x.resize(0);
  ConjugateGradient(test::MatrixOperator(A), identity, b, { 1e-10, limit }, x, report, SerialContext());
  EXPECT_FALSE(report.Converged);
  EXPECT_EQ(report.Iterations.back().Iteration, limit);
  EXPECT_EQ(report.Returned, limit - 1);
  EXPECT_GT(report.Iterations.back().RelativeResidual, best);
  EXPECT_NEAR(report.Iterations[limit - 1].RelativeResidual, best, 1e-12);
  EXPECT_NEAR((b - A * x).norm() / std::sqrt(std::abs(x.dot(A * x))), best, 1e-12);
  ASSERT_EQ(report.Warnings.size(), 1u);
  EXPECT_NE(report.Warnings[0].find("limit of " + std::to_string(limit)), std::string::npos);
}

TYPED_TEST(AnyConjugateGradient, StopsWhereRoundingForbidsProgress)
{
  CyclePreconditioned<TypeParam> grid(6, 4);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 3108);
  SolveReport report;
  Vector<TypeParam> x;
  ConjugateGradient(grid.Operator(), grid.Cycle, b, { 1e-30, 1000 }, x, report, SerialContext());
  EXPECT_FALSE(report.Converged);
  EXPECT_LT(report.Iterations.back().Iteration, 100);
  // |A| |x| eps / |b|, |x| / |b| at most 1 / 0.005
  EXPECT_LE(RelativeResidual(grid.A(), b, x), 8.0 / 0.005 * 10 * Epsilon);
  ASSERT_EQ(report.Warnings.size(), 1u);
  EXPECT_NE(report.Warnings[0].find("rounding"), std::string::npos);
}

TYPED_TEST(AnyConjugateGradient, IndefiniteOperatorsEndWithAWarning)
{
  const auto A = test::MakeGridProblem<TypeParam>(4, 1).A;
  const SparseMatrix<TypeParam> negative = -A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 3109);
  Scaling<TypeParam> identity(1.0);
  Scaling<TypeParam> reflection(-1.0);
  SolveReport report;
  Vector<TypeParam> x;
  ConjugateGradient(test::MatrixOperator(negative), identity, b, {}, x, report, SerialContext());
  EXPECT_FALSE(report.Converged);
  ASSERT_EQ(report.Warnings.size(), 1u);
  EXPECT_NE(report.Warnings[0].find("matrix is not positive"), std::string::npos);

  x.resize(0);
  ConjugateGradient(test::MatrixOperator(A), reflection, b, {}, x, report, SerialContext());
  EXPECT_FALSE(report.Converged);
  ASSERT_EQ(report.Warnings.size(), 2u);
  EXPECT_NE(report.Warnings[1].find("preconditioner is not positive"), std::string::npos);
}

TYPED_TEST(AnyConjugateGradient, NumbersThatAreNotFiniteAreRefused)
{
  const auto A = test::MakeGridProblem<TypeParam>(3, 1).A;
  Scaling<TypeParam> identity(1.0);
  const auto good = test::RandomVector<TypeParam>(A.rows(), 3110);
  Vector<TypeParam> bad = good;
  bad[5] = std::numeric_limits<double>::quiet_NaN();
  SolveReport report;
  Vector<TypeParam> x;
  EXPECT_THROW(ConjugateGradient(test::MatrixOperator(A), identity, bad, {}, x, report, SerialContext()), InvalidInput);
  EXPECT_THROW(
    ConjugateGradient(test::MatrixOperator(A), identity, good, {}, bad, report, SerialContext()), InvalidInput);
  x.setZero(3);
  EXPECT_THROW(
    ConjugateGradient(test::MatrixOperator(A), identity, good, {}, x, report, SerialContext()), InvalidInput);
}

TYPED_TEST(AnyConjugateGradient, CanBeCancelledAtEveryIteration)
{
  CyclePreconditioned<TypeParam> grid(5, 3);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 3111);
  SolveReport report;
  Vector<TypeParam> x;
  const test::TbbContext all(2);
  ConjugateGradient(grid.Operator(), grid.Cycle, b, {}, x, report, all);
  EXPECT_EQ(all.Progress().size(), report.Iterations.size() - 1);
  EXPECT_TRUE(std::is_sorted(all.Progress().begin(), all.Progress().end()));
  for (std::size_t count = 1; count <= all.Progress().size(); ++count)
  {
    test::TbbContext context(2);
    context.CancelAfter(static_cast<int>(count));
    x.resize(0);
    EXPECT_THROW(ConjugateGradient(grid.Operator(), grid.Cycle, b, {}, x, report, context), Cancelled);
    EXPECT_FALSE(report.Converged);
  }
}

TYPED_TEST(AnyConjugateGradient, HasTheSameBitsForAnyNumberOfThreads)
{
  CyclePreconditioned<TypeParam> grid(8, 6);
  const auto b = test::RandomVector<TypeParam>(grid.Size(), 3112);
  SolveReport report;
  Vector<TypeParam> expected;
  ConjugateGradient(grid.Operator(), grid.Cycle, b, {}, expected, report, SerialContext());
  const double residual = report.Iterations.back().RelativeResidual;
  for (const int threads : { 1, 2, 3, 8 })
  {
    Vector<TypeParam> x;
    ConjugateGradient(grid.Operator(), grid.Cycle, b, {}, x, report, test::TbbContext(threads));
    EXPECT_EQ(x, expected) << threads << " threads";
    EXPECT_EQ(report.Iterations.back().RelativeResidual, residual);
  }
}
