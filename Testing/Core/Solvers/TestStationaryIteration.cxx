#include "Solvers/Krylov/StationaryIteration.h"

#include "Solvers/Direct/CholeskySolver.h"
#include "Solvers/Multigrid/GalerkinCycle.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/MatrixOperator.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

using namespace dmg;

namespace
{

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

template <class Scalar>
class AnyStationaryIteration : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyStationaryIteration, Scalars);

}

TYPED_TEST(AnyStationaryIteration, CyclesAgreeWithCholesky)
{
  const auto problem = test::MakeGridProblem<TypeParam>(7, 5);
  const SparseMatrix<TypeParam>& A = problem.A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 3201);
  Vector<TypeParam> expected;
  CholeskySolver<TypeParam>(A).Solve(b, expected);
  for (const int postSweeps : { 2, 1 }) // symmetry is not needed here
  {
    CycleOptions options;
    options.Smoothing.PostSweeps = postSweeps;
    GalerkinCycle<TypeParam> cycle(SparseMatrix<TypeParam>(problem.A), problem.P, {}, options, SerialContext());
    SolveReport report;
    Vector<TypeParam> x;
    StationaryIteration(test::MatrixOperator(A), cycle, b, { 1e-12, 100 }, x, report, SerialContext());
    EXPECT_TRUE(report.Converged);
    EXPECT_LE((b - A * x).norm(), 1.001e-12 * b.norm());
    EXPECT_LE((x - expected).norm(), 1e-12 * (b.norm() / 1.2e-3 + expected.norm()));
    // The textbook's contraction of 0.1 per V(2,2)-cycle; 0.2 is ample for V(2,1).
    EXPECT_LE(report.Iterations.back().Iteration, postSweeps == 2 ? 13 : 17);
  }
}

TYPED_TEST(AnyStationaryIteration, RichardsonContractsAsComputedByHand)
{
  // A = diag(1, 2), B = I / 2: the error of the first component halves, the second is gone at once.
  SparseMatrix<TypeParam> A(2, 2);
  A.insert(0, 0) = 1.0;
  A.insert(1, 1) = 2.0;
  A.makeCompressed();
  const Vector<TypeParam> b = Vector<TypeParam>::Ones(2);
  Scaling<TypeParam> half(0.5);
  SolveReport report;
  Vector<TypeParam> x;
  StationaryIteration(test::MatrixOperator(A), half, b, { 1e-3, 100 }, x, report, SerialContext());
  for (const IterationReport& row : report.Iterations)
  {
    const double rest = std::pow(0.5, row.Iteration); // r = (rest, 0), x = (1 - rest, 1/2)
    const double energy = (1.0 - rest) * (1.0 - rest) + 0.5;
    const double expected = row.Iteration == 0 ? 1.0 : rest * std::sqrt(0.5 / energy);
    EXPECT_NEAR(row.RelativeResidual, expected, 1e-15);
  }
  EXPECT_EQ(report.Iterations.back().Iteration, 10); // 2^-10 / sqrt 3 < 1e-3 < 2^-9 / sqrt 3
}

TYPED_TEST(AnyStationaryIteration, DivergenceLeavesTheBestVector)
{
  const auto A = test::MakeGridProblem<TypeParam>(4, 1).A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 3202);
  Scaling<TypeParam> tooFar(1.0); // eigenvalues of B A up to 8
  SolveReport report;
  Vector<TypeParam> x;
  StationaryIteration(test::MatrixOperator(A), tooFar, b, { 1e-8, 100 }, x, report, SerialContext());
  EXPECT_FALSE(report.Converged);
  EXPECT_EQ(report.Iterations.back().Iteration, 10);
  EXPECT_EQ(x.norm(), 0.0) << "the start was the best";
  ASSERT_EQ(report.Warnings.size(), 1u);
}

TYPED_TEST(AnyStationaryIteration, EndsAtItsLimitAtZeroAndWhenAsked)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  GalerkinCycle<TypeParam> cycle(SparseMatrix<TypeParam>(problem.A), problem.P, {}, {}, SerialContext());
  const SparseMatrix<TypeParam>& A = problem.A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 3203);
  SolveReport report;
  Vector<TypeParam> x;
  StationaryIteration(test::MatrixOperator(A), cycle, b, { 1e-12, 3 }, x, report, SerialContext());
  EXPECT_FALSE(report.Converged);
  EXPECT_EQ(report.Iterations.size(), 4u);
  EXPECT_EQ(report.Returned, 3);
  const Vector<TypeParam> r = b - A * x;
  Vector<TypeParam> z;
  cycle.Apply(r, z, SerialContext());
  const double truth = std::sqrt(std::abs(r.dot(z)) / std::abs(x.dot(A * x)));
  EXPECT_LE(report.Iterations.back().RelativeResidual, 2.0 * truth);
  EXPECT_GE(report.Iterations.back().RelativeResidual, 0.5 * truth);

  const Vector<TypeParam> zero = Vector<TypeParam>::Zero(A.rows());
  StationaryIteration(test::MatrixOperator(A), cycle, zero, {}, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  EXPECT_EQ(x, zero);

  test::TbbContext context(2);
  context.CancelAfter(3);
  x.resize(0);
  EXPECT_THROW(StationaryIteration(test::MatrixOperator(A), cycle, b, {}, x, report, context), Cancelled);
}
