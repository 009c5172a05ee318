#include "FieldSolver.h"

#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Angle between a vector of a field of N directions and one of a reference, in radians, at most pi / N.
double Turn(const TangentFrames& frames, int face, const Vector3& vector, const Vector3& reference, int N)
{
  const Complex quotient = frames.ToComplex(face, vector) / frames.ToComplex(face, reference);
  return std::abs(std::arg(std::polar(1.0, N * std::arg(quotient)))) / N;
}

Vector3 RowOf(const Points& vectors, int row)
{
  return vectors.row(row).transpose();
}

/// A line above the middle of PlaneGrid(12, 12), from one side to the other.
GuideLine Diagonal(double height)
{
  return { { Vector3(0.3, 0.4, height), Vector3(11.6, 9.7, height) } };
}

void ExpectStages(const FieldSolver& solver, int setups, int systems, int solves)
{
  const StageCounts counts = solver.Counts();
  EXPECT_EQ(counts.Setups, setups);
  EXPECT_EQ(counts.Systems, systems);
  EXPECT_EQ(counts.Solves, solves);
}

}

// On a plane a field that follows one straight line is parallel to it everywhere.
TEST(FieldSolver, FollowsAGuideLine)
{
  FieldSolver solver(PlaneGrid(12, 12).Mesh());
  FieldProblem problem;
  problem.Guides.Lines = { Diagonal(0.5) };
  problem.Stop.RelativeTolerance = 1e-12;
  const Vector3 along = problem.Guides.Lines[0].Points[1] - problem.Guides.Lines[0].Points[0];
  for (const double degrees : { 0.0, 30.0 })
  {
    problem.Rotation.Everywhere = degrees * Pi / 180.0;
    const Field& field = solver.Solve(problem);
    EXPECT_TRUE(field.Report.Converged);
    EXPECT_TRUE(field.Warnings.empty());
    EXPECT_EQ(field.Guides.Taken, 1);
    EXPECT_NEAR(field.Guides.Farthest, 0.5, 1e-12);
    EXPECT_EQ(field.Indices.cwiseAbs().maxCoeff(), 0.0);
    const TangentFrames& frames = solver.Surface().Faces;
    const Vector3 expected = Eigen::AngleAxisd(degrees * Pi / 180.0, Vector3::UnitZ()) * along;
    const Points first = solver.Directions(0), second = solver.Directions(1);
    for (int face = 0; face < first.rows(); ++face)
    {
      EXPECT_NEAR(first.row(face).norm(), 1.0, 1e-12);
      EXPECT_LT(Turn(frames, face, RowOf(first, face), expected, 4), 1e-9);
      EXPECT_NEAR(first.row(face).dot(second.row(face)), 0.0, 1e-12);
    }
  }
}

TEST(FieldSolver, AMovedGuideRepeatsNoSetup)
{
  FieldSolver solver(IrregularSphere(4, 3).Mesh());
  FieldProblem problem;
  const auto guide = [](double y) { return GuideLine{ { Vector3(-0.5, y, 1.0), Vector3(0.5, y + 0.1, 1.0) } }; };
  problem.Guides.Lines = { guide(0.1) };
  const auto first = solver.Solve(problem).Solution;
  ExpectStages(solver, 1, 1, 1);
  EXPECT_EQ(solver.Solve(problem).Solution, first);
  ExpectStages(solver, 1, 1, 1);
  problem.Guides.Lines = { guide(-0.3) };
  EXPECT_NE(solver.Solve(problem).Solution, first);
  ExpectStages(solver, 1, 2, 2);
  problem.Combing = false; // is no stage
  EXPECT_FALSE(solver.Solve(problem).IsCombed);
  ExpectStages(solver, 1, 2, 2);
  problem.Stop.RelativeTolerance = 1e-9;
  solver.Solve(problem);
  ExpectStages(solver, 1, 2, 3);
}

