#include "Directions/FieldTopology.h"

#include "Directions/PowerFieldDirections.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace dmg;
using namespace dmg::test;

namespace
{

double SumOfIndices(const FieldTopology& topology)
{
  double sum = topology.Indices.sum();
  for (const BoundaryIndex& loop : topology.Loops)
  {
    sum += loop.Index;
  }
  return sum;
}

/// The topology of a field in the plane by the N-th power of its directions.
FieldTopology InThePlane(const FramedMesh& surface, int N, const std::function<Complex(Complex)>& power)
{
  Vector<Complex> powers = PowersOfDirection(surface.Vertices, Vector3(1.0, 0.0, 0.0), N);
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    const Vector3 p = surface.Mesh.Position(vertex);
    powers[vertex] *= power({ p[0], p[1] });
  }
  return TopologyOfVertexField(surface.Mesh, VertexConnection(surface), FirstDirections(powers, N), N);
}

/// The face around a place in the plane that has an index, and no other; -1 else.
int OnlySingularFace(const TriangleMesh& mesh, const FieldTopology& topology)
{
  int only = -1;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (topology.Indices[face] != 0.0)
    {
      if (only >= 0)
      {
        return -1;
      }
      only = face;
    }
  }
  return only;
}

bool Contains(const TriangleMesh& mesh, int face, const Vector3& place)
{
  const auto corner = [&](int k) { return mesh.Position(mesh.FaceCorners()(face, k)); };
  bool isInside = true;
  for (int k = 0; k < 3; ++k)
  {
    isInside = isInside && (corner((k + 1) % 3) - corner(k)).cross(place - corner(k))[2] >= 0.0;
  }
  return isInside;
}

}

// Poincare and Hopf, for any field at all.
TEST(VertexFieldTopology, IndicesSumToTheEulerCharacteristic)
{
  Random random(5);
  for (const Surface& shape : { IrregularSphere(3, 5), IrregularTorus(24, 16, 5), DoubleTorus(4),
         IrregularPlane(9, 7, 3), Annulus(24, 4), Disk(6), SphereWithZeroAreaFaces(3, 5) })
  {
    const FramedMesh surface(shape.Mesh());
    const VertexConnection connection(surface);
    for (int N : { 1, 2, 4, 6, 8 })
    {
      const Vector<Complex> first = random.Numbers(surface.Mesh.NumberOfVertices());
      const FieldTopology topology = TopologyOfVertexField(surface.Mesh, connection, first, N);
      EXPECT_NEAR(SumOfIndices(topology), surface.Mesh.EulerCharacteristic(), 1e-9);
      const Vector<double> steps = N * topology.Indices;
      EXPECT_EQ((steps - Vector<double>(steps.array().round())).cwiseAbs().maxCoeff(), 0.0);
    }
  }
}

// The power z - c turns once around c, so the directions turn by 1 / N of a turn.
TEST(VertexFieldTopology, AZeroHasItsIndexOnTheTriangleAroundIt)
{
  const FramedMesh surface(IrregularPlane(12, 10, 5).Mesh());
  const Complex zero(5.3, 4.8);
  for (int N : { 1, 2, 4, 8 })
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const FieldTopology topology =
        InThePlane(surface, N, [&](Complex z) { return sign > 0.0 ? z - zero : std::conj(z - zero); });
      const int face = OnlySingularFace(surface.Mesh, topology);
      ASSERT_GE(face, 0);
      EXPECT_EQ(topology.Indices[face], sign / N);
      EXPECT_TRUE(Contains(surface.Mesh, face, Vector3(zero.real(), zero.imag(), 0.0)));
      ASSERT_EQ(topology.Loops.size(), 1u);
      EXPECT_NEAR(topology.Loops[0].Index, 1.0 - sign / N, 1e-12);
    }
  }
}

TEST(VertexFieldTopology, LoopsOfParallelFieldsAreThoseOfTheBoundary)
{
  const FramedMesh surface(Annulus(24, 4).Mesh());
  const FieldTopology topology = InThePlane(surface, 4, [](Complex) { return Complex(1.0); });
  EXPECT_EQ(topology.Indices.cwiseAbs().maxCoeff(), 0.0);
  ASSERT_EQ(topology.Loops.size(), 2u);
  EXPECT_EQ(topology.Loops[0].Index + topology.Loops[1].Index, 0.0);
  EXPECT_EQ(std::abs(topology.Loops[0].Index), 1.0);
  EXPECT_TRUE(topology.Cuts.empty() || topology.Jumps.size() == topology.Cuts.size());
}

// A constant field whose first directions are a quarter turn apart left and right of a line is cut there.
TEST(VertexFieldTopology, CutsSayWhichDirectionGoesOn)
{
  const FramedMesh surface(IrregularPlane(12, 10, 5).Mesh());
  const TriangleMesh& mesh = surface.Mesh;
  Vector<Complex> first(mesh.NumberOfVertices());
  const auto isRight = [&](int vertex) { return mesh.Position(vertex)[0] > 6.0; };
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    first[vertex] =
      surface.Vertices.ToComplex(vertex, isRight(vertex) ? Vector3(0.0, 1.0, 0.0) : Vector3(1.0, 0.0, 0.0));
  }
  const FieldTopology topology = TopologyOfVertexField(mesh, VertexConnection(surface), first, 4);
  std::size_t crossing = 0;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    crossing += isRight(a) != isRight(b);
  }
  ASSERT_EQ(topology.Cuts.size(), crossing);
  for (std::size_t i = 0; i < topology.Cuts.size(); ++i)
  {
    const int h = mesh.HalfedgeOf(topology.Cuts[i]);
    // Along x on the left is direction 3 beside first directions along y, and along y on the right is 1 beside x.
    EXPECT_EQ(topology.Jumps[i], isRight(mesh.Head(h)) ? 3 : 1);
    EXPECT_NEAR(topology.Rotation[topology.Cuts[i]], 0.0, 1e-12);
  }
}
