// The side from which counter-clockwise is positive does not depend on the order of rows or cells.

#include "Mesh/PositiveSide.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

Surface Mirrored(Surface surface)
{
  surface.F.col(1).swap(surface.F.col(2));
  return surface;
}

/// A part of the unit sphere, whose rows run from west to east and from south to north.
Surface PartOfSphere()
{
  Surface part = PlaneGrid(8, 6);
  for (int point = 0; point < part.V.rows(); ++point)
  {
    const double longitude = 0.1 * part.V(point, 0), latitude = 0.4 + 0.05 * part.V(point, 1);
    part.V.row(point) << std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
      std::sin(latitude);
  }
  return part;
}

/// The kind of a surface, and the sign of its cells.
std::pair<PositiveSide, double> SideOf(const Surface& surface, bool isGlobe = false)
{
  const SidesOfSurface sides = FindSides(surface.Mesh(), isGlobe);
  EXPECT_EQ(sides.Kinds.size(), 1u);
  EXPECT_EQ(sides.OfFaces.maxCoeff(), sides.OfFaces.minCoeff());
  EXPECT_EQ(sides.OfVertices.maxCoeff(), sides.OfFaces[0]);
  EXPECT_EQ(sides.OfVertices.minCoeff(), sides.OfFaces[0]);
  return { sides.Kinds.front(), sides.OfFaces[0] };
}

}

TEST(PositiveSide, IsTheOutsideOfClosedSurfaces)
{
  for (Surface closed : { Icosphere(2), Union(Icosphere(2), Icosphere(1), { 5.0, 0.0, 0.0 }) })
  {
    closed.V.rowwise() += Eigen::RowVector3d(3.0, -7.0, 100.0);
    EXPECT_EQ(SideOf(closed), std::make_pair(PositiveSide::Outside, 1.0));
    EXPECT_EQ(SideOf(Mirrored(closed)), std::make_pair(PositiveSide::Outside, -1.0));
  }
}

TEST(PositiveSide, IsAboveAPlaneOfConstantZ)
{
  Surface plane = PlaneGrid(7, 5);
  for (const double z : { 0.0, -3.0 })
  {
    plane.V.col(2).setConstant(z);
    plane.V(3, 2) += 1e-9; // rounding
    EXPECT_EQ(SideOf(plane), std::make_pair(PositiveSide::Up, 1.0));
    EXPECT_EQ(SideOf(Mirrored(plane)), std::make_pair(PositiveSide::Up, -1.0));
  }
}

TEST(PositiveSide, OfAPartOfAGlobeIsAwayFromTheOrigin)
{
  const Surface part = PartOfSphere();
  EXPECT_EQ(SideOf(part), std::make_pair(PositiveSide::AwayFromOrigin, 1.0));
  EXPECT_EQ(SideOf(Mirrored(part)), std::make_pair(PositiveSide::AwayFromOrigin, -1.0));
}

TEST(PositiveSide, OfOtherSurfacesIsThatOfTheirCellsUnlessTheyAreCalledAGlobe)
{
  Surface wall = PlaneGrid(7, 5); // seen from the origin, far away
  wall.V.col(2) = wall.V.col(0);
  wall.V.col(0).setConstant(1000.0);
  for (const Surface& each : { wall, Mirrored(wall) })
  {
    EXPECT_EQ(SideOf(each), std::make_pair(PositiveSide::OfCells, 1.0));
  }
  EXPECT_NE(SideOf(wall, true).second, SideOf(Mirrored(wall), true).second);
}

TEST(PositiveSide, OfTubesAndDomesIsTheConvexOne)
{
  Surface tube = PlaneGrid(24, 6), dome = PlaneGrid(8, 8);
  for (int point = 0; point < tube.V.rows(); ++point)
  {
    const double angle = 2.0 * Pi * tube.V(point, 0) / 25.0; // a slit stays open
    const double height = 0.5 * tube.V(point, 1);
    tube.V.row(point) << 7.0 + std::cos(angle), std::sin(angle), height;
  }
  for (int point = 0; point < dome.V.rows(); ++point)
  {
    const double x = dome.V(point, 0) - 4.0, y = dome.V(point, 1) - 4.0;
    dome.V(point, 2) = 50.0 - 0.1 * (x * x + y * y);
  }
  for (const Surface& surface : { tube, dome })
  {
    const double sign = SideOf(surface).second;
    EXPECT_EQ(SideOf(surface).first, PositiveSide::Convex);
    EXPECT_EQ(SideOf(Mirrored(surface)), std::make_pair(PositiveSide::Convex, -sign));
    const TriangleMesh mesh = surface.Mesh();
    Vector3 centre = Vector3::Zero();
    for (int point = 0; point < mesh.NumberOfVertices(); ++point)
    {
      centre += mesh.Position(point) / mesh.NumberOfVertices();
    }
    double outwards = 0.0;
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      outwards += mesh.FaceAreaVector(face).dot(mesh.Position(mesh.Tail(3 * face)) - centre);
    }
    EXPECT_GT(sign * outwards, 0.0);
  }
}

TEST(PositiveSide, KeepsTheCavityOfASolid)
{
  Surface cavity = Mirrored(Icosphere(1));
  cavity.V *= 0.5;
  const Surface shell = Union(Icosphere(2), cavity, Vector3::Zero());
  const auto turned = [](const Surface& surface) { return (FindSides(surface.Mesh()).OfFaces.array() < 0.0).count(); };
  EXPECT_EQ(turned(shell), 0);
  EXPECT_EQ(turned(Mirrored(shell)), shell.F.rows());
  EXPECT_EQ(turned(Mirrored(Icosphere(2))), Icosphere(2).F.rows());
  EXPECT_EQ(turned(Union(Icosphere(2), Mirrored(PlaneGrid(4, 4)), { 5.0, 0.0, 0.0 })), 32);
  EXPECT_EQ(turned(Union(Icosphere(2), Mirrored(Icosphere(1)), { 5.0, 0.0, 0.0 })), 80); // another solid
}

TEST(PositiveSide, BelongsToEachComponentByItself)
{
  const Surface both = Union(Mirrored(Icosphere(1)), PlaneGrid(3, 3), { 9.0, 0.0, 0.0 });
  const SidesOfSurface sides = FindSides(both.Mesh());
  EXPECT_EQ(sides.Kinds, (std::vector<PositiveSide>{ PositiveSide::Outside, PositiveSide::Up }));
  EXPECT_EQ(TextOf(sides.Kinds), "the outside, +z");
  EXPECT_EQ(sides.OfFaces.head(80), Vector<double>::Constant(80, -1.0));
  EXPECT_EQ(sides.OfFaces.tail(18), Vector<double>::Constant(18, 1.0));
}
