#include "Geodesics/IntrinsicTriangulation.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

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
