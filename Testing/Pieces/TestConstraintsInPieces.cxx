#include "Pieces/Constraints/ConstraintsInPieces.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Partitions.h"
#include "ProblemConstraints.h"
#include "ProblemsInPieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace dmg;

namespace
{

/// All that is prescribed on a triangle.
struct OnTriangle
{
  int Number = 0;
  double Weight = 0.0;
  Vector3 Sum = Vector3::Zero(); // of directions, with weights

  void Add(const Constraint& constraint)
  {
    ++this->Number;
    this->Weight += constraint.Weight;
    this->Sum += constraint.Weight * constraint.Direction;
  }
};

std::map<int, OnTriangle> ByTriangle(const std::vector<Constraint>& onFaces)
{
  std::map<int, OnTriangle> sums;
  for (const Constraint& constraint : onFaces)
  {
    sums[constraint.Element].Add(constraint);
  }
  return sums;
}

/// The same surface with its triangles in the order of the ranks that have them: what pieces are compared with.
test::Surface InOrderOfRanks(const test::Surface& surface, const test::NamedPartition& partition, int numberOfRanks)
{
  test::Surface ordered = surface;
  Eigen::Index next = 0;
  for (int rank = 0; rank < numberOfRanks; ++rank)
  {
    for (const int triangle : test::CutOut(surface, partition.RanksOfTriangles(surface, numberOfRanks), rank).Triangles)
    {
      ordered.F.row(next++) = surface.F.row(triangle);
    }
  }
  return ordered;
}

void CheckReports(const GuidesReport& here, const GuidesReport& whole, double diagonal)
{
  EXPECT_EQ(here.Taken, whole.Taken);
  EXPECT_EQ(here.TooFar, whole.TooFar);
  EXPECT_EQ(here.OnFarSide, whole.OnFarSide);
  EXPECT_EQ(here.Perpendicular, whole.Perpendicular);
  EXPECT_NEAR(here.Farthest, whole.Farthest, 1e-12 * diagonal);
  EXPECT_NEAR(here.MaximumDistance, whole.MaximumDistance, 1e-12 * diagonal);
}

/// Expects that what is prescribed on own triangles is what one process prescribes there.
void CheckDirections(
  const std::vector<Constraint>& here, const std::vector<Constraint>& whole, const test::CutPiece& cut)
{
  const std::map<int, OnTriangle> ofHere = ByTriangle(here), ofWhole = ByTriangle(whole);
  for (std::size_t i = 0; i < cut.Triangles.size(); ++i)
  {
    const auto at = ofHere.find(static_cast<int>(i));
    const auto expected = ofWhole.find(cut.Triangles[i]);
    const OnTriangle a = at == ofHere.end() ? OnTriangle() : at->second;
    const OnTriangle b = expected == ofWhole.end() ? OnTriangle() : expected->second;
    EXPECT_EQ(a.Number, b.Number) << "triangle " << cut.Triangles[i];
    EXPECT_NEAR(a.Weight, b.Weight, 1e-8 * (a.Weight + b.Weight)) << "triangle " << cut.Triangles[i];
    EXPECT_LE((a.Sum - b.Sum).norm(), 1e-8 * (a.Weight + b.Weight)) << "triangle " << cut.Triangles[i];
  }
}

/// Checks a problem on one partition of a surface.
void Check(const test::Surface& given, FieldProblem problem, const test::NamedPartition& partition)
{
  SCOPED_TRACE(partition.Name);
  const Ranks ranks(MPI_COMM_WORLD);
  const test::Surface surface = InOrderOfRanks(given, partition, ranks.Size());
  std::vector<int> sizes;
  for (const int rank : partition.RanksOfTriangles(given, ranks.Size()))
  {
    sizes.resize(ranks.Size());
    ++sizes[rank];
  }
  std::vector<int> rankOfTriangles;
  for (int rank = 0; rank < ranks.Size(); ++rank)
  {
    rankOfTriangles.insert(rankOfTriangles.end(), sizes[rank], rank);
  }
  const test::CutPiece cut = test::CutOut(surface, rankOfTriangles, ranks.Rank());
  const FramedMesh whole(surface.Mesh());
  const auto discretisation = MakeDiscretisation(problem.Options.Field, whole);
  const FollowedConstraints expected = ConstraintsOnMesh(whole).Follow(problem, *discretisation, SerialContext(), {});

  const PieceOfSurface piece(ranks, cut.Piece, {}, SerialContext());
  ConstraintsInPieces constraints(piece);
  const auto ofPiece = MakeDiscretisation(problem.Options.Field, piece.Surface(), &piece.Connection());
  const FollowedConstraints here =
    constraints.Follow(test::OfPiece(problem, cut, surface), *ofPiece, SerialContext(), {});
  CheckDirections(here.Constraints.OnFaces, expected.Constraints.OnFaces, cut);
  CheckReports(here.Guides, expected.Guides, SizesOf(whole.Mesh).Diagonal());
  EXPECT_EQ(here.Warnings.size(), expected.Warnings.size());
  for (std::size_t i = 0; i < here.Warnings.size() && i < expected.Warnings.size(); ++i)
  {
    EXPECT_EQ(here.Warnings[i].substr(0, 30), expected.Warnings[i].substr(0, 30));
    EXPECT_NO_THROW(ranks.CheckSame(here.Warnings[i], "the warning"));
  }
}

void CheckOnAllPartitions(const test::Surface& surface, const FieldProblem& problem)
{
  for (const test::NamedPartition& partition : test::Partitions())
  {
    Check(surface, problem, partition);
  }
}

/// Polylines and vectors near random places of a surface, within an offset.
Guides SomeGuides(const TriangleMesh& mesh, double offset, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::uniform_int_distribution<int> anyVertex(0, mesh.NumberOfVertices() - 1);
  const auto around = [&](const Vector3& place)
  { return Vector3(place + offset * Vector3(any(random), any(random), any(random))); };
  const auto placeAlong = [&](int vertex, int steps)
  {
    std::vector<Vector3> places;
    for (int i = 0; i < steps; ++i)
    {
      places.push_back(around(mesh.Position(vertex)));
      for (int k = 0; k < 4; ++k) // some edges further
      {
        vertex = mesh.Head(mesh.OutgoingHalfedge(vertex));
      }
    }
    return places;
  };
  Guides guides;
  for (int line = 0; line < 6; ++line)
  {
    guides.Lines.push_back({ placeAlong(anyVertex(random), 8), { 1.0 + line } });
  }
  // One from side to side, far from the surface in its middle, and one that comes from afar.
  guides.Lines.push_back({ { around(mesh.Position(anyVertex(random))), around(mesh.Position(anyVertex(random))) } });
  guides.Lines.push_back({ { around(mesh.Position(anyVertex(random))), Vector3(1e30, 2e29, -1e28) } });
  guides.Lines[2].Direction = Vector3(0.3, -0.2, 0.5);
  for (int vector = 0; vector < 20; ++vector)
  {
    guides.Vectors.push_back(
      { around(mesh.Position(anyVertex(random))), Vector3(any(random), any(random), any(random)), 0.5 + vector });
  }
  guides.Vectors.push_back({ Vector3(50.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0) });
  return guides;
}

}

