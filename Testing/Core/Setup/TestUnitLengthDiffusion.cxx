#include "Setup/UnitLengthDiffusion.h"

#include "FieldSolver.h"
#include "Setup/SetupCache.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <Eigen/Geometry>
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

/// The energy of N singularities at a e^{2 pi i k / N} in a unit disk whose boundary they follow is, but for constants and factors,
/// -(N - 1) log a - log(1 - a^{2 N}) (Bethuel, Brezis, Helein 1994, for the degree N): least where a^{2 N} = (N - 1) / (3 N - 1).
double RadiusOfBalance(int N)
{
  return std::pow((N - 1.0) / (3.0 * N - 1.0), 0.5 / N);
}

/// Points of norm 1 of the singularities.
std::vector<Vector3> PlacesOnSphere(const FramedMesh& surface, const Field& field)
{
  std::vector<Vector3> places;
  for (int face = 0; face < field.Indices.size(); ++face)
  {
    if (std::abs(field.Indices[face]) > 0.5 / field.N)
    {
      Vector3 sum = Vector3::Zero();
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        sum += surface.Mesh.Position(surface.Mesh.Tail(h));
      }
      places.push_back(sum.normalized());
    }
  }
  return places;
}

/// A field that was diffused from the smoothest one, as FieldSolver does it.
DiffusedField Diffused(const FramedMesh& surface, FieldProblem problem, const ExecutionContext& context)
{
  SetupCache setups(surface);
  FieldSolver solver(std::shared_ptr<const FramedMesh>(std::shared_ptr<void>(), &surface));
  problem.UnitLengthWhileSmoothing = false;
  const FieldSolution start = *solver.Solve(problem).Solution;
  const PlannedSetup setup = setups.Take(*start.Discretisation, problem.Options, nullptr, SerialContext());
  return DiffusedAtUnitLength(start, setup, problem.Options, surface.Mesh, problem.Stop, context);
}

}

TEST(UnitLengthDiffusion, TakesTheSingularitiesOfADiskToWhereTheyBalance)
{
  for (const DiscretisationKind kind : { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField })
  {
    for (const int N : { 2, 4 })
    {
      SCOPED_TRACE(std::to_string(static_cast<int>(kind)) + ", N = " + std::to_string(N));
      constexpr int Rings = 32;
      FieldSolver solver(IrregularDisk(Rings));
      FieldProblem problem = ProblemOf(kind, N, 1000.0);
      const std::vector<double> radii = RadiiOfSingularities(solver.Surface(), solver.Solve(problem));
      problem.UnitLengthWhileSmoothing = false; // z^N, which has them in the middle but for the irregular triangles
      const std::vector<double> former = RadiiOfSingularities(solver.Surface(), solver.Solve(problem));
      ASSERT_EQ(static_cast<int>(radii.size()), N);
      EXPECT_LT(former.back(), 0.3);
      for (int k = 0; k < N; ++k)
      {
        EXPECT_NEAR(radii[k], RadiusOfBalance(N), 2.5 / Rings); // edges, which are as irregular
      }
    }
  }
}

TEST(UnitLengthDiffusion, FindsPlacesTheMoreExactlyTheFinerTheTriangles)
{
  for (const int N : { 2, 3, 4, 6 })
  {
    SCOPED_TRACE("N = " + std::to_string(N));
    FieldSolver solver(IrregularDisk(80));
    FieldProblem problem = ProblemOf(DiscretisationKind::VertexPowerField, N, 1.0);
    problem.Options.Constraints = ConstraintKind::Hard;
    const std::vector<double> radii = RadiiOfSingularities(solver.Surface(), solver.Solve(problem));
    ASSERT_EQ(static_cast<int>(radii.size()), N);
    EXPECT_NEAR(radii.front(), RadiusOfBalance(N), 0.01);
    EXPECT_NEAR(radii.back(), RadiusOfBalance(N), 0.01);
  }
}

/// Four singularities of index 1/2 that repel each other are the corners of a regular tetrahedron, whose angles have the cosine -1/3.
TEST(UnitLengthDiffusion, MakesATetrahedronOnASphere)
{
  Surface sphere = Icosphere(5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  sphere.V = sphere.V * turn;
  sphere.V.col(2) *= 1.001;
  FieldSolver solver(sphere.Mesh());
  FieldProblem problem = ProblemOf(DiscretisationKind::VertexPowerField, 2, 0.0);
  const std::vector<Vector3> places = PlacesOnSphere(solver.Surface(), solver.Solve(problem));
  ASSERT_EQ(places.size(), 4u);
  const double degree = std::acos(-1.0) / 180.0;
  for (std::size_t a = 0; a < 4; ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      EXPECT_NEAR(std::acos(places[a].dot(places[b])) / degree, std::acos(-1.0 / 3.0) / degree, 2.0);
    }
  }
}

// Powers of two change no bit of a direction.
TEST(UnitLengthDiffusion, CountsPrescribedVectorsByTheirDirectionsAlone)
{
  const TriangleMesh mesh = IrregularDisk(16);
  for (const ConstraintKind constraints : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    FieldProblem problem = ProblemOf(DiscretisationKind::VertexPowerField, 4, 0.0);
    problem.Options.Constraints = constraints;
    FieldProblem other = problem;
    Random random(11);
    for (int v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      const Vector3 place = mesh.Position(v);
      if (place.norm() > 1.0 - 1e-9)
      {
        const Vector3 tangent(-place.y(), place.x(), 0.0);
        problem.Constraints.AtVertices.push_back({ v, tangent, 1.0 });
        const double length = std::exp2(std::floor(random.Uniform(-6.0, 6.0)));
        other.Constraints.AtVertices.push_back({ v, length * tangent, 1.0 });
      }
    }
    FieldSolver a(IrregularDisk(16)), b(IrregularDisk(16));
    EXPECT_EQ(a.Solve(problem).Solution->Unknowns, b.Solve(other).Solution->Unknowns);
  }
}

TEST(UnitLengthDiffusion, HasAnEnergyThatFallsUntilItStandsStill)
{
  const FramedMesh surface(IrregularDisk(24));
  for (const DiscretisationKind kind :
    { DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField, DiscretisationKind::FaceField })
  {
    for (const ConstraintKind constraints : { ConstraintKind::Soft, ConstraintKind::Hard })
    {
      FieldProblem problem = ProblemOf(kind, kind == DiscretisationKind::FaceField ? 1 : 4, 3.0);
      problem.Options.Constraints = constraints;
      const DiffusedField diffused = Diffused(surface, problem, SerialContext());
      ASSERT_GT(diffused.Energies.size(), 2u);
      for (const std::vector<double>& energies : diffused.Energies)
      {
        EXPECT_TRUE(std::is_sorted(energies.rbegin(), energies.rend()));
      }
      const std::vector<double>& last = diffused.Energies.back();
      ASSERT_GT(last.size(), 6u);
      EXPECT_LT(last[last.size() - 6] - last.back(), 1e-6 * (last.back() + 1.0));
    }
  }
}

TEST(UnitLengthDiffusion, ShowsProgressAndStopsWhenAsked)
{
  const FramedMesh surface(IrregularDisk(24));
  const FieldProblem problem = ProblemOf(DiscretisationKind::VertexPowerField, 4, 3.0);
  const TbbContext whole(1);
  Diffused(surface, problem, whole);
  const std::vector<double>& progress = whole.Progress();
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  ASSERT_GT(progress.size(), 20u);
  TbbContext stopped(1);
  stopped.CancelAfter(static_cast<int>(progress.size() / 2));
  EXPECT_THROW(Diffused(surface, problem, stopped), Cancelled);
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
