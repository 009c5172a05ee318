#include "Mesh/VertexConnection.h"

#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// How far an angle is from a multiple of 2 pi.
double FromFullTurns(double angle)
{
  return std::abs(std::remainder(angle, 2.0 * Pi));
}

double TotalCurvature(const FramedMesh& surface, const VertexConnection& connection)
{
  double sum = 0.0;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    sum += connection.Curvature(face);
  }
  return sum;
}

}

// Gauss and Bonnet.
TEST(VertexConnection, CurvaturesSumToTheEulerCharacteristic)
{
  for (const Surface& shape : { IrregularSphere(3, 5), IrregularTorus(24, 16, 5), DoubleTorus(4) })
  {
    const FramedMesh surface(shape.Mesh());
    const VertexConnection connection(surface);
    EXPECT_NEAR(TotalCurvature(surface, connection), 2.0 * Pi * surface.Mesh.EulerCharacteristic(), 1e-9);
  }
}

TEST(VertexConnection, FlatSurfacesHaveNoCurvature)
{
  for (const Surface& shape : { IrregularPlane(12, 8, 5), Disk(6), Annulus(24, 4), FlatTorus(12, 2), Prism(7, 5) })
  {
    const FramedMesh surface(shape.Mesh());
    const VertexConnection connection(surface);
    for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
    {
      EXPECT_NEAR(connection.Curvature(face), 0.0, 1e-12);
    }
  }
}

TEST(VertexConnection, TransportBackUndoesTransport)
{
  const FramedMesh surface(IrregularTorus(24, 16, 5).Mesh());
  const VertexConnection connection(surface);
  for (int h = 0; h < 3 * surface.Mesh.NumberOfFaces(); ++h)
  {
    EXPECT_LT(FromFullTurns(connection.Transport(h) + connection.Transport(surface.Mesh.Twin(h))), 1e-12);
  }
}

TEST(VertexConnection, AroundAFaceADirectionTurnsByItsCurvature)
{
  for (const Surface& shape : { IrregularSphere(2, 5), IrregularPlane(6, 5, 5), SphereWithZeroAreaFaces(3, 8) })
  {
    const FramedMesh surface(shape.Mesh());
    const VertexConnection connection(surface);
    for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
    {
      const double around =
        connection.Transport(3 * face) + connection.Transport(3 * face + 1) + connection.Transport(3 * face + 2);
      EXPECT_LT(FromFullTurns(around - connection.Curvature(face)), 1e-11);
    }
  }
}

// In a plane everything is carried in the plane: along edges, and from faces to vertices.
TEST(VertexConnection, CarriesDirectionsInAPlaneAsTheyAre)
{
  const FramedMesh surface(IrregularPlane(9, 7, 5).Mesh());
  const VertexConnection connection(surface);
  const Vector3 direction(0.28, 0.96, 0.0);
  for (int h = 0; h < 3 * surface.Mesh.NumberOfFaces(); ++h)
  {
    const Complex atTail = surface.Vertices.ToComplex(surface.Mesh.Tail(h), direction);
    const Complex atHead = surface.Vertices.ToComplex(surface.Mesh.Head(h), direction);
    const Complex onFace = surface.Faces.ToComplex(TriangleMesh::FaceOf(h), direction);
    EXPECT_LT(std::abs(std::polar(1.0, connection.Transport(h)) * atTail - atHead), 1e-12);
    EXPECT_LT(std::abs(connection.TurnFromFace(h) * onFace - atTail), 1e-12);
  }
}

// log(length) = g x: along a side (a, b) a direction turns by the integral of the derivative to its right, g b.
TEST(VertexConnection, TurnsByTheDerivativeOfLengthsToTheRight)
{
  const double g = 0.3;
  const FramedMesh surface(IrregularPlane(12, 8, 5).Mesh());
  std::vector<double> lengths;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    lengths.push_back(std::exp(g * surface.Mesh.Position(vertex).x()));
  }
  const VertexConnection before(surface);
  VertexConnection connection(surface);
  connection.SetLengths(surface.Mesh, lengths);
  for (int h = 0; h < 3 * surface.Mesh.NumberOfFaces(); ++h)
  {
    const Vector3 side = surface.Mesh.Position(surface.Mesh.Head(h)) - surface.Mesh.Position(surface.Mesh.Tail(h));
    EXPECT_NEAR(connection.Transport(h), before.Transport(h) + g * side.y(), 1e-12);
  }
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    EXPECT_NEAR(connection.Curvature(face), 0.0, 1e-12) << "log(length) is harmonic";
  }
}

TEST(VertexConnection, HasItsTotalCurvatureForAnyLengths)
{
  const FramedMesh surface(IrregularSphere(3, 5).Mesh());
  std::vector<double> lengths;
  Random random(4);
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    lengths.push_back(random.Uniform(0.5, 2.0));
  }
  VertexConnection connection(surface);
  connection.SetLengths(surface.Mesh, lengths);
  EXPECT_NEAR(TotalCurvature(surface, connection), 4.0 * Pi, 1e-9);
  for (int h = 0; h < 3 * surface.Mesh.NumberOfFaces(); ++h)
  {
    EXPECT_LT(FromFullTurns(connection.Transport(h) + connection.Transport(surface.Mesh.Twin(h))), 1e-9);
  }
}

TEST(VertexConnection, HasTheSameBitsForAnyNumberOfThreads)
{
  const FramedMesh surface(IrregularTorus(64, 48, 5).Mesh());
  const VertexConnection one(surface);
  const VertexConnection three(surface, TbbContext(3));
  for (int h = 0; h < 3 * surface.Mesh.NumberOfFaces(); ++h)
  {
    ASSERT_EQ(one.PolarAngle(h), three.PolarAngle(h));
    ASSERT_EQ(one.CornerAngle(h), three.CornerAngle(h));
    ASSERT_EQ(one.TurnFromFace(h), three.TurnFromFace(h));
  }
}
