#include "Preparation/PolygonSurface.h"

#include "PreparedSurfaces.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A ring of points around the origin, in a tilted plane.
Points Ring(const std::vector<Vector2>& corners)
{
  const Vector3 x = Vector3(1.0, 2.0, -0.5).normalized();
  const Vector3 y = Vector3(0.3, 0.1, 1.0).cross(x).normalized();
  Points positions(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    positions.row(static_cast<Eigen::Index>(i)) = (corners[i][0] * x + corners[i][1] * y).transpose();
  }
  return positions;
}

/// By the shoelace formula.
double AreaOf(const std::vector<Vector2>& corners)
{
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vector2 a = corners[i], b = corners[(i + 1) % corners.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

std::vector<int> Upwards(std::size_t size)
{
  std::vector<int> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

std::multiset<std::array<int, 3>> Sorted(const Triangles& triangles)
{
  std::multiset<std::array<int, 3>> all;
  for (int t = 0; t < triangles.rows(); ++t)
  {
    std::array<int, 3> corners{ triangles(t, 0), triangles(t, 1), triangles(t, 2) };
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.insert(corners);
  }
  return all;
}

/// Its triangles have its area in sum, without overlap: none is turned over.
void ExpectCut(const std::vector<Vector2>& corners)
{
  const CellTriangles cut = Triangulate(Polygons(Ring(corners), { Upwards(corners.size()) }));
  ASSERT_EQ(cut.Corners.rows(), static_cast<int>(corners.size()) - 2);
  double sum = 0.0;
  for (int t = 0; t < cut.Corners.rows(); ++t)
  {
    const double area = AreaOf({ corners[cut.Corners(t, 0)], corners[cut.Corners(t, 1)], corners[cut.Corners(t, 2)] });
    EXPECT_GE(area, -1e-12);
    sum += area;
  }
  EXPECT_NEAR(sum, AreaOf(corners), 1e-12 * (1.0 + AreaOf(corners)));
}

std::vector<Vector2> Star(int size, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.2, 2.0);
  std::vector<Vector2> corners;
  for (int i = 0; i < size; ++i)
  {
    const double angle = 2.0 * Pi * i / size, r = radius(random);
    corners.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return corners;
}

/// A corridor that winds inwards.
std::vector<Vector2> Spiral(int size)
{
  std::vector<Vector2> corners;
  for (int i = 0; i < 2 * size; ++i)
  {
    const int k = i < size ? i : 2 * size - 1 - i;
    const double angle = 0.4 * k, radius = 10.0 * std::exp(-0.03 * k) * (i < size ? 1.0 : 0.8);
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return corners;
}

}

TEST(PolygonSurface, CutsPolygonsThatAreNotConvex)
{
  ExpectCut({ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } });
  ExpectCut({ { 0, 0 }, { 4, 0 }, { 1, 1 }, { 0, 4 } }); // a dart
  for (unsigned seed = 3; seed < 40; ++seed)
  {
    ExpectCut(Star(3 + static_cast<int>(seed), seed));
  }
  ExpectCut(Spiral(60));
}

TEST(PolygonSurface, CutsAQuadWhereItsTrianglesAreBetter)
{
  const std::vector<Vector2> kite = { { 0, 0 }, { 3, -1 }, { 6, 0 }, { 3, 1 } };
  const CellTriangles cut = Triangulate(Polygons(Ring(kite), { { 0, 1, 2, 3 } }));
  EXPECT_EQ(Sorted(cut.Corners), (std::multiset<std::array<int, 3>>{ { 0, 1, 3 }, { 1, 2, 3 } }));
}

TEST(PolygonSurface, DoesNotDependOnTheCornerThatAPolygonBeginsWith)
{
  for (const std::vector<Vector2>& corners : { std::vector<Vector2>{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } },
         Star(9, 17), Star(24, 5), std::vector<Vector2>{ { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } } })
  {
    std::vector<int> ring = Upwards(corners.size());
    const auto expected = Sorted(Triangulate(Polygons(Ring(corners), { ring })).Corners);
    for (std::size_t k = 1; k < corners.size(); ++k)
    {
      std::rotate(ring.begin(), ring.begin() + 1, ring.end());
      EXPECT_EQ(Sorted(Triangulate(Polygons(Ring(corners), { ring })).Corners), expected);
    }
  }
}

TEST(PolygonSurface, CutsPolygonsWithTheSameSidesAlike)
{
  for (const std::vector<Vector2>& corners :
    { std::vector<Vector2>{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, Star(9, 17), Star(24, 5) })
  {
    const std::vector<int> ring = Upwards(corners.size());
    const auto expected = Sorted(Triangulate(Polygons(Ring(corners), { ring })).Corners);
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      std::vector<int> turned = ring, opposite(ring.rbegin(), ring.rend());
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(k), turned.end());
      std::rotate(opposite.begin(), opposite.begin() + static_cast<std::ptrdiff_t>(k), opposite.end());
      const CellTriangles cut = Triangulate(Polygons(Ring(corners), { ring, turned, opposite }));
      const Eigen::Index size = cut.Corners.rows() / 3;
      EXPECT_EQ(Sorted(cut.Corners.topRows(size)), expected);
      EXPECT_EQ(Sorted(cut.Corners.middleRows(size, size)), expected);
      EXPECT_EQ(Sorted(cut.Corners.bottomRows(size).rowwise().reverse()), expected);
    }
  }
}

TEST(PolygonSurface, KeepsTheCellsOfTriangles)
{
  const std::vector<Vector2> corners = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 2, 0 }, { 2, 1 } };
  PolygonSurface polygons = Polygons(Ring(corners), { { 0, 1, 2, 3 }, {}, { 1, 4, 5 }, { 2 } });
  const CellTriangles cut = Triangulate(std::move(polygons));
  EXPECT_EQ(cut.Cells, (std::vector<int>{ 0, 0, 2, 3 }));
  EXPECT_EQ(cut.NumberOfCells, 4);
}

// Repeated corners and lines leave triangles without area, as many as the corners ask for.
TEST(PolygonSurface, TakesPolygonsWithoutArea)
{
  const std::vector<Vector2> corners = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 1, 1 } };
  for (const std::vector<int>& polygon : { std::vector<int>{ 0, 0, 0, 0 }, { 0, 1, 2, 3 }, { 0, 0, 1, 1, 4, 4 },
         { 0, 1, 0, 1 }, { 1, 4 }, { 0, 1, 4, 0, 1, 4 } })
  {
    const CellTriangles cut = Triangulate(Polygons(Ring(corners), { polygon }));
    EXPECT_EQ(cut.Corners.rows(), std::max(1, static_cast<int>(polygon.size()) - 2));
    EXPECT_GE(cut.Corners.minCoeff(), 0);
    EXPECT_LT(cut.Corners.maxCoeff(), 5);
  }
}
