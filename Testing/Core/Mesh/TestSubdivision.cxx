// Of the surfaces that tests and benchmarks cut, since growth is counted on them.

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

using namespace dmg;
using namespace dmg::test;

TEST(SubdivideByLoop, KeepsTheTopologyAndPlanes)
{
  for (const Surface& surface : { IrregularTorus(9, 7, 2), IrregularPlane(6, 5, 3) })
  {
    const TriangleMesh before = surface.Mesh();
    const TriangleMesh after = SubdivideByLoop(surface).Mesh();
    EXPECT_EQ(after.NumberOfFaces(), 4 * before.NumberOfFaces());
    EXPECT_EQ(after.NumberOfVertices(), before.NumberOfVertices() + before.NumberOfEdges());
    EXPECT_EQ(after.EulerCharacteristic(), before.EulerCharacteristic());
  }
  EXPECT_EQ(SubdivideByLoop(IrregularPlane(6, 5, 3)).V.col(2).cwiseAbs().maxCoeff(), 0.0);
}

TEST(SubdivideByLoop, TakesTheMeanOfRegularNeighbours)
{
  // A point with six neighbours keeps 5/8 of its place and takes 3/8 of their mean.
  const Surface surface = Torus(12, 9);
  const TriangleMesh mesh = surface.Mesh();
  const Surface subdivided = SubdivideByLoop(surface);
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    Vector3 sum = Vector3::Zero();
    int neighbours = 0;
    mesh.VisitFan(vertex,
      [&](int h)
      {
        sum += mesh.Position(mesh.Head(h));
        ++neighbours;
      });
    ASSERT_EQ(neighbours, 6);
    const Vector3 expected = 0.625 * mesh.Position(vertex) + 0.375 / 6.0 * sum;
    EXPECT_LT((subdivided.V.row(vertex).transpose() - expected).norm(), 1e-15);
  }
}
