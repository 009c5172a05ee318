#include "Drawing/UnfoldedSurface.h"

#include "Drawing/DirectionsOnFaces.h"
#include "Drawing/SurfaceSamples.h"
#include "Fields.h"
#include "Support/NamedSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace
{

using namespace dmg;
using namespace dmg::test;

Vector3 Along(const Vector3&)
{
  return { 1.0, 0.0, 0.0 };
}

TEST(UnfoldedSurface, ShowsPlacesInSpaceWhereTheyAre)
{
  const DrawnField field(IrregularTorus(20, 12, 4), 1, Along);
  for (int h = 0; h < 3 * field.Mesh.NumberOfFaces(); ++h)
  {
    const int face = TriangleMesh::FaceOf(h);
    const Vector3 tail = field.Mesh.Position(field.Mesh.Tail(h));
    EXPECT_LT((field.Unfolded.Position(face, field.Unfolded.Corner(h)) - tail).norm(), 1e-14);
    EXPECT_LT(
      (field.Unfolded.PositionAlong(h, 0.3) - field.Unfolded.Position(face, field.Unfolded.PointAlong(h, 0.3))).norm(),
      1e-14);
  }
}

TEST(UnfoldedSurface, GoesStraightInAPlane)
{
  const DrawnField field(IrregularPlane(20, 20, 9), 1, Along);
  Random random(6);
  for (int i = 0; i < 200; ++i)
  {
    SurfacePoint at = field.Unfolded.Centre(random.Index(field.Mesh.NumberOfFaces()));
    const Vector3 from = field.Unfolded.Position(at.Face, at.Point);
    const double angle = random.Uniform(0.0, 2.0 * Pi);
    const double length = random.Uniform(0.0, 12.0);
    const Vector3 way(std::cos(angle), std::sin(angle), 0.0);
    Complex direction = field.Frames.ToComplex(at.Face, way);
    const bool isInside = field.Unfolded.GoStraight(at, direction, length);
    const Vector3 to = field.Unfolded.Position(at.Face, at.Point);
    const Vector3 end = from + length * way;
    EXPECT_EQ(isInside, std::min({ end[0], end[1], 20.0 - end[0], 20.0 - end[1] }) > 0.0);
    if (isInside)
    {
      EXPECT_LT((to - end).norm(), 1e-11);
      EXPECT_LT((field.Frames.ToVector(at.Face, direction) - way).norm(), 1e-11);
    }
  }
}

/// On a prism, as in a plane, the nearer of the ways around is as long as the unrolled one.
TEST(UnfoldedSurface, ComesBackAroundAPrism)
{
  const DrawnField field(Prism(12, 10), 1, Along);
  const double around = 12.0 * 2.0 * std::sin(Pi / 12.0);
  SurfacePoint at = field.Unfolded.Centre(7);
  const Vector3 from = field.Unfolded.Position(at.Face, at.Point);
  const Vector3 horizontal = field.Frames.Normal(7).cross(Vector3(0.0, 0.0, 1.0));
  Complex direction = field.Frames.ToComplex(7, horizontal);
  ASSERT_TRUE(field.Unfolded.GoStraight(at, direction, around));
  EXPECT_EQ(at.Face, 7);
  EXPECT_LT((field.Unfolded.Position(at.Face, at.Point) - from).norm(), 1e-11);
}

/// As a glyph on the large triangles of a long spike would.
TEST(UnfoldedSurface, GivesUpATurnAroundAPrismThatIsFarTooLong)
{
  const DrawnField field(Prism(12, 10), 1, Along);
  SurfacePoint at = field.Unfolded.Centre(7);
  Complex direction = field.Frames.ToComplex(7, field.Frames.Normal(7).cross(Vector3(0.0, 0.0, 1.0)));
  EXPECT_FALSE(field.Unfolded.GoStraight(at, direction, 1e12));
  EXPECT_NEAR(std::abs(direction), 1.0, 1e-9);
}

TEST(SurfaceWalk, FindsTheFacesThatAreNearInAPlane)
{
  const DrawnField field(IrregularPlane(16, 16, 8), 1, Along);
  SurfaceWalk walk(field.Unfolded);
  for (const int start : { 0, 100, 333 })
  {
    const SurfacePoint centre = field.Unfolded.Centre(start);
    const Vector3 from = field.Unfolded.Position(start, centre.Point);
    std::map<int, SurfaceWalk::Placement> found;
    walk.Around(centre, 3.0,
      [&](const SurfaceWalk::Placement& placement)
      {
        EXPECT_TRUE(found.emplace(placement.Face, placement).second) << "twice";
        return true;
      });
    for (int face = 0; face < field.Mesh.NumberOfFaces(); ++face)
    {
      const double distance = (field.Centre(face) - from).norm();
      const auto at = found.find(face);
      EXPECT_TRUE(distance >= 3.0 || at != found.end()) << "its centre is near";
      if (at != found.end())
      {
        EXPECT_NEAR(std::abs(at->second.Place(field.Unfolded.Centre(face).Point)), distance, 1e-11);
        double nearest = distance;
        for (int k = 0; k < 3; ++k)
        {
          const Vector3 corner = field.Mesh.Position(field.Mesh.FaceCorners()(face, k));
          nearest = std::min(nearest, (corner - from).norm());
        }
        EXPECT_LT(nearest, 3.0 + 2.0) << "not farther than its longest side";
      }
    }
  }
}

TEST(EvenlySpreadPoints, KeepTheirDistanceAndLeaveNoGap)
{
  for (const auto& [size, distance] : std::vector<std::pair<int, double>>{
         { 5, 0.1 }, { 30, 0.4 }, { 30, 1.0 }, { 30, 4.0 } }) // smaller and larger than faces
  {
    const DrawnField field(IrregularPlane(size, size, 2), 1, Along);
    std::vector<Vector3> points;
    for (const SurfacePoint& point : EvenlySpreadPoints(field.Unfolded, distance))
    {
      points.push_back(field.Unfolded.Position(point.Face, point.Point));
    }
    // The densest packing of discs has 2 / sqrt(3) per square of the distance, the thinnest cover 0.38.
    const double perSquare = static_cast<double>(points.size()) * distance * distance / (size * size);
    EXPECT_GT(perSquare, 0.5);
    EXPECT_LT(perSquare, 1.3);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        ASSERT_GE((points[i] - points[j]).norm(), distance * (1.0 - 1e-12));
      }
    }
    for (int face = 0; face < field.Mesh.NumberOfFaces(); ++face)
    {
      const Vector3 centre = field.Centre(face);
      const bool isNear = std::any_of(points.begin(), points.end(),
        [&, reach = distance * (1.0 + 1e-12)](const Vector3& point) { return (point - centre).norm() <= reach; });
      ASSERT_TRUE(isNear) << "distance " << distance << ", face " << face;
    }
  }
}

