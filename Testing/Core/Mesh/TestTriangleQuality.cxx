#include "Mesh/TriangleQuality.h"

#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// Of a right triangle with legs 1 and h: the area is h / 2, the squared edges add up to 2 (1 + h^2).
double OfLegs(double h)
{
  return std::sqrt(3.0) * h / (1.0 + h * h);
}

}

TEST(TriangleQuality, OfRightTrianglesIsThatOfTheirLegs)
{
  for (const double h : { 1.0, 0.3, 1e-3, 1e-9 })
  {
    const TriangleMesh mesh = test::Strip({ h }).Mesh();
    for (int face = 0; face < 2; ++face)
    {
      EXPECT_NEAR(TriangleQuality(mesh, face), OfLegs(h), 10 * Epsilon * OfLegs(h));
    }
  }
}

TEST(TriangleQuality, IsOneForEquilateralTrianglesOfAnySizeAndZeroWithoutArea)
{
  for (const double scale : { 1e-30, 1.0, 1e30 })
  {
    test::Surface surface = test::Icosphere(0); // the icosahedron
    surface.V *= scale;
    const TriangleMesh mesh = surface.Mesh();
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      EXPECT_NEAR(TriangleQuality(mesh, face), 1.0, 20 * Epsilon);
    }
  }
  const TriangleMesh mesh = test::SphereWithZeroAreaFaces(2, 3).Mesh();
  EXPECT_GE(ShareOfFacesBelow(1e-7, mesh, SerialContext()), 3.0 / mesh.NumberOfFaces());
}

TEST(TriangleQuality, SharesCountFaces)
{
  // Qualities of 0.17 in three columns of ten, of 0.87 in the others; two faces each.
  std::vector<double> widths(10, 1.0);
  widths[2] = widths[3] = widths[7] = 0.1;
  const TriangleMesh mesh = test::Strip(widths).Mesh();
  EXPECT_EQ(ShareOfFacesBelow(0.99 * OfLegs(0.1), mesh, SerialContext()), 0.0);
  EXPECT_EQ(ShareOfFacesBelow(1.01 * OfLegs(0.1), mesh, SerialContext()), 0.3);
  EXPECT_EQ(ShareOfFacesBelow(1.0, mesh, test::TbbContext(3)), 1.0);
}
