// Surfaces whose long edges are halved, and the quads of surfaces with few triangles.

#include "QuadExamples.h"
#include "Quads/Crosses/CrossField.h"
#include "Quads/Crosses/FinerSurface.h"
#include "Support/Random.h"
#include "SurfaceQuads.h"

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A closed solid with the shape of an L: arms of 10 by 2, height 1, in 20 triangles.
Surface Angle()
{
  const std::array<std::array<double, 2>, 6> outline{ { { 0, 0 }, { 10, 0 }, { 10, 2 }, { 2, 2 }, { 2, 10 },
    { 0, 10 } } };
  Surface solid;
  solid.V.resize(12, 3);
  solid.F.resize(20, 3);
  int face = 0;
  for (int k = 0; k < 6; ++k)
  {
    const int next = (k + 1) % 6;
    solid.V.row(k) << outline[k][0], outline[k][1], 0.0;
    solid.V.row(k + 6) << outline[k][0], outline[k][1], 1.0;
    solid.F.row(face++) << k, next, next + 6;
    solid.F.row(face++) << k, next + 6, k + 6;
  }
  for (int k = 1; k < 5; ++k)
  {
    solid.F.row(face++) << 0, k + 1, k;
    solid.F.row(face++) << 6, k + 6, k + 7;
  }
  return solid;
}

double LongestEdge(const TriangleMesh& mesh)
{
  double longest = 0.0;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    longest = std::max(longest, (mesh.Position(a) - mesh.Position(b)).norm());
  }
  return longest;
}

TEST(FinerSurface, HasTheShapeOfTheSurfaceAndNoLongEdges)
{
  const FramedMesh surface(Angle().Mesh());
  const Vector<double> longest = Vector<double>::Constant(surface.Mesh.NumberOfFaces(), 0.7);
  const auto finer = HalveLongEdges(surface, longest, 1e6);
  ASSERT_TRUE(finer);
  const TriangleMesh& mesh = finer->Geometry.Mesh;
  EXPECT_LE(LongestEdge(mesh), 0.7);
  EXPECT_EQ(mesh.EulerCharacteristic(), 2);
  EXPECT_NEAR(mesh.FaceAreas().sum(), 2.0 * 36.0 + 40.0, 1e-9);
  Vector<double> ofParents = Vector<double>::Zero(surface.Mesh.NumberOfFaces());
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const SurfacePlace place = finer->InParent(AtTail(h));
    EXPECT_LT((PositionOf(surface.Mesh, place) - mesh.Position(mesh.Tail(h))).norm(), 1e-12);
    ofParents[place.Face] += mesh.FaceArea(TriangleMesh::FaceOf(h)) / 3.0;
  }
  EXPECT_LT((ofParents - surface.Mesh.FaceAreas()).cwiseAbs().maxCoeff(), 1e-9);
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    EXPECT_EQ(mesh.Position(vertex), surface.Mesh.Position(vertex));
  }
  EXPECT_EQ(HalveLongEdges(surface, 100.0 * longest, 1e6), nullptr);
}

TEST(FinerSurface, HasAsManyFacesAsAllowed)
{
  const FramedMesh surface(Angle().Mesh());
  const Vector<double> longest = Vector<double>::Constant(surface.Mesh.NumberOfFaces(), 1e-3);
  const auto finer = HalveLongEdges(surface, longest, 5000.0);
  EXPECT_LE(finer->Geometry.Mesh.NumberOfFaces(), 5000);
  EXPECT_GT(finer->Geometry.Mesh.NumberOfFaces(), 1000);
  EXPECT_EQ(HalveLongEdges(surface, longest, 20.0), nullptr);
}

TEST(FinerSurface, HasTheFieldOfTheSurfaceWithItsSingularities)
{
  const FramedMesh surface(Icosphere(1).Mesh());
  Vector<Complex> powers(surface.Mesh.NumberOfFaces());
  Random random(3);
  for (Complex& power : powers)
  {
    power = std::polar(random.Uniform(0.5, 2.0), random.Uniform(-Pi, Pi));
  }
  const auto finer = HalveLongEdges(surface, Vector<double>::Constant(powers.size(), 0.2), 1e6);
  const Vector<Complex> ofFiner = finer->PowersOf(surface, powers);
  const auto direction = [](const FramedMesh& mesh, int face, Complex power)
  { return mesh.Faces.ToVector(face, std::pow(power, 0.25)); };
  for (int face = 0; face < ofFiner.size(); ++face)
  {
    const int parent = finer->Parents[face];
    const Vector3 here = direction(finer->Geometry, face, ofFiner[face]),
                  there = direction(surface, parent, powers[parent]);
    const Vector3 across = there.cross(surface.Faces.Normal(parent));
    EXPECT_LT(
      std::min({ (here - there).norm(), (here + there).norm(), (here - across).norm(), (here + across).norm() }), 1e-9);
  }
  const auto indices = [](const FramedMesh& mesh, const Vector<Complex>& field)
  { return MatchCrosses(mesh, SurfaceAngles(mesh, SerialContext()), field, SerialContext()).Indices; };
  std::vector<int> expected = indices(surface, powers);
  EXPECT_NE(expected, std::vector<int>(expected.size(), 0));
  expected.resize(finer->Geometry.Mesh.NumberOfVertices(), 0); // none on edges and in faces
  EXPECT_EQ(indices(finer->Geometry, ofFiner), expected);
}

TEST(QuadMesh, OfSolidOfTwentyTrianglesHasSquares)
{
  const auto surface = std::make_shared<const FramedMesh>(Angle().Mesh());
  const QuadMesh mesh = MakeQuadsAlongFeatures(surface, NumberOfQuads(4000.0));
  ExpectGoodMesh(*surface, mesh);
  EXPECT_GT(mesh.Report.MeanScaledJacobian, 0.99);
  EXPECT_NEAR(static_cast<double>(mesh.Quads.size()), 4000.0, 400.0);
  EXPECT_EQ(CountedMesh(mesh.Quads).Inner.at(3), 10) << "corners of the outline that are no inner ones";
  EXPECT_EQ(CountedMesh(mesh.Quads).Inner.at(5), 2) << "at the inner corner";
  for (int vertex = 0; vertex < mesh.Positions.rows(); ++vertex)
  {
    EXPECT_LT((PositionOf(surface->Mesh, mesh.Places[vertex]).transpose() - mesh.Positions.row(vertex)).norm(), 1e-12)
      << "places are on the surface that was given";
  }
  EXPECT_LE(*std::max_element(mesh.Faces.begin(), mesh.Faces.end()), 19);
}

TEST(QuadMesh, OfFieldOnTwoTrianglesIsItsGrid)
{
  Surface square;
  square.V.resize(4, 3);
  square.V << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  square.F.resize(2, 3);
  square.F << 0, 1, 2, 0, 2, 3;
  const FramedMesh surface(square.Mesh());
  Vector<Complex> crosses(2);
  for (int face = 0; face < 2; ++face)
  {
    crosses[face] = std::pow(surface.Faces.ToComplex(face, Vector3::UnitX()), 4);
  }
  const QuadMesh mesh = MakeQuads(surface, crosses, NumberOfQuads(900.0));
  ExpectGoodMesh(surface, mesh);
  EXPECT_EQ(mesh.Quads.size(), 900u);
  EXPECT_GT(mesh.Report.MeanScaledJacobian, 1.0 - 1e-9);
}

}
