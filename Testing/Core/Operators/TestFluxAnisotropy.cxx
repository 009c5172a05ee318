#include "Operators/FluxAnisotropy.h"

#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A square grid whose unit vectors become others.
FramedMesh Grid(const Vector3& x, const Vector3& y)
{
  Surface grid = PlaneGrid(60, 60);
  for (int i = 0; i < grid.V.rows(); ++i)
  {
    grid.V.row(i) = (grid.V(i, 0) * x + grid.V(i, 1) * y).transpose();
  }
  return FramedMesh(grid.Mesh());
}

/// Of a triangle in the middle, which no mean over neighbours brings to the boundary.
double InTheMiddle(const FramedMesh& grid)
{
  return FluxAnisotropy(grid)[2 * (30 * 60 + 30)];
}

}

TEST(FluxAnisotropy, IsZeroOnEquilateralTriangles)
{
  EXPECT_NEAR(InTheMiddle(Grid(Vector3(1.0, 0.0, 0.0), Vector3(-0.5, std::sqrt(0.75), 0.0))), 0.0, 1e-12);
}

// The energy of a slope is 3 along the diagonals, and 5 / 3 across them.
TEST(FluxAnisotropy, IsTwoSeventhsOnSquaresThatAreCutAlike)
{
  EXPECT_NEAR(InTheMiddle(Grid(Vector3(1.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0))), 2.0 / 7.0, 1e-5);
  EXPECT_NEAR(InTheMiddle(Grid(Vector3(0.0, 0.3, 0.4), Vector3(-0.5, 0.0, 0.0))), 2.0 / 7.0, 1e-5);
}

TEST(FluxAnisotropy, TellsShearedMeshes)
{
  EXPECT_GT(ShareOfShearedArea(Grid(Vector3(1.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0))), 0.95);
  EXPECT_LT(ShareOfShearedArea(FramedMesh(Icosphere(4).Mesh())), 0.01);
}

TEST(FluxAnisotropy, HasTheSameBitsForAnyNumberOfThreads)
{
  const FramedMesh surface(IrregularSphere(4, 3).Mesh());
  EXPECT_EQ(FluxAnisotropy(surface, TbbContext(3)), FluxAnisotropy(surface));
}

// Triangles without area have no size that tensors could be told by.
TEST(FluxAnisotropy, IsANumberOnDegenerateTriangles)
{
  const Vector<double> anisotropy = FluxAnisotropy(FramedMesh(SphereWithZeroAreaFaces(3, 12).Mesh()));
  EXPECT_TRUE(anisotropy.allFinite());
  EXPECT_LE(anisotropy.maxCoeff(), 1.0 + 1e-12);
}