TEST(ConstraintsInPieces, HoldWhatGuidesHoldOnOneProcess)
{
  struct Distances
  {
    double Offset; // in mean edges
    double Maximum;
  };
  for (const test::Surface& surface :
    { test::IrregularSphere(4, 3), test::IrregularPlane(30, 20, 5), test::DoubleTorus(6) })
  {
    const TriangleMesh mesh = surface.Mesh();
    for (const auto& [offset, maximum] : { Distances{ 0.3, 0.1 }, Distances{ 4.0, 0.01 }, Distances{ 4.0, 0.1 } })
    {
      SCOPED_TRACE("offset " + std::to_string(offset) + ", maximum " + std::to_string(maximum));
      FieldProblem problem;
      problem.Guides = SomeGuides(mesh, offset * SizesOf(mesh).MeanEdge, 7);
      problem.Guides.MaximumDistance = maximum;
      Check(surface, problem, test::Partitions()[1]);
      Check(surface, problem, test::Partitions()[offset > 1.0 ? 2 : 0]);
    }
  }
}

// Two sheets, each of which another rank has where there are two.
TEST(ConstraintsInPieces, GuidesTakeTheSameOfTwoSheetsAsOnOneProcess)
{
  const test::Surface sheet = test::IrregularPlane(30, 30, 5);
  const double edge = SizesOf(sheet.Mesh()).MeanEdge;
  const test::Surface sheets = test::Union(sheet, sheet, Vector3(0.1 * edge, 0.2 * edge, 0.8 * edge));
  const TriangleMesh mesh = sheets.Mesh();
  const SurfaceSizes sizes = SizesOf(mesh);
  FieldProblem problem;
  const auto at = [&](double x, double y, double height) -> Vector3
  {
    return { sizes.Lower[0] + x * (sizes.Upper[0] - sizes.Lower[0]),
      sizes.Lower[1] + y * (sizes.Upper[1] - sizes.Lower[1]), height * edge };
  };
  for (const double height : { 0.1, 0.3, 0.39, 0.42, 0.6, 1.0 })
  {
    problem.Guides.Lines.push_back({ { at(0.11, height, height), at(0.93, 0.21, height) }, { 1.0 + height } });
  }
  problem.Guides.Lines.push_back({ { at(0.1, 0.15, -0.2), at(0.52, 0.83, 1.3), at(0.87, 0.13, 0.37) } });
  for (int i = 1; i < 20; ++i)
  {
    problem.Guides.Vectors.push_back({ at(0.04 * i, 0.37, 0.05 * i), Vector3(1.0, 0.3 * i, 0.1) });
  }
  CheckOnAllPartitions(sheets, problem);
}