// Guides, arrays and features become constraints of one kind.
TEST(FieldSolver, GivesWhatItsConstraintsGive)
{
  const FramedMesh annulus(Annulus(48, 6).Mesh());
  FieldProblem whole, parts;
  whole.Stop.RelativeTolerance = parts.Stop.RelativeTolerance = 1e-11;
  whole.Guides.Lines = { GuideLine{ { Vector3(1.2, -0.3, 0.1), Vector3(1.6, 0.8, 0.1) }, { 3.0 } } };
  whole.Guides.Vectors = { GuideVector{ Vector3(-1.5, 0.1, 0.0), Vector3(0.0, 2.0, 0.0), 0.5 } };
  whole.Features.BoundaryWeight = 2.0;
  whole.Constraints.AtVertices = { { 17, Vector3(1.0, 0.0, 0.0), 1.0 } };
  parts.Constraints = whole.Constraints;
  for (const std::vector<Constraint>& directions : { FollowGuides(whole.Guides, NearestPlaces(annulus)).Directions,
         AlongBoundary(annulus.Mesh, WeightsOfFaces(annulus.Mesh, SizesOf(annulus.Mesh)), 2.0) })
  {
    parts.Constraints.OnFaces.insert(parts.Constraints.OnFaces.end(), directions.begin(), directions.end());
  }
  FieldSolver one(annulus.Mesh), other(annulus.Mesh);
  EXPECT_EQ(one.Solve(whole).OnFaces, other.Solve(parts).OnFaces);
  EXPECT_EQ(one.Solve(whole).Report.Converged, true);
}

