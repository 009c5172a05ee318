#include "Mesh/NeedleRegions.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr double Fraction = 0.05;
constexpr NeedleRegions::Rule BySides = { Fraction, 0 };
constexpr NeedleRegions::Rule ByRings = { Fraction, NeedleRegions::RingsOfRegion };

std::set<int> FacesOf(const NeedleRegions& regions, const TriangleMesh& mesh)
{
  std::set<int> faces;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (regions.Contains(face))
    {
      faces.insert(face);
    }
  }
  return faces;
}

std::set<int> Range(int first, int last)
{
  std::set<int> range;
  for (int i = first; i < last; ++i)
  {
    range.insert(i);
  }
  return range;
}

/// Thin columns, so many, between wide ones.
std::vector<double> Widths(int before, int thin, int behind)
{
  std::vector<double> widths(before, 1.0);
  widths.insert(widths.end(), thin, 0.01);
  widths.insert(widths.end(), behind, 1.0);
  return widths;
}

}

TEST(AreUneven, ByTheAreaOverThatOfAnEquilateralTriangle)
{
  // Legs 1 and h, hypotenuse sqrt(1 + h^2).
  for (const double h : { 1.0, 0.1, 0.01 })
  {
    const TriangleMesh mesh = Strip({ h }).Mesh();
    const double fraction = 0.5 * h / (std::sqrt(3.0) / 4.0 * (1.0 + h * h));
    EXPECT_EQ(AreUneven(mesh, 1.001 * fraction), std::vector<char>(2, 1));
    EXPECT_EQ(AreUneven(mesh, 0.999 * fraction), std::vector<char>(2, 0));
  }
}

TEST(NeedleRegions, HoldNeedlesAndThreeRingsAroundThem)
{
  const int thin = NeedleRegions::FewestNeedles / 2; // two needles each
  const TriangleMesh mesh = Strip(Widths(10, thin, 10)).Mesh();
  for (const NeedleRegions::Rule& rule : { BySides, ByRings })
  {
    EXPECT_EQ(FacesOf(NeedleRegions(mesh, rule), mesh), Range(20 - 3, 20 + 2 * thin + 3));
  }
}

TEST(NeedleRegions, LeaveFewNeedlesToOthers)
{
  const TriangleMesh mesh = Strip(Widths(10, NeedleRegions::FewestNeedles / 2 - 1, 10)).Mesh();
  for (const NeedleRegions::Rule& rule : { BySides, ByRings })
  {
    EXPECT_TRUE(FacesOf(NeedleRegions(mesh, rule), mesh).empty());
    EXPECT_TRUE(NeedleRegions(mesh, rule).Pieces().empty());
  }
}

TEST(NeedleRegions, CountNeedlesTogetherAcrossRingsOnlyIfAsked)
{
  // Two groups with two faces between them, and far away a third.
  const int thin = NeedleRegions::FewestNeedles / 4;
  std::vector<double> widths = Widths(10, thin, 1);
  const std::vector<double> second = Widths(0, thin, 20);
  const std::vector<double> third = Widths(0, thin, 10);
  widths.insert(widths.end(), second.begin(), second.end());
  widths.insert(widths.end(), third.begin(), third.end());
  const TriangleMesh mesh = Strip(widths).Mesh();
  EXPECT_TRUE(FacesOf(NeedleRegions(mesh, BySides), mesh).empty());
  EXPECT_EQ(
    FacesOf(NeedleRegions(mesh, ByRings), mesh), Range(20 - 3, 20 + 2 * (2 * thin + 1) + 3));
}

TEST(NeedleRegions, ComponentsShareNoSides)
{
  // Two thin columns with one between them, another one far away; single needles count.
  std::vector<double> widths = Widths(10, 1, 1);
  const std::vector<double> second = Widths(0, 1, 20);
  const std::vector<double> third = Widths(0, 1, 10);
  widths.insert(widths.end(), second.begin(), second.end());
  widths.insert(widths.end(), third.begin(), third.end());
  const TriangleMesh mesh = Strip(widths).Mesh();
  const auto expect = [&mesh](const NeedleRegions::Rule& rule, const std::vector<std::set<int>>& expected) {
    const std::vector<std::vector<int>> components = NeedleRegions(mesh, rule).Components();
    ASSERT_EQ(components.size(), expected.size());
    for (std::size_t k = 0; k < components.size(); ++k)
    {
      EXPECT_EQ(components[k].size(), expected[k].size());
      EXPECT_EQ(std::set<int>(components[k].begin(), components[k].end()), expected[k]);
    }
  };
  expect({ Fraction, 0, 0, 1 }, { Range(20, 22), Range(24, 26), Range(66, 68) });
  expect({ Fraction, 1, 1, 1 }, { Range(19, 27), Range(65, 69) });
  expect({ Fraction, 0, 1, 3 }, {});
  expect({ Fraction, 1, 2, 3 }, { Range(18, 28) });
}

TEST(NeedleRegions, PiecesCoverThemAndOverlap)
{
  // More faces than a piece takes.
  Surface surface = IrregularPlane(60, 48, 4);
  surface.V.col(1) *= 0.005;
  const TriangleMesh mesh = surface.Mesh();
  const NeedleRegions regions(mesh, BySides);
  const std::vector<std::vector<int>> pieces = regions.Pieces();
  ASSERT_GE(pieces.size(), 2U);
  std::vector<int> count(mesh.NumberOfFaces(), 0);
  for (const std::vector<int>& piece : pieces)
  {
    EXPECT_EQ(std::set<int>(piece.begin(), piece.end()).size(), piece.size());
    for (const int face : piece)
    {
      ++count[face];
    }
  }
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    EXPECT_TRUE(count[face] > 0 || !regions.Contains(face));
  }
  EXPECT_TRUE(std::any_of(count.begin(), count.end(), [](int pieces) { return pieces > 1; }));
}

TEST(VisitNeighbours, OfAFaceAreBeyondItsSides)
{
  const TriangleMesh mesh = Strip({ 1.0, 1.0, 1.0 }).Mesh();
  const auto neighbours = [&mesh](int face) {
    std::vector<int> visited;
    mesh.VisitNeighbours(face, [&visited](int neighbour) { visited.push_back(neighbour); });
    std::sort(visited.begin(), visited.end());
    return visited;
  };
  EXPECT_EQ(neighbours(0), std::vector<int>({ 1 }));
  EXPECT_EQ(neighbours(2), std::vector<int>({ 1, 3 }));
  const TriangleMesh closed = Icosphere(1).Mesh();
  closed.VisitNeighbours(0, [&closed](int neighbour) {
    int back = 0;
    closed.VisitNeighbours(neighbour, [&back](int face) { back += face == 0; });
    EXPECT_EQ(back, 1);
  });
}
