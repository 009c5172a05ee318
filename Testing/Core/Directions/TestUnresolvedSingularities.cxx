#include "Directions/UnresolvedSingularities.h"

#include "Directions/FieldTopology.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

namespace
{

using namespace dmg;
using namespace dmg::test;

/// A pole at the first vertex of an icosahedron: five faces meet there, so that each edge rotates the field by about 60 degrees.
FieldTopology PoleOfFiveFaces(const TriangleMesh& mesh, int N)
{
  const TangentFrames frames = FaceFrames(mesh);
  const Vector3 pole = mesh.Position(0);
  Vector<Complex> first(mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    Vector3 centre = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      centre += mesh.Position(mesh.FaceCorners()(face, k)) / 3.0;
    }
    first[face] = frames.ToComplex(face, centre.cross(pole));
  }
  return TopologyOfField(mesh, frames, first, N);
}

TEST(UnresolvedSingularities, AreThePolesWithTooFewTriangles)
{
  const TriangleMesh mesh = Icosphere(3).Mesh();
  const FieldTopology crosses = PoleOfFiveFaces(mesh, 4);
  EXPECT_EQ(crosses.Indices[0], 1.0 - 5 * 0.25); // each of five edges takes a quarter, and its other end has it
  const std::vector<int> unresolved = UnresolvedSingularities(mesh, crosses.Indices, 4, true);
  ASSERT_EQ(unresolved.size(), 2u) << "and the pole across";
  EXPECT_EQ(unresolved.front(), 0);
  for (const int N : { 1, 2 })
  {
    const FieldTopology resolved = PoleOfFiveFaces(mesh, N);
    EXPECT_EQ(resolved.Indices[0], 1.0);
    EXPECT_TRUE(UnresolvedSingularities(mesh, resolved.Indices, N, true).empty());
  }
}

// A pole of index 2 whose directions stood at the vertices: one of -1 at the pole, two of +1 around it, and two of +1/2 two rings farther on.
TEST(UnresolvedSingularities, MayReachOverSeveralRings)
{
  const TriangleMesh mesh = PlaneGrid(8, 8).Mesh();
  constexpr int Middle = 40;
  Vector<double> indices = Vector<double>::Zero(mesh.NumberOfVertices());
  indices[Middle] = -1.0;
  indices[Middle - 1] = indices[Middle + 1] = 1.0;
  indices[Middle - 3] = indices[Middle + 3] = 0.5;
  EXPECT_EQ(UnresolvedSingularities(mesh, indices, 2, true), std::vector<int>{ Middle });
  indices[Middle + 3] = 0.0; // a sum of 3 / 2 has six triangles for its three halves
  EXPECT_TRUE(UnresolvedSingularities(mesh, indices, 2, true).empty());
}

TEST(UnresolvedSingularities, AreNoPairsOfNeighbours)
{
  const TriangleMesh mesh = PlaneGrid(4, 4).Mesh();
  const int middle = 12, h = mesh.OutgoingHalfedge(middle);
  const int inside[] = { TriangleMesh::FaceOf(h), middle };
  const int around[] = { TriangleMesh::FaceOf(mesh.Twin(TriangleMesh::Next(h))), mesh.Head(h) };
  for (const bool areAtVertices : { false, true })
  {
    Vector<double> indices = Vector<double>::Zero(areAtVertices ? mesh.NumberOfVertices() : mesh.NumberOfFaces());
    indices[inside[areAtVertices]] = -0.25;
    for (const double index : { 0.25, 0.5, 0.75 }) // six triangles hold a sum of up to 3 / 4
    {
      indices[around[areAtVertices]] = index;
      EXPECT_TRUE(UnresolvedSingularities(mesh, indices, 4, areAtVertices).empty()) << index;
    }
    indices[around[areAtVertices]] = 1.25;
    EXPECT_EQ(UnresolvedSingularities(mesh, indices, 4, areAtVertices), std::vector<int>{ middle });
  }
}

}
