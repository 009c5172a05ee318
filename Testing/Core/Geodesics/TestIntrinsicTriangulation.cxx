#include "Geodesics/IntrinsicTriangulation.h"

#include "Geodesics/EdgePath.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

struct Triangulated
{
  explicit Triangulated(const Surface& shape)
    : On(shape.Mesh())
    , Connection(On)
    , Delaunay(On, Connection)
  {
  }

  FramedMesh On;
  VertexConnection Connection;
  IntrinsicTriangulation Delaunay;
};

Surface Sheared(Surface surface, double shear)
{
  surface.V.col(0) += shear * surface.V.col(1);
  return surface;
}

/// The number of halfedges that lead between other vertices than on the mesh.
int NumberOfFlipped(const Triangulated& surface)
{
  int count = 0;
  for (int h = 0; h < surface.Delaunay.NumberOfHalfedges(); ++h)
  {
    count += surface.Delaunay.Tail(h) != surface.On.Mesh.Tail(h) || surface.Delaunay.Head(h) != surface.On.Mesh.Head(h);
  }
  return count;
}

double AreaOf(const IntrinsicTriangulation& surface)
{
  double area = 0.0;
  for (int face = 0; face < surface.NumberOfFaces(); ++face)
  {
    area += surface.Area(face);
  }
  return area;
}

}

TEST(IntrinsicTriangulation, KeepsAMeshThatIsDelaunay)
{
  const Triangulated sphere(Icosphere(2));
  EXPECT_EQ(NumberOfFlipped(sphere), 0);
  for (int h = 0; h < sphere.Delaunay.NumberOfHalfedges(); ++h)
  {
    EXPECT_NEAR(sphere.Delaunay.Direction(h), sphere.Connection.PolarAngle(h), 1e-12);
    EXPECT_NEAR(sphere.Delaunay.Transport(h), sphere.Connection.Transport(h), 1e-12);
  }
}

TEST(IntrinsicTriangulation, HasEdgesOfThePlaneThatAreStraightAndDelaunay)
{
  const Triangulated plane(Sheared(PlaneGrid(12, 12), 2.0));
  const IntrinsicTriangulation& delaunay = plane.Delaunay;
  EXPECT_GT(NumberOfFlipped(plane), 0);
  EXPECT_NEAR(AreaOf(delaunay), 144.0, 1e-9);
  for (int h = 0; h < delaunay.NumberOfHalfedges(); ++h)
  {
    const int tail = delaunay.Tail(h);
    const int head = delaunay.Head(h);
    const Vector3 edge = plane.On.Mesh.Position(head) - plane.On.Mesh.Position(tail);
    const Complex seen = plane.On.Vertices.ToComplex(tail, edge);
    const Complex arrival = plane.On.Vertices.ToComplex(head, edge);
    EXPECT_LE(std::abs(std::polar(delaunay.Length(h), delaunay.Direction(h)) - seen), 1e-9);
    EXPECT_LE(std::abs(std::polar(delaunay.Length(h), delaunay.Arrival(h)) - arrival), 1e-9);
    if (delaunay.Twin(h) >= 0)
    {
      EXPECT_EQ(delaunay.Twin(delaunay.Twin(h)), h);
      EXPECT_EQ(delaunay.Tail(delaunay.Twin(h)), head);
      // No point is inside the circle through the corners of a face.
      EXPECT_LE(delaunay.Length(h), 2.3);
    }
  }
}

TEST(IntrinsicTriangulation, KeepsAreaAndHolonomyOfCurvedSurfaces)
{
  const Triangulated torus(Sheared(IrregularTorus(30, 14, 3), 0.0));
  const Triangulated needle(Needle(3, 30.0));
  for (const Triangulated* surface : { &torus, &needle })
  {
    const IntrinsicTriangulation& delaunay = surface->Delaunay;
    EXPECT_GT(NumberOfFlipped(*surface), 0);
    const double area = surface->On.Mesh.FaceAreas().sum();
    EXPECT_NEAR(AreaOf(delaunay), area, 1e-9 * area);
    double curvature = 0.0; // of all faces: what a direction turns by that is carried around
    for (int face = 0; face < delaunay.NumberOfFaces(); ++face)
    {
      double turn = 0.0;
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        EXPECT_GE(delaunay.Weight(h), 0.0);
        turn += delaunay.Transport(h);
      }
      curvature += std::remainder(turn, 2.0 * Pi);
    }
    EXPECT_NEAR(curvature, 2.0 * Pi * surface->On.Mesh.EulerCharacteristic(), 1e-6);
  }
}

TEST(IntrinsicTriangulation, GivesFacesWithoutAreaOne)
{
  const Triangulated sphere(SphereWithZeroAreaFaces(3, 6));
  for (int face = 0; face < sphere.Delaunay.NumberOfFaces(); ++face)
  {
    EXPECT_GT(sphere.Delaunay.Area(face), 0.0);
  }
  const double area = sphere.On.Mesh.FaceAreas().sum();
  EXPECT_NEAR(AreaOf(sphere.Delaunay), area, 1e-4 * area);
}

