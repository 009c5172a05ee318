#include "Mesh/FaceFans.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

using namespace dmg;
using namespace dmg::test;

namespace
{

std::set<int> CornersOf(const TriangleMesh& mesh, int face)
{
  return { mesh.Tail(3 * face), mesh.Tail(3 * face + 1), mesh.Tail(3 * face + 2) };
}

/// Corners that all faces of a fan have.
std::set<int> CentresOf(const TriangleMesh& mesh, const FaceFans& fans, int fan)
{
  std::set<int> centres = CornersOf(mesh, fans.Faces[fans.Offsets[fan]]);
  for (int k = fans.Offsets[fan] + 1; k < fans.Offsets[fan + 1]; ++k)
  {
    const std::set<int> corners = CornersOf(mesh, fans.Faces[k]);
    std::set<int> both;
    std::set_intersection(
      centres.begin(), centres.end(), corners.begin(), corners.end(), std::inserter(both, both.begin()));
    centres = both;
  }
  return centres;
}

bool HaveACommonSide(const TriangleMesh& mesh, int a, int b)
{
  for (int h = 3 * a; h < 3 * a + 3; ++h)
  {
    if (mesh.Twin(h) >= 0 && TriangleMesh::FaceOf(mesh.Twin(h)) == b)
    {
      return true;
    }
  }
  return false;
}

std::vector<Surface> SurfacesOfAllKinds()
{
  return { IrregularSphere(3, 1), IrregularTorus(12, 9, 2), PlaneGrid(5, 4), IrregularPlane(7, 9, 3), Disk(4),
    Needle(2, 50.0), SphereWithZeroAreaFaces(2, 2) };
}

}

TEST(FaceFans, EachFaceIsInOneFan)
{
  for (const Surface& surface : SurfacesOfAllKinds())
  {
    const TriangleMesh mesh = surface.Mesh();
    for (const int largest : { 1, 2, 5, 16 })
    {
      const FaceFans fans = PackFans(mesh, largest);
      EXPECT_EQ(static_cast<int>(fans.Faces.size()), mesh.NumberOfFaces());
      EXPECT_EQ(std::set<int>(fans.Faces.begin(), fans.Faces.end()).size(), fans.Faces.size());
      for (int fan = 0; fan < fans.Size(); ++fan)
      {
        EXPECT_GE(fans.Offsets[fan + 1] - fans.Offsets[fan], 1);
        EXPECT_LE(fans.Offsets[fan + 1] - fans.Offsets[fan], largest);
      }
    }
  }
}

TEST(FaceFans, FacesFollowEachOtherAroundAVertex)
{
  for (const Surface& surface : SurfacesOfAllKinds())
  {
    const TriangleMesh mesh = surface.Mesh();
    const FaceFans fans = PackFans(mesh, 16);
    for (int fan = 0; fan < fans.Size(); ++fan)
    {
      EXPECT_FALSE(CentresOf(mesh, fans, fan).empty()) << "fan " << fan;
      for (int k = fans.Offsets[fan] + 1; k < fans.Offsets[fan + 1]; ++k)
      {
        EXPECT_TRUE(HaveACommonSide(mesh, fans.Faces[k - 1], fans.Faces[k])) << "fan " << fan;
      }
    }
  }
}

TEST(FaceFans, StarsOfOneOfThreeColoursCoverARegularTorus)
{
  // Both ways around are multiples of three, so colours close up.
  const TriangleMesh mesh = Torus(12, 9).Mesh();
  const FaceFans fans = PackFans(mesh, 16);
  ASSERT_EQ(fans.Size(), mesh.NumberOfFaces() / 6);
  for (int fan = 0; fan < fans.Size(); ++fan)
  {
    EXPECT_EQ(fans.Offsets[fan + 1] - fans.Offsets[fan], 6);
  }
}

TEST(FaceFans, NoFanCouldHaveBeenAStar)
{
  // Wherever all faces around a vertex were left by the stars, there would have been one more.
  const TriangleMesh mesh = IrregularSphere(3, 4).Mesh();
  const FaceFans fans = PackFans(mesh, 16);
  std::vector<char> isInStar(mesh.NumberOfFaces(), 0);
  std::vector<int> valences(mesh.NumberOfVertices(), 0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    ++valences[mesh.Tail(h)];
  }
  for (int fan = 0; fan < fans.Size(); ++fan)
  {
    const std::set<int> centres = CentresOf(mesh, fans, fan);
    const int size = fans.Offsets[fan + 1] - fans.Offsets[fan];
    const bool isStar =
      std::any_of(centres.begin(), centres.end(), [&](int vertex) { return valences[vertex] == size; });
    for (int k = fans.Offsets[fan]; k < fans.Offsets[fan + 1]; ++k)
    {
      isInStar[fans.Faces[k]] = isStar;
    }
  }
  std::vector<char> meetsStar(mesh.NumberOfVertices(), 0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    meetsStar[mesh.Tail(h)] |= isInStar[TriangleMesh::FaceOf(h)];
  }
  EXPECT_EQ(std::count(meetsStar.begin(), meetsStar.end(), 0), 0);
}

TEST(FaceFans, LongFansAreCut)
{
  // 40 faces around a vertex.
  Surface fan{ Points(41, 3), Triangles(40, 3) };
  for (int k = 0; k < 40; ++k)
  {
    const double angle = k * 2.0 * 3.14159265358979323846 / 40;
    fan.V.row(k) << std::cos(angle), std::sin(angle), 0.0;
    fan.F.row(k) << k, (k + 1) % 40, 40;
  }
  fan.V.row(40).setZero();
  const FaceFans fans = PackFans(fan.Mesh(), 16);
  ASSERT_EQ(fans.Size(), 3);
  EXPECT_EQ(fans.Offsets[1], 16);
  EXPECT_EQ(fans.Offsets[2], 32);
}

TEST(PackedFaces, HaveNoCommonSideAndLeaveNoFaceWithoutNeighbourAmongThem)
{
  for (const Surface& surface : SurfacesOfAllKinds())
  {
    const TriangleMesh mesh = surface.Mesh();
    const std::vector<int> packed = PackFaces(mesh);
    const std::set<int> set(packed.begin(), packed.end());
    EXPECT_EQ(set.size(), packed.size());
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      int neighbours = 0;
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        neighbours += mesh.Twin(h) >= 0 && set.count(TriangleMesh::FaceOf(mesh.Twin(h))) > 0;
      }
      EXPECT_EQ(set.count(face) == 0, neighbours > 0) << "face " << face;
    }
  }
}

TEST(PackedFaces, AreEverySecondOneOfARegularTorus)
{
  const TriangleMesh mesh = Torus(12, 9).Mesh();
  EXPECT_EQ(2 * static_cast<int>(PackFaces(mesh).size()), mesh.NumberOfFaces());
}