TEST(EvenlySpreadPoints, LieOnBothSidesOfAThinPlate)
{
  const DrawnField field(Flattened(Icosphere(4), 0.01), 1, Along);
  int above = 0, below = 0;
  for (const SurfacePoint& point : EvenlySpreadPoints(field.Unfolded, 0.1))
  {
    ++(field.Unfolded.Position(point.Face, point.Point)[2] > 0.0 ? above : below);
  }
  EXPECT_GT(above, 0.5 * Pi / 0.01);
  EXPECT_GT(below, 0.5 * Pi / 0.01);
}

TEST(EvenlySpreadPoints, OnFacesWithoutAreaAreFinite)
{
  for (const Surface& surface : { SphereWithZeroAreaFaces(3, 10), CapsuleFromRectangle(16, 12), Needle(3, 20.0) })
  {
    const DrawnField field(surface, 1, Along);
    const std::vector<SurfacePoint> points = EvenlySpreadPoints(field.Unfolded, 0.2);
    EXPECT_GT(points.size(), 3u);
    for (const SurfacePoint& point : points)
    {
      EXPECT_TRUE(field.Unfolded.Position(point.Face, point.Point).allFinite());
    }
  }
}

TEST(FirstDirectionsOfFaces, OfAParallelFieldAreParallel)
{
  const TriangleMesh mesh = IrregularPlane(6, 5, 3).Mesh();
  const TangentFrames faces = FaceFrames(mesh);
  const TangentFrames vertices = VertexFrames(mesh);
  for (const int N : { 1, 2, 4, 7 })
  {
    // Any of the N directions stands for the field, here another one at each vertex but those of face 0.
    Vector<Complex> ofVertices(mesh.NumberOfVertices());
    for (int v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      ofVertices[v] = std::polar(1.0, 2.0 * Pi * (v % N) / N) * vertices.ToComplex(v, Vector3(3.0, 1.0, 0.0));
    }
    const Vector<Complex> ofFaces = FirstDirectionsOfFaces(mesh, faces, vertices, ofVertices, N);
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      const int v = mesh.FaceCorners()(face, 0);
      const Vector3 expected = vertices.ToVector(v, ofVertices[v]);
      EXPECT_LT((faces.ToVector(face, ofFaces[face]) - expected).norm(), 1e-12) << "N " << N;
    }
  }
}

}
