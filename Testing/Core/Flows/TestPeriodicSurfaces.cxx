// Warnings of surfaces that are meant to be periodic.

#include "Flows/PeriodicSurfaces.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A band around the globe, of so many columns of cells in steps of 10 degrees.
Surface Band(int columns)
{
  Surface band = PlaneGrid(columns, 12);
  for (int point = 0; point < band.V.rows(); ++point)
  {
    const double longitude = Pi / 18.0 * band.V(point, 0), latitude = 0.2 * (band.V(point, 1) - 6.0);
    band.V.row(point) << std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
      std::sin(latitude);
  }
  return band;
}

}

TEST(PeriodicSurfaces, AGridThatEndsOneStepShortOfTheCircleHasASlit)
{
  EXPECT_NE(WarningOfSlit(Band(35).Mesh(), Vector3::UnitZ()), "");
  EXPECT_EQ(WarningOfSlit(Band(30).Mesh(), Vector3::UnitZ()), ""); // a region
  EXPECT_EQ(WarningOfSlit(Icosphere(2).Mesh(), Vector3::UnitZ()), "");
}

TEST(PeriodicSurfaces, AFoldedBoxHasTrianglesAsLongAsItself)
{
  const int n = 20;
  Surface box = PlaneGrid(n - 1, n - 1);
  box.F.resize(2 * n * n, 3);
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const int a = j * n + i, b = j * n + (i + 1) % n, c = (j + 1) % n * n + (i + 1) % n, d = (j + 1) % n * n + i;
      box.F.row(2 * a) << a, b, c;
      box.F.row(2 * a + 1) << a, c, d;
    }
  }
  EXPECT_NE(WarningOfFoldedBox(box.Mesh()), "");
  EXPECT_EQ(WarningOfFoldedBox(PlaneGrid(n, n).Mesh()), "");
  EXPECT_EQ(WarningOfFoldedBox(PlaneGrid(n, 1).Mesh()), "");
}
