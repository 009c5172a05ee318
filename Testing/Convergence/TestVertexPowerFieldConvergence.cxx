// Power fields at points: conjugate gradients with a V-cycle of samples take few iterations on surfaces of any size.

#include "Support/FieldProblem.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity(); // hard constraints

/// To 1e-8.
int Iterations(const Surface& shape, int N, int prescribed, double alignment = 1.0)
{
  const TbbContext context(2);
  const FramedMesh surface(shape.Mesh(), context);
  FieldConstraints constraints;
  Random random(53);
  constraints.Values.resize(2 * prescribed);
  for (int b = 0; b < prescribed; ++b)
  {
    constraints.Elements.push_back(static_cast<int>((b + 0.5) * surface.Mesh.NumberOfVertices() / prescribed));
    constraints.Weights.push_back(1.0);
    constraints.Values[2 * b] = random.Uniform(-1.0, 1.0);
    constraints.Values[2 * b + 1] = random.Uniform(-1.0, 1.0);
  }
  FieldOptions options;
  options.Field.Kind = DiscretisationKind::VertexPowerField;
  options.Field.N = N;
  options.Constraints = std::isfinite(alignment) ? ConstraintKind::Soft : ConstraintKind::Hard;
  options.Alignment = std::isfinite(alignment) ? alignment : 1.0;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  FieldProblem problem(surface, nullptr, constraints, options, context);
  problem.Solve(constraints.Values, {}, { 1e-8, 100 }, context);
  EXPECT_TRUE(problem.Report().Converged);
  return static_cast<int>(problem.Report().Iterations.size()) - 1;
}

}

TEST(VertexPowerFieldConvergence, DoesNotDependOnSize)
{
  for (int N : { 1, 2, 4, 6 })
  {
    for (int prescribed : { 1, 20, 100, 4096 })
    {
      SCOPED_TRACE(N);
      SCOPED_TRACE(prescribed);
      const int small = Iterations(IrregularSphere(5, 3), N, prescribed); // 10,242 vertices
      const int large = Iterations(IrregularSphere(6, 3), N, prescribed); // 40,962
      EXPECT_LE(small, 9);
      EXPECT_LE(large, 9);
      EXPECT_LE(large, small + 2);
    }
  }
}

TEST(VertexPowerFieldConvergence, DoesNotDependOnGenus)
{
  for (int N : { 1, 2, 4, 6 })
  {
    SCOPED_TRACE(N);
    EXPECT_LE(Iterations(IrregularTorus(200, 80, 4), N, 20), 9);
    EXPECT_LE(Iterations(DoubleTorus(16), N, 20), 9);
    EXPECT_LE(Iterations(PerforatedSlab(5, 1, 8), N, 20), 9);
    EXPECT_LE(Iterations(Flattened(DoubleTorus(16), 0.1), N, 20), 9);
  }
}

TEST(VertexPowerFieldConvergence, IsFastWithBoundaries)
{
  for (int N : { 1, 2, 4, 6 })
  {
    for (int prescribed : { 1, 20, 100, 960 })
    {
      SCOPED_TRACE(N);
      SCOPED_TRACE(prescribed);
      EXPECT_LE(Iterations(IrregularPlane(120, 80, 5), N, prescribed), 12);
      EXPECT_LE(Iterations(Disk(60), N, prescribed), 12);
      EXPECT_LE(Iterations(Annulus(300, 40), N, prescribed), 12);
    }
  }
}

TEST(VertexPowerFieldConvergence, DoesNotDependOnAlignment)
{
  for (int N : { 1, 2, 4, 6 })
  {
    for (double alignment : { 1e-6, 1e-3, 1e-1, 1e1, 1e2, 1e3, 1e6, Infinity })
    {
      SCOPED_TRACE(N);
      SCOPED_TRACE(alignment);
      EXPECT_LE(Iterations(IrregularSphere(5, 3), N, alignment == 1e2 ? 1000 : 20, alignment), 9);
    }
  }
}

/// Cycles take more iterations, and reach the tolerance.
TEST(VertexPowerFieldConvergence, HoldsOnThinTrianglesThatAreCut)
{
  for (int N : { 1, 4 })
  {
    Iterations(Subdivide(Subdivide(Subdivide(PlaneWithThinTriangles(24, 16)))), N, 100);
  }
}