TEST(IntrinsicTriangulation, KeepsEdgesThatAreHeld)
{
  const Surface sheared = Sheared(PlaneGrid(12, 12), 2.0);
  const Triangulated plane(sheared);
  const TriangleMesh& mesh = plane.On.Mesh;
  std::vector<char> held(3 * mesh.NumberOfFaces(), 0);
  int count = 0;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    // Those that go up: most others are Delaunay only after flips.
    const Vector3 along = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    held[h] = std::abs(along.x()) > 2.5;
    count += held[h];
  }
  ASSERT_GT(count, 100);
  const IntrinsicTriangulation delaunay(plane.On, plane.Connection, held);
  int kept = 0;
  for (int h = 0; h < delaunay.NumberOfHalfedges(); ++h)
  {
    kept += delaunay.IsHeld(h);
    EXPECT_FALSE(delaunay.IsHeld(h) && delaunay.HasOtherDiagonal(h));
    const Vector3 along = mesh.Position(delaunay.Head(h)) - mesh.Position(delaunay.Tail(h));
    EXPECT_NEAR(along.norm(), delaunay.Length(h), 1e-9);
    EXPECT_EQ(delaunay.IsHeld(h), std::abs(along.x()) > 2.5);
  }
  EXPECT_EQ(kept, count);
}

TEST(EdgePath, BecomesAStraightLineInAPlane)
{
  constexpr int Cells = 14;
  const Triangulated plane(IrregularPlane(Cells, Cells, 5));
  const TriangleMesh& mesh = plane.On.Mesh;
  IntrinsicTriangulation surface = plane.Delaunay;
  // Along the boundary, from one corner to the opposite one, and to others.
  for (const bool isAlongX : { true, false })
  {
    for (const int turns : { 1, 2, 3 })
    {
      EdgePath path;
      const auto go = [&](int from, int to)
      {
        EdgePath::Step step{ -1, -1 };
        for (int h = 0; h < surface.NumberOfHalfedges(); ++h)
        {
          step.Along = surface.Tail(h) == from && surface.Head(h) == to ? h : step.Along;
          step.Against = surface.Tail(h) == to && surface.Head(h) == from ? h : step.Against;
        }
        path.Steps.push_back(step);
      };
      surface = plane.Delaunay;
      // The corners of the square, in one of both orders around it.
      const Vector3 corners[] = { { 0.0, 0.0, 0.0 }, { isAlongX ? Cells : 0.0, isAlongX ? 0.0 : Cells, 0.0 },
        { Cells, Cells, 0.0 }, { isAlongX ? 0.0 : Cells, isAlongX ? Cells : 0.0, 0.0 } };
      const auto vertexAt = [&](const Vector3& place)
      {
        int nearest = 0;
        (mesh.VertexPositions().rowwise() - place.transpose()).rowwise().norm().minCoeff(&nearest);
        return nearest;
      };
      for (int side = 0; side < turns; ++side)
      {
        for (int k = 0; k < Cells; ++k)
        {
          const auto place = [&](int at)
          { return Vector3(corners[side] + at / static_cast<double>(Cells) * (corners[side + 1] - corners[side])); };
          go(vertexAt(place(k)), vertexAt(place(k + 1)));
        }
      }
      EXPECT_NEAR(path.Length(surface), turns * Cells, 1e-9);
      MakeShortest(path, surface);
      EXPECT_NEAR(path.Length(surface), (corners[turns] - corners[0]).norm(), 1e-6);
      EXPECT_NEAR(AreaOf(surface), Cells * Cells, 1e-6);
    }
  }
}

TEST(IntrinsicTriangulation, TakesFurtherVerticesAndKeepsItsShape)
{
  const FramedMesh surface(IrregularTorus(14, 9, 5).Mesh());
  const VertexConnection connection(surface);
  IntrinsicTriangulation triangulation(surface, connection);
  double area = 0.0;
  for (int face = 0; face < triangulation.NumberOfFaces(); ++face)
  {
    area += triangulation.Area(face);
  }
  const int former = triangulation.NumberOfVertices();
  const std::vector<double> angles = [&]
  {
    std::vector<double> sums(former, 0.0);
    for (int h = 0; h < triangulation.NumberOfHalfedges(); ++h)
    {
      sums[triangulation.Tail(h)] += triangulation.CornerAngle(h);
    }
    return sums;
  }();
  for (int k = 0; k < 40; ++k)
  {
    const int h = (7 * k) % triangulation.NumberOfHalfedges();
    const auto added = k % 2 == 0
      ? triangulation.SplitEdge(h, 0.3, 0.7)
      : triangulation.SplitFace(h, (triangulation.Length(h) + triangulation.Apex(h)) / 3.0, 0.7);
    EXPECT_EQ(added.Vertex, former + k);
    EXPECT_EQ(triangulation.Tail(triangulation.Twin(added.Now(h))), triangulation.Head(added.Now(h)));
  }
  std::vector<double> sums(triangulation.NumberOfVertices(), 0.0);
  double areaNow = 0.0;
  for (int h = 0; h < triangulation.NumberOfHalfedges(); ++h)
  {
    sums[triangulation.Tail(h)] += triangulation.CornerAngle(h);
    areaNow += h % 3 == 0 ? triangulation.Area(h / 3) : 0.0;
    const int twin = triangulation.Twin(h);
    EXPECT_EQ(triangulation.Twin(twin), h);
    EXPECT_EQ(triangulation.Tail(twin), triangulation.Head(h));
    EXPECT_NEAR(triangulation.Length(twin), triangulation.Length(h), 1e-12);
    // Directions around a vertex follow from one another.
    const int back = TriangleMesh::Previous(h), tail = triangulation.Tail(h);
    const double next = triangulation.Direction(h) + triangulation.Stretch(tail) * triangulation.CornerAngle(h);
    EXPECT_NEAR(std::remainder(triangulation.Direction(triangulation.Twin(back)) - next, 2.0 * Pi), 0.0, 1e-9);
  }
  EXPECT_NEAR(areaNow, area, 1e-9);
  for (int vertex = 0; vertex < triangulation.NumberOfVertices(); ++vertex)
  {
    EXPECT_NEAR(sums[vertex], vertex < former ? angles[vertex] : 2.0 * Pi, 1e-9);
  }
}
