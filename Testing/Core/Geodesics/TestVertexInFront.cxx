#include "Geodesics/VertexInFront.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

using namespace dmg;
using namespace dmg::test;

namespace
{

Vector3 InFrontOf(const Surface& surface)
{
  const TriangleMesh mesh(surface.V, surface.F);
  return mesh.VertexPositions().row(VertexInFront(mesh));
}

}

TEST(VertexInFront, IsTheMiddleOfAPlane)
{
  EXPECT_EQ(InFrontOf(PlaneGrid(6, 4)), Vector3(3.0, 2.0, 0.0));
}

TEST(VertexInFront, IsTheTopOfATorusThatStands)
{
  Surface torus = Torus(24, 12, 1.0, 0.4);
  torus.V.col(1).swap(torus.V.col(2)); // around the y-axis
  torus.F.col(1).swap(torus.F.col(2));
  EXPECT_LE((InFrontOf(torus) - Vector3(0.0, 0.0, 1.4)).norm(), 1e-12);
}

TEST(VertexInFront, DependsOnPositionsAlone)
{
  const Surface even = PlaneGrid(5, 7); // four vertices are equally near to the middle
  const Surface two = Union(Icosphere(2), Icosphere(2), Vector3(3.0, 0.0, 0.0));
  for (unsigned seed = 1; seed < 6; ++seed)
  {
    EXPECT_EQ(InFrontOf(Relabel(even, seed).Result), Vector3(2.0, 3.0, 0.0)) << seed;
    EXPECT_EQ(InFrontOf(Relabel(two, seed).Result), InFrontOf(two)) << seed;
  }
}

TEST(VertexInFront, IsNotOnDebris)
{
  Surface debris = Icosphere(3);
  debris.V *= 0.1;
  EXPECT_EQ(InFrontOf(Union(debris, Icosphere(1), Vector3(0.0, 0.0, -2.0))).z(), InFrontOf(Icosphere(1)).z() - 2.0);
}