// As those of tractions or of velocities through a surface. The normals of frames are off by a part of an angle between faces.
TEST(FieldSolver, FollowsDirectionsAtVerticesWithoutTheirNormalParts)
{
  const TriangleMesh sphere = IrregularSphere(3, 5).Mesh();
  for (const DiscretisationKind kind :
    { DiscretisationKind::VertexPowerField, DiscretisationKind::FaceField, DiscretisationKind::OneForm })
  {
    Points fields[2];
    for (const double part : { 0.0, 10.0 })
    {
      FieldProblem problem;
      problem.Options.Field.Kind = kind;
      problem.Options.Field.N = 1;
      problem.Stop.RelativeTolerance = 1e-12;
      for (int vertex = 0; vertex < sphere.NumberOfVertices(); vertex += 3)
      {
        const Vector3 at = sphere.Position(vertex).normalized();
        problem.Constraints.AtVertices.push_back({ vertex, Vector3::UnitZ().cross(at) + part * at, 1.0 });
      }
      FieldSolver solver{ TriangleMesh(sphere) };
      solver.Solve(problem);
      fields[part > 0.0 ? 1 : 0] = solver.Directions(0);
    }
    EXPECT_LT((fields[1] - fields[0]).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(FieldSolver, NormalVectorsOfASphereAreNoDirections)
{
  const FramedMesh sphere(IrregularSphere(3, 5).Mesh());
  Constraints radial;
  for (int vertex = 0; vertex < sphere.Mesh.NumberOfVertices(); ++vertex)
  {
    radial.AtVertices.push_back({ vertex, 3.0 * sphere.Mesh.Position(vertex), 1.0 });
  }
  EXPECT_EQ(LeaveOutUnusable(radial, sphere).Perpendicular, sphere.Mesh.NumberOfVertices());
  EXPECT_TRUE(radial.AtVertices.empty());
}

TEST(FieldSolver, HasPrescribedSingularitiesAndNoOthers)
{
  const TriangleMesh mesh = Icosphere(3).Mesh();
  FieldSolver solver(mesh);
  FieldProblem problem;
  problem.Singularities.emplace();
  for (int k = 0; k < 8; ++k)
  {
    problem.Singularities->push_back({ 50 * k, 1 }); // a quarter each, which sum to the Euler characteristic
  }
  const Field& field = solver.Solve(problem);
  EXPECT_TRUE(field.Warnings.empty());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const bool isSingular = vertex % 50 == 0 && vertex < 400;
    EXPECT_NEAR(field.Indices[vertex], isSingular ? 0.25 : 0.0, 1e-9);
    EXPECT_EQ(field.AtVertices[vertex] == 0.0, isSingular);
    EXPECT_EQ(field.Powers.Vertices[vertex] == 0.0, isSingular);
  }
  ExpectStages(solver, 1, 1, 1);
  problem.Singularities.reset();
  EXPECT_NE(solver.Solve(problem).Indices.cwiseAbs().maxCoeff(), 0.0);
  problem.Options.Field.Kind = DiscretisationKind::FaceField;
  problem.Singularities = std::vector<PrescribedSingularity>{ { 0, 2 } };
  EXPECT_THROW(solver.Solve(problem), InvalidInput);
}

// On faces, a grid is told, once for each solve; at points and on even triangles there is nothing to tell.
TEST(FieldSolver, WarnsOfPowerFieldsOnShearedFaces)
{
  FieldSolver grid(PlaneGrid(24, 24).Mesh()), sphere(Icosphere(3).Mesh());
  FieldProblem problem;
  problem.Constraints.OnFaces = { { 7, Vector3(1.0, 0.5, 0.0), 1.0 } };
  EXPECT_TRUE(grid.Solve(problem).Warnings.empty());
  problem.Options.Field.Kind = DiscretisationKind::PowerField;
  EXPECT_TRUE(sphere.Solve(problem).Warnings.empty());
  ASSERT_EQ(grid.Solve(problem).Warnings.size(), 1u);
  EXPECT_TRUE(grid.Solve(problem).Warnings.empty());
  problem.Options.Alignment = 2.0;
  ASSERT_EQ(grid.Solve(problem).Warnings.size(), 1u);
  EXPECT_TRUE(grid.Solve(problem).Warnings.empty());
}

TEST(FieldSolver, SaysWhatIsNotFollowed)
{
  FieldSolver solver(Icosphere(3).Mesh());
  FieldProblem problem;
  problem.Features.BoundaryWeight = 1.0;
  ASSERT_EQ(solver.Solve(problem).Warnings.size(), 1u);
  EXPECT_NE(solver.Solve(problem).Warnings[0].find("no boundary"), std::string::npos); // again
  problem.Features = {};
  problem.Guides.Lines = { GuideLine{ { Vector3(0.0, 0.0, 1.0), Vector3(9.0, 0.0, 1.0) } } };
  ASSERT_EQ(solver.Solve(problem).Warnings.size(), 1u);
  EXPECT_EQ(solver.Solve(problem).Guides.TooFar, 1);
  EXPECT_TRUE(solver.Solve(FieldProblem()).Warnings.empty());
}

// An error leaves the solver as it was.
TEST(FieldSolver, RefusesGuidesThatPrescribeNothing)
{
  FieldSolver solver(PlaneGrid(12, 12).Mesh());
  FieldProblem good;
  good.Guides.Lines = { Diagonal(0.1) };
  solver.Solve(good);
  const auto refuses = [&](const GuideLine& line, const std::string& word)
  {
    FieldProblem bad;
    bad.Guides.Lines = { line };
    try
    {
      solver.Solve(bad);
      ADD_FAILURE() << "accepted; expected " << word;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  const double nan = std::nan("");
  refuses(Diagonal(50.0), "farther from the surface");
  refuses({ { Vector3(1.0, 1.0, 0.0), Vector3(1.0, 1.0, 0.0) } }, "no length");
  refuses({ { Vector3(1.0, nan, 0.0), Vector3(1.0, 1.0, 0.0) } }, "point 0 of guide line 0");
  refuses({ { Vector3(1.0, 1.0, 0.0), Vector3(2.0, 1.0, 0.0) }, { -1.0 } }, "segment 0 of guide line 0");
  refuses({ { Vector3(1.0, 1.0, 0.0), Vector3(2.0, 1.0, 0.0) }, { 1.0, 1.0 } }, "1 segments and 2 weights");
  solver.Solve(good);
  ExpectStages(solver, 1, 1, 1);
}
