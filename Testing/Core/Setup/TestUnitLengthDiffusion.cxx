#include "Setup/UnitLengthDiffusion.h"

#include "FieldSolver.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

FieldProblem ProblemOf(DiscretisationKind kind, int N, double boundaryWeight)
{
  FieldProblem problem;
  problem.Options.Field.Kind = kind;
  problem.Options.Field.N = N;
  problem.Features.BoundaryWeight = boundaryWeight;
  problem.UnitLengthWhileSmoothing = true;
  return problem;
}

/// A unit disk that no rotation takes to itself: a symmetric one keeps all singularities in its middle, where they balance.
TriangleMesh IrregularDisk(int rings)
{
  Surface disk = Disk(rings);
  Random random(5);
  for (int v = 0; v < disk.V.rows(); ++v)
  {
    const Vector3 shift(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), 0.0);
    disk.V.row(v) += (disk.V.row(v).norm() < 1.0 - 0.5 / rings ? 1.0 : 0.0) / rings * shift.transpose();
  }
  return disk.Mesh();
}

/// How far the singularities of a field on a surface in the plane are from the origin, ascending.
std::vector<double> RadiiOfSingularities(const FramedMesh& surface, const Field& field)
{
  std::vector<double> radii;
  const Points& points = surface.Mesh.VertexPositions();
  for (int element = 0; element < field.Indices.size(); ++element)
  {
    if (std::abs(field.Indices[element]) < 0.5 / field.N)
    {
      continue;
    }
    Vector3 place = Vector3::Zero();
    for (int h = 3 * element; field.AreSingularitiesOnFaces && h < 3 * element + 3; ++h)
    {
      place += points.row(surface.Mesh.Tail(h)).transpose() / 3.0;
    }
    radii.push_back(field.AreSingularitiesOnFaces ? place.norm() : points.row(element).norm());
  }
  std::sort(radii.begin(), radii.end());
  return radii;
}

}

/// The energy of N singularities at a e^{2 pi i k / N} in a unit disk whose boundary they follow is, but for constants and factors,
/// -(N - 1) log a - log(1 - a^{2 N}) (Bethuel, Brezis, Helein 1994, for the degree N): least where a^{2 N} = (N - 1) / (3 N - 1).
TEST(UnitLengthDiffusion, TakesTheSingularitiesOfADiskToWhereTheyBalance)
{
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField })
  {
    for (const int N : { 2, 4 })
    {
      SCOPED_TRACE(std::to_string(static_cast<int>(kind)) + ", N = " + std::to_string(N));
      FieldSolver solver(IrregularDisk(32));
      FieldProblem problem = ProblemOf(kind, N, 1000.0);
      const std::vector<double> radii = RadiiOfSingularities(solver.Surface(), solver.Solve(problem));
      problem.UnitLengthWhileSmoothing = false; // z^N, which has them in the middle but for the irregular triangles
      const std::vector<double> former = RadiiOfSingularities(solver.Surface(), solver.Solve(problem));
      ASSERT_EQ(static_cast<int>(radii.size()), N);
      EXPECT_LT(former.back(), 0.3);
      const double expected = std::pow((N - 1.0) / (3.0 * N - 1.0), 0.5 / N);
      for (int k = 0; k < N; ++k)
      {
        // Two of them are still on their way when the steps end, as they move the slower the farther they are from each other.
        EXPECT_NEAR(radii[k], expected, N == 4 ? 0.1 : 0.25);
      }
    }
  }
}

