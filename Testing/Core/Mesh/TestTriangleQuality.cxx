#include "Mesh/TriangleQuality.h"

#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
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

// Sides (1, 0), (7, 1) and (8, 1): the sine of the large angle is 1 / sqrt(50), and the circle has the radius of the longest side over twice that.
TEST(TriangleQuality, CapsAreMeasuredByTheCirclesAroundThem)
{
  test::Surface surface = test::PlaneGrid(12, 8);
  for (int vertex = 0; vertex < surface.V.rows(); ++vertex)
  {
    surface.V(vertex, 0) += 7.0 * std::min(surface.V(vertex, 1), 2.0); // two rows of eight
  }
  const CapFaces caps = FindCaps(surface.Mesh());
  EXPECT_NEAR(caps.Share, 0.25, 10 * Epsilon);
  EXPECT_NEAR(caps.RelativeRadius, std::sqrt(50.0), 1e3 * Epsilon);
}

TEST(TriangleQuality, ThinRightTrianglesAreNoCaps)
{
  EXPECT_EQ(FindCaps(test::Strip({ 1e-3, 1.0, 0.1 }).Mesh()).Share, 0.0);
  EXPECT_EQ(FindCaps(test::Icosphere(2).Mesh()).Share, 0.0);
}

TEST(TriangleQuality, CapsHaveTheSameBitsForAnyNumberOfThreads)
{
  test::Surface surface = test::IrregularPlane(70, 70, 3);
  surface.V.col(0) *= 20.0;
  const TriangleMesh mesh = surface.Mesh();
  const CapFaces one = FindCaps(mesh), three = FindCaps(mesh, test::TbbContext(3));
  EXPECT_GT(one.Share, 0.0);
  EXPECT_EQ(one.Share, three.Share);
  EXPECT_EQ(one.RelativeRadius, three.RelativeRadius);
}
