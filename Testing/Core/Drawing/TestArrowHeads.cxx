// Arrow heads of lines in the plane, whose places and corners are known.

#include "Drawing/ArrowHeads.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

namespace
{

using namespace dmg;

/// A line on face 0 along x, of points at these places.
LinesOnSurface LineAlong(const std::vector<double>& places, bool isClosed = false)
{
  LinesOnSurface lines;
  for (const double place : places)
  {
    lines.Positions.emplace_back(place, 0.25, 0.0);
    lines.Faces.push_back(0);
    lines.Magnitudes.push_back(1.0);
  }
  lines.Offsets = { 0, static_cast<int>(places.size()) };
  lines.Lengths = { places.back() - places.front() };
  lines.Families = { 0 };
  lines.IsClosed = { static_cast<char>(isClosed) };
  return lines;
}

class ArrowHeads : public testing::Test
{
protected:
  const TriangleMesh Mesh = test::PlaneGrid(2, 2).Mesh();
  const TangentFrames Faces = FaceFrames(Mesh);
};

}

TEST_F(ArrowHeads, StandAtEvenDistanceUpToTheEnd)
{
  const auto heads = ArrowHeadsOf(LineAlong({ 0.0, 0.5, 4.0, 4.0, 9.0 }), this->Faces, 3.2, 0.5);
  ASSERT_EQ(heads.size(), 3u);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR((heads[k].Corners[0] - Vector3(3.0 * (k + 1), 0.25, 0.0)).norm(), 0.0, 1e-12);
    EXPECT_EQ(heads[k].Line, 0);
  }
  EXPECT_EQ(heads[0].Point, 2);
  EXPECT_EQ(heads[2].Point, 4);
}

TEST_F(ArrowHeads, PointAlongTheLineAndLookAlongTheNormal)
{
  const auto heads = ArrowHeadsOf(LineAlong({ 0.0, 1.0 }), this->Faces, 8.0, 0.5);
  ASSERT_EQ(heads.size(), 1u);
  const auto& [tip, left, right] = heads[0].Corners;
  EXPECT_NEAR((tip - Vector3(1.0, 0.25, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((left - Vector3(0.5, 0.45, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((right - Vector3(0.5, 0.05, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_GT((left - tip).cross(right - tip).dot(this->Faces.Normal(0)), 0.0);
}

TEST_F(ArrowHeads, AreNoneOnALineWithoutLength)
{
  EXPECT_TRUE(ArrowHeadsOf(LineAlong({ 1.0, 1.0 }), this->Faces, 3.0, 0.5).empty());
  EXPECT_TRUE(ArrowHeadsOf(LinesOnSurface(), this->Faces, 3.0, 0.5).empty());
}