TEST(UnitLengthDiffusion, LeavesAConstantFieldAsItIs)
{
  const Eigen::RowVector3d direction(0.6, 0.8, 0.0);
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField })
  {
    FieldSolver solver(IrregularPlane(20, 16, 7).Mesh());
    FieldProblem problem = ProblemOf(kind, 1, 0.0);
    problem.Stop = { 1e-9, 100 };
    problem.Constraints.OnFaces = { { 17, direction, 3.0 } };
    solver.Solve(problem);
    EXPECT_LT((solver.Directions(0).rowwise() - direction).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(UnitLengthDiffusion, KeepsHardDirectionsAndHasTheLengthOne)
{
  FieldSolver solver(IrregularSphere(3, 5).Mesh());
  FieldProblem problem = ProblemOf(DiscretisationKind::PowerField, 4, 0.0);
  problem.Options.Constraints = ConstraintKind::Hard;
  problem.UnitLength = false;
  problem.Constraints.OnFaces = { { 3, Vector3(1.0, 2.0, 3.0), 1.0 }, { 400, Vector3(3.0, -1.0, 1.0), 1.0 } };
  FieldProblem plain = problem;
  plain.UnitLengthWhileSmoothing = false;
  const Vector<Complex> powers = solver.Solve(problem).Powers.Faces;
  const Vector<Complex> given = solver.Solve(plain).Powers.Faces;
  for (const int face : { 3, 400 })
  {
    EXPECT_LT(std::abs(powers[face] - given[face] / std::abs(given[face])), 1e-9);
  }
  const Vector<double> lengths = powers.cwiseAbs();
  EXPECT_LT(lengths.maxCoeff(), 1.0 + 1e-3);
  EXPECT_GT(lengths.mean(), 0.8);
}

TEST(UnitLengthDiffusion, IsDoneOnceAndHasTheSameBitsForAnyNumberOfThreads)
{
  const FieldProblem problem = ProblemOf(DiscretisationKind::VertexPowerField, 4, 1.0);
  FieldSolver solver(Disk(20).Mesh());
  const Vector<double> expected = solver.Solve(problem).Solution->Unknowns;
  const auto former = solver.Solve(problem).Solution;
  EXPECT_EQ(solver.Solve(problem).Solution, former);
  for (const int threads : { 1, 3 })
  {
    const TbbContext context(threads);
    FieldSolver other(Disk(20).Mesh(), context);
    EXPECT_EQ(other.Solve(problem, context).Solution->Unknowns, expected);
  }
}

// A symmetric disk keeps its singularities in balance in the middle, where the least difference decides where they go.
TEST(UnitLengthDiffusion, DoesNotDependOnFormerSolves)
{
  FieldProblem problem = ProblemOf(DiscretisationKind::VertexPowerField, 4, 3.0);
  problem.Options.Solver.Kind = SolverKind::ConjugateGradients;
  problem.Constraints.OnFaces = { { 17, Vector3(1.0, 2.0, 0.0), 1.0 } };
  FieldProblem otherDirection = problem, withoutDiffusion = problem, otherFace = problem, otherWeight = problem;
  otherDirection.Constraints.OnFaces[0].Direction = Vector3(2.0, 1.0, 0.0);
  withoutDiffusion.UnitLengthWhileSmoothing = false;
  otherFace.Constraints.OnFaces[0].Element = 99;
  otherWeight.Features.BoundaryWeight = 0.1;
  FieldSolver fresh(Disk(40).Mesh());
  const Vector<double> expected = fresh.Solve(problem).Solution->Unknowns;
  FieldSolver solver(Disk(40).Mesh());
  solver.Solve(otherDirection);
  for (const FieldProblem& former : { withoutDiffusion, otherDirection, otherFace, otherWeight })
  {
    solver.Solve(former);
    EXPECT_EQ(solver.Solve(problem).Solution->Unknowns, expected);
  }
}

TEST(UnitLengthDiffusion, IsNothingForNumbersOnEdges)
{
  FieldSolver solver(Disk(8).Mesh());
  FieldProblem problem = ProblemOf(DiscretisationKind::OneForm, 1, 1.0);
  const Vector<double> field = solver.Solve(problem).Solution->Unknowns;
  problem.UnitLengthWhileSmoothing = false;
  EXPECT_EQ(solver.Solve(problem).Solution->Unknowns, field);
}
