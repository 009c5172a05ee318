// Problems that are difficult for cycles: triangles without area or much too long, and fields that little determines.

#include "Solvers/HarmonicProblem.h"

#include "Analysis/HarmonicForms.h"
#include "PreparedField.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace dmg;
using namespace dmg::test;

// Cotangents of faces without area make matrices of 1-forms so uneven that rounding errors alone
// are 1e-9 or so of a right-hand side.
TEST(HarmonicProblem, IsSolvedOnFacesWithoutArea)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(SphereWithZeroAreaFaces(3, 12), kind);
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      const Elements elements = on.Every(47);
      const Vector<double> values = on.RandomValues(elements, 3710);
      for (const double smoothness : { 1.0, 0.05, 30.0 })
      {
        const FieldWeights weights = { smoothness, 1.5, constraints };
        FieldProblem factored = on.Factored(elements, weights);
        const Vector<double> expected = factored.Solve(values, {}, {}, SerialContext());
        const double best = factored.Report().Iterations.back().Energy;
        HarmonicProblem problem = on.Problem(elements, weights);
        const Vector<double> field = problem.Solve(values, {}, {}, {}, SerialContext());
        EXPECT_TRUE(problem.Report().Converged);
        EXPECT_LE((field - expected).norm(), 1e-3 * expected.norm());
        EXPECT_NEAR(problem.Report().Iterations.back().Energy, best, 1e-7 * std::abs(best));
      }
    }
  }
}

// A torus has two harmonic fields, which a face or two hold weakly. Cycles know them.
TEST(HarmonicProblem, IsSolvedForFewPrescriptionsOnATorus)
{
  for (const DiscretisationKind kind : Squares)
  {
    const PreparedField on(IrregularTorus(56, 24, 4), kind);
    EXPECT_EQ(on.Levels->Kernel.cols(), 2);
    for (const ConstraintKind constraints : BothConstraints)
    {
      SCOPED_TRACE(Describe(kind, constraints));
      const Elements elements = { { 7, 200, 901 }, { 1.0, 0.01, 1.0 } };
      const FieldWeights weights = { 100.0, 0.01, constraints };
      const Vector<double> values = on.RandomValues(elements, 3707);
      HarmonicProblem problem = on.Problem(elements, weights);
      const Vector<double> field = problem.Solve(values, {}, {}, {}, SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      EXPECT_LE(problem.Report().Iterations.back().Iteration, 15);
      FieldProblem factored = on.Factored(elements, weights);
      const Vector<double> expected = factored.Solve(values, {}, Tight(), SerialContext());
      EXPECT_LE((field - expected).norm(), 1e-4 * expected.norm());
    }
  }
}

// One edge determines one of the two harmonic fields of a torus: their combination that is largest
// there, as the other vanishes there and is left out. It costs nothing and meets the prescription.
TEST(HarmonicProblem, LeavesOutHarmonicFieldsThatNothingDetermines)
{
  const PreparedField on(IrregularTorus(28, 14, 4), DiscretisationKind::OneForm);
  const int edge = 7;
  const double value = 2.5;
  const Vector<double> values = Vector<double>::Constant(1, value);
  const Eigen::MatrixXd basis = HarmonicForms(on.Mesh, SerialContext());
  const Vector<double> there = basis.row(edge).transpose();
  const Vector<double> expected = value / there.squaredNorm() * (basis * there);
  for (const ConstraintKind constraints : BothConstraints)
  {
    SCOPED_TRACE(Describe(on.Kind, constraints));
    const Elements elements = { { edge }, { 1.0 } };
    const FieldWeights weights = { 1.0, 1.0, constraints };
    const auto expectIt = [&](const Vector<double>& field, const SolveReport& report)
    {
      EXPECT_TRUE(report.Converged);
      ASSERT_EQ(report.Warnings.size(), 1u) << report.Solver;
      EXPECT_NE(report.Warnings[0].find("1 of the 2 harmonic fields"), std::string::npos);
      EXPECT_LE((field - expected).norm(), 1e-6 * expected.norm()) << report.Solver;
    };
    HarmonicProblem problem = on.Problem(elements, weights);
    expectIt(problem.Solve(values, {}, {}, {}, SerialContext()), problem.Report());
    FieldProblem factored = on.Factored(elements, weights);
    expectIt(factored.Solve(values, {}, {}, SerialContext()), factored.Report());
  }
}

// Thin triangles: a torus that is stretched a thousand times.
TEST(HarmonicProblem, AFactorTakesOverWhereCyclesDoNotConverge)
{
  Surface stretched = IrregularTorus(28, 14, 4);
  stretched.V.col(2) *= 1e3;
  const PreparedField on(stretched, DiscretisationKind::FaceField);
  for (const ConstraintKind constraints : BothConstraints)
  {
    const Elements elements = on.Every(31);
    const FieldWeights weights = { 0.3, 2.0, constraints };
    const StoppingCriteria stop = { 1e-10, 100 };
    HarmonicProblem problem = on.Problem(elements, weights);
    for (const unsigned seed : { 3730U, 3731U })
    {
      const Vector<double> values = on.RandomValues(elements, seed);
      const Vector<double> field = problem.Solve(values, {}, {}, stop, SerialContext());
      EXPECT_TRUE(problem.Report().Converged);
      ASSERT_EQ(problem.Report().Warnings.size(), 1u);
      EXPECT_NE(problem.Report().Warnings[0].find("a factor of the system took over"), std::string::npos);
      const Vector<double> expected = on.Factored(elements, weights).Solve(values, {}, Tight(), SerialContext());
      // Energies of the smoothest fields are by the square of the stretch smaller than those of rough ones.
      EXPECT_LE((field - expected).norm(), 1e3 * stop.RelativeTolerance * expected.norm());
    }
    // Who allows few iterations gets no factor after them.
    problem.Update(on.Prescribed(elements, weights), weights.Smoothness, SerialContext());
    problem.Solve(on.RandomValues(elements, 3730), {}, {}, { 1e-8, 2 }, SerialContext());
    EXPECT_FALSE(problem.Report().Converged);
    ASSERT_EQ(problem.Report().Warnings.size(), 1u);
    // Where V-cycles are asked for, they are all that there is.
    HarmonicProblem cycles = on.Problem(elements, weights, SolverKind::VCycles);
    cycles.Solve(on.RandomValues(elements, 3730), {}, {}, stop, SerialContext());
    EXPECT_FALSE(cycles.Report().Converged);
    EXPECT_EQ(cycles.Report().Warnings.size(), 1u);
  }
}

// Below rounding cycles stagnate, but that is where the solution is.
TEST(HarmonicProblem, NoFactorTakesOverWhereRoundingEndsCycles)
{
  for (const DiscretisationKind kind : AllKinds)
  {
    const PreparedField on(IrregularTorus(28, 14, 4), kind);
    const Elements elements = on.Every(31);
    HarmonicProblem problem = on.Problem(elements, {});
    problem.Solve(on.RandomValues(elements, 3732), {}, {}, { 1e-18, 100 }, SerialContext());
    const SolveReport& report = problem.Report();
    EXPECT_FALSE(report.Converged);
    EXPECT_LE(report.Iterations[report.Returned].RelativeResidual, 1e-13);
    ASSERT_EQ(report.Warnings.size(), 1u);
    EXPECT_NE(report.Warnings[0].find("rounding errors forbid"), std::string::npos);
  }
}