TEST(ConstraintsInPieces, GuidesThatMissAreReported)
{
  FieldProblem problem;
  problem.Guides.Vectors = { { Vector3(50.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0) } };
  problem.Guides.Lines = { { { Vector3(50.0, 0.0, 0.0), Vector3(60.0, 1.0, 0.0) } } };
  problem.Guides.MayMiss = true;
  CheckOnAllPartitions(test::IrregularSphere(3, 3), problem);
  problem.Guides.Vectors.push_back({ Vector3(1e200, 1e200, 0.0), Vector3(0.0, 1.0, 0.0) });
  CheckOnAllPartitions(test::IrregularSphere(3, 3), problem);
}

TEST(ConstraintsInPieces, FeaturesAreThoseOfOneProcess)
{
  FieldProblem problem;
  problem.Features.BoundaryWeight = 2.0;
  problem.Features.BoundaryRotation = 20.0;
  problem.Features.SharpEdgesWeight = 3.0;
  problem.Features.SharpEdgesRotation = 40.0;
  problem.Features.FeatureAngle = 15.0;
  problem.Features.CurvatureWeight = 0.5;
  problem.Features.CurvatureRotation = 10.0;
  for (const test::Surface& surface : { test::Annulus(30, 6), test::Prism(12, 8), test::IrregularTorus(60, 30, 4),
         test::PerforatedSlab(2, 2, 3), test::Icosphere(3) })
  {
    for (const int N : { 1, 4 })
    {
      problem.Options.Field.N = N;
      CheckOnAllPartitions(surface, problem);
    }
  }
}

TEST(ConstraintsInPieces, PrincipalDirectionsOfAllScalesAreThoseOfOneProcess)
{
  FieldProblem problem;
  problem.Features.CurvatureWeight = 1.0;
  // On the needle, regions are limited by their number of vertices.
  for (const test::Surface& surface :
    { test::IrregularTorus(40, 20, 4), test::Needle(3, 20.0), test::IrregularPlane(20, 20, 5) })
  {
    for (const double scale : { 0.0, 1.0, 3.0, 6.0 })
    {
      SCOPED_TRACE("scale " + std::to_string(scale));
      problem.Features.CurvatureScale = scale;
      Check(surface, problem, test::Partitions()[1]);
      Check(surface, problem, test::Partitions()[3]);
    }
  }
}

TEST(ConstraintsInPieces, RotationsSmoothingLengthAndCancellingAreThoseOfOneProcess)
{
  const test::Surface surface = test::IrregularSphere(3, 3);
  const TriangleMesh mesh = surface.Mesh();
  FieldProblem problem;
  problem.Options.Field.N = 1;
  problem.SmoothingLength = 0.1;
  problem.Features.BoundaryWeight = 1.0;
  for (int face = 0; face < mesh.NumberOfFaces(); face += 5)
  {
    const Vector3 side = mesh.Position(mesh.Head(3 * face)) - mesh.Position(mesh.Tail(3 * face));
    problem.Constraints.OnFaces.push_back({ face, side, 1.0 });
    if (face % 3 == 0)
    {
      problem.Constraints.OnFaces.push_back({ face, -side, 1.0 });
    }
  }
  problem.Rotation.Everywhere = 0.3;
  problem.Rotation.Faces = Vector<double>::LinSpaced(mesh.NumberOfFaces(), 0.0, 1.0);
  CheckOnAllPartitions(surface, problem);
}

TEST(ConstraintsInPieces, RotationOfNothingIsReported)
{
  FieldProblem problem;
  problem.Rotation.Everywhere = 0.3;
  CheckOnAllPartitions(test::IrregularSphere(3, 3), problem);
}
