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
TriangleMesh Grid(const Vector3& x, const Vector3& y)
{
  Surface grid = PlaneGrid(60, 60);
  for (int i = 0; i < grid.V.rows(); ++i)
  {
    grid.V.row(i) = (grid.V(i, 0) * x + grid.V(i, 1) * y).transpose();
  }
  return grid.Mesh();
}

/// Around a triangle that is far from the boundary.
double InTheMiddle(const TriangleMesh& grid)
{
  return FluxAnisotropy(grid, 2 * (30 * 60 + 30));
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
  EXPECT_LT(ShareOfShearedArea(Icosphere(4).Mesh()), 0.01);
}

// Squares above, equilateral triangles below.
TEST(FluxAnisotropy, TellsTheShareOfTheArea)
{
  Surface both = PlaneGrid(60, 60);
  for (int i = 0; i < both.V.rows(); ++i)
  {
    const double y = both.V(i, 1) - 30.0;
    both.V(i, 0) -= y < 0.0 ? 0.5 * y : 0.0;
    both.V(i, 1) = y < 0.0 ? std::sqrt(0.75) * y : y;
  }
  EXPECT_NEAR(ShareOfShearedArea(both.Mesh()), 1.0 / (1.0 + std::sqrt(0.75)), 0.05);
}

TEST(FluxAnisotropy, HasTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularSphere(4, 3).Mesh();
  EXPECT_EQ(ShareOfShearedArea(mesh, TbbContext(3)), ShareOfShearedArea(mesh));
}

// Triangles without area have no size that tensors could be told by.
TEST(FluxAnisotropy, IsANumberOnDegenerateTriangles)
{
  const TriangleMesh mesh = SphereWithZeroAreaFaces(3, 12).Mesh();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const double anisotropy = FluxAnisotropy(mesh, face);
    EXPECT_GE(anisotropy, 0.0);
    EXPECT_LE(anisotropy, 1.0 + 1e-12);
  }
}
