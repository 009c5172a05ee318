// Conjugate gradients with a linear V-cycle take a number of iterations that does not grow with the
// surface: generated families, each cut 1:4 several times.

#include "Support/FieldProblem.h"
#include "Support/LinearLevels.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity(); // hard constraints

/// Both ways to make the levels.
class PowerFieldConvergence : public ::testing::TestWithParam<LevelKind>
{
};

int Iterations(LevelKind levels, const Surface& shape, int N, int prescribedFaces, double alignment = 1.0)
{
  const TbbContext context(2);
  const FramedMesh surface(shape.Mesh());
  const ProlongationOperators operators =
    LinearLevels(levels, surface.Mesh, HierarchyOptions(), DefaultSampleDistance, context);
  FieldConstraints constraints;
  Random random(53);
  constraints.Values.resize(2 * prescribedFaces);
  for (int b = 0; b < prescribedFaces; ++b)
  {
    constraints.Elements.push_back(static_cast<int>((b + 0.5) * surface.Mesh.NumberOfFaces() / prescribedFaces));
    constraints.Weights.push_back(1.0);
    constraints.Values[2 * b] = random.Uniform(-1.0, 1.0);
    constraints.Values[2 * b + 1] = random.Uniform(-1.0, 1.0);
  }
  FieldOptions options = PowersOnFaces();
  options.Field.N = N;
  options.Constraints = std::isfinite(alignment) ? ConstraintKind::Soft : ConstraintKind::Hard;
  options.Alignment = std::isfinite(alignment) ? alignment : 1.0;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  FieldProblem problem(surface, &operators, constraints, options, context);
  problem.Solve(constraints.Values, {}, StoppingCriteria(), context);
  EXPECT_TRUE(problem.Report().Converged);
  return static_cast<int>(problem.Report().Iterations.size()) - 1;
}

}

TEST_P(PowerFieldConvergence, DoesNotDependOnSize)
{
  for (int N : { 1, 2, 4, 6 })
  {
    for (int prescribed : { 1, 20, 100, 4096 })
    {
      SCOPED_TRACE(N);
      SCOPED_TRACE(prescribed);
      const int small = Iterations(GetParam(), IrregularSphere(5, 3), N, prescribed); // 20,480
      const int large = Iterations(GetParam(), IrregularSphere(6, 3), N, prescribed); // 81,920
      EXPECT_LE(small, 12);
      EXPECT_LE(large, 12);
      EXPECT_LE(large, small + 2);
    }
  }
}

TEST_P(PowerFieldConvergence, DoesNotDependOnGenus)
{
  for (int N : { 1, 2, 4, 6 })
  {
    SCOPED_TRACE(N);
    EXPECT_LE(Iterations(GetParam(), IrregularTorus(200, 80, 4), N, 20), 12); // 32,000 faces
    EXPECT_LE(Iterations(GetParam(), DoubleTorus(16), N, 20), 12);
  }
}

TEST_P(PowerFieldConvergence, IsAlmostAsFastOnThinSurfacesAndWithBoundaries)
{
  for (int N : { 1, 2, 4, 6 })
  {
    for (int prescribed : { 1, 20, 100, 960 })
    {
      SCOPED_TRACE(N);
      SCOPED_TRACE(prescribed);
      EXPECT_LE(Iterations(GetParam(), Flattened(DoubleTorus(16), 0.1), N, prescribed), 20);
      EXPECT_LE(Iterations(GetParam(), IrregularPlane(120, 80, 5), N, prescribed), 20);
    }
  }
}

/// Cycles take more iterations, and reach the tolerance.
TEST_P(PowerFieldConvergence, HoldsOnThinTrianglesThatAreCut)
{
  for (int N : { 1, 2, 4, 6 })
  {
    for (int prescribed : { 1, 20, 100, 2048 })
    {
      SCOPED_TRACE(N);
      SCOPED_TRACE(prescribed);
      Iterations(GetParam(), Subdivide(Subdivide(Subdivide(PlaneWithThinTriangles(24, 16)))), N, prescribed);
    }
  }
}

TEST_P(PowerFieldConvergence, DoesNotDependOnAlignment)
{
  for (int N : { 1, 2, 4, 6 })
  {
    for (double alignment : { 1e-6, 1e-3, 1e-1, 1e1, 1e2, 1e3, 1e6, Infinity })
    {
      SCOPED_TRACE(N);
      SCOPED_TRACE(alignment);
      const int prescribed = alignment == 1e2 ? 1000 : 20;
      EXPECT_LE(Iterations(GetParam(), IrregularSphere(5, 3), N, prescribed, alignment), 12);
    }
  }
}

/// Parallel fields cost nothing there, and so weak pulls little: rounding errors in the cycle must not decide.
TEST_P(PowerFieldConvergence, IsFastOnAPlaneUnderWeakPulls)
{
  const Surface plane = Subdivide(IrregularPlane(120, 80, 4)); // 76,800
  for (int N : { 1, 2, 4, 6 })
  {
    SCOPED_TRACE(N);
    EXPECT_LE(Iterations(GetParam(), plane, N, 20, 1e-5), 12);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, PowerFieldConvergence,
  ::testing::Values(LevelKind::EdgeCollapses, LevelKind::Sampling),
  [](const auto& info) { return info.param == LevelKind::Sampling ? "Sampling" : "EdgeCollapses"; });
