#include "Solvers/Krylov/ConvergenceMeasure.h"

#include "Solvers/Direct/CholeskySolver.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/StationaryIteration.h"
#include "Solvers/Multigrid/GalerkinCycle.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/MatrixOperator.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;

namespace
{

template <class Scalar>
class AnyConvergenceMeasure : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyConvergenceMeasure, Scalars);

Vector<double> PositiveMass(int size)
{
  return test::RandomVector<double>(size, 3401).array() + 1.5;
}

}

TYPED_TEST(AnyConvergenceMeasure, ColumnsEqualTheirDefinitions)
{
  // An energy |C x - d|^2, so that A = C^H C, b = C^H d and the constant is |d|^2.
  using Matrix = Eigen::Matrix<TypeParam, Eigen::Dynamic, Eigen::Dynamic>;
  const Vector<TypeParam> entries = test::RandomVector<TypeParam>(60, 3402);
  const Matrix C = Eigen::Map<const Matrix>(entries.data(), 10, 6);
  const Vector<TypeParam> d = test::RandomVector<TypeParam>(10, 3403);
  const auto x = test::RandomVector<TypeParam>(6, 3404);
  const Vector<TypeParam> b = C.adjoint() * d;
  const Vector<TypeParam> r = b - C.adjoint() * (C * x);
  ConvergenceMeasure<TypeParam> measure;
  measure.EnergyConstant = d.squaredNorm();
  IterationReport row;
  measure.Fill(row, x, b, r, SerialContext());
  EXPECT_NEAR(row.Energy, (C * x - d).squaredNorm(), 1e-13 * d.squaredNorm());
  EXPECT_NEAR(row.MassResidual, r.norm() / b.norm(), 1e-14);
  EXPECT_TRUE(std::isnan(row.Error));

  const Vector<double> mass = PositiveMass(6);
  measure.Mass = &mass;
  measure.Reference = test::RandomVector<TypeParam>(6, 3405);
  measure.Fill(row, x, b, r, SerialContext());
  const Matrix M = mass.template cast<TypeParam>().asDiagonal();
  const auto norm = [&M](const Vector<TypeParam>& v)
  { return std::sqrt(Eigen::numext::real((v.adjoint() * M * v)(0, 0))); };
  EXPECT_NEAR(row.MassResidual, norm(r) / norm(b), 1e-14);
  EXPECT_NEAR(row.Error, norm(x - measure.Reference) / norm(measure.Reference), 1e-14);
}

TYPED_TEST(AnyConvergenceMeasure, OneMassForEachPairIsTheSameForBoth)
{
  const auto x = test::RandomVector<TypeParam>(6, 3420);
  const auto b = test::RandomVector<TypeParam>(6, 3421);
  const auto r = test::RandomVector<TypeParam>(6, 3422);
  const Vector<double> ofPairs = PositiveMass(3);
  Vector<double> ofEach(6);
  ofEach << ofPairs[0], ofPairs[0], ofPairs[1], ofPairs[1], ofPairs[2], ofPairs[2];
  IterationReport rows[2];
  for (const bool arePairs : { false, true })
  {
    ConvergenceMeasure<TypeParam> measure;
    measure.Mass = arePairs ? &ofPairs : &ofEach;
    measure.Reference = b;
    measure.Fill(rows[arePairs], x, b, r, SerialContext());
  }
  EXPECT_EQ(rows[1].MassResidual, rows[0].MassResidual);
  EXPECT_EQ(rows[1].Error, rows[0].Error);
}

TYPED_TEST(AnyConvergenceMeasure, WatchesIterations)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  const SparseMatrix<TypeParam>& A = problem.A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 3406);
  GalerkinCycle<TypeParam> cycle(SparseMatrix<TypeParam>(problem.A), problem.P, {}, {}, SerialContext());
  ConvergenceMeasure<TypeParam> measure;
  measure.EnergyConstant = 3.0;
  const Vector<double> mass = PositiveMass(static_cast<int>(A.rows()));
  measure.Mass = &mass;
  CholeskySolver<TypeParam>(A).Solve(b, measure.Reference);
  const double energyOfSolution = 3.0 - std::abs(b.dot(measure.Reference));

  for (const auto solve : { &ConjugateGradient<TypeParam>, &StationaryIteration<TypeParam> })
  {
    SolveReport report, unwatched;
    Vector<TypeParam> x, same;
    solve(test::MatrixOperator(A), cycle, b, { 1e-12, 50 }, x, report, SerialContext(), &measure);
    solve(test::MatrixOperator(A), cycle, b, { 1e-12, 50 }, same, unwatched, SerialContext(), nullptr);
    EXPECT_EQ(x, same) << "watching must not change what is watched";
    ASSERT_TRUE(report.Converged);
    const IterationReport& first = report.Iterations.front();
    EXPECT_EQ(first.Energy, 3.0);
    EXPECT_DOUBLE_EQ(first.MassResidual, 1.0);
    EXPECT_DOUBLE_EQ(first.Error, 1.0);
    for (std::size_t k = 1; k < report.Iterations.size(); ++k)
    {
      // Both are minimisations of the energy; rounding errors end the descent.
      const double slack = 1e-13 * std::abs(energyOfSolution);
      EXPECT_LE(report.Iterations[k].Energy, report.Iterations[k - 1].Energy + slack);
      EXPECT_GE(report.Iterations[k].Energy, energyOfSolution - slack);
      EXPECT_TRUE(std::isnan(unwatched.Iterations[k].Energy));
    }
    const IterationReport& last = report.Iterations.back();
    EXPECT_NEAR(last.Energy, energyOfSolution, 1e-12 * std::abs(energyOfSolution));
    EXPECT_LE(last.Error, 1e-9);
    EXPECT_DOUBLE_EQ(last.Error, measure.Error(x, SerialContext()));

    // A zero right-hand side is solved by zero.
    const Vector<TypeParam> zero = Vector<TypeParam>::Zero(A.rows());
    solve(test::MatrixOperator(A), cycle, zero, {}, x, report, SerialContext(), &measure);
    ASSERT_EQ(report.Iterations.size(), 1u);
    EXPECT_EQ(report.Iterations[0].Energy, 3.0);
    EXPECT_DOUBLE_EQ(report.Iterations[0].Error, 1.0);
  }
}

TYPED_TEST(AnyConvergenceMeasure, SizesAreChecked)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  GalerkinCycle<TypeParam> cycle(SparseMatrix<TypeParam>(problem.A), problem.P, {}, {}, SerialContext());
  ConvergenceMeasure<TypeParam> measure;
  const Vector<double> mass = Vector<double>::Ones(3);
  measure.Mass = &mass;
  SolveReport report;
  Vector<TypeParam> x;
  EXPECT_THROW(ConjugateGradient(test::MatrixOperator(problem.A), cycle,
                 Vector<TypeParam>(Vector<TypeParam>::Ones(225)), {}, x, report, SerialContext(), &measure),
    InvalidInput);
}
