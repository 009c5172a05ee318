// Borders of regions as edges of quads.

#include "QuadExamples.h"
#include "Quads/SurfaceQuads.h"
#include "Quads/SymmetricQuads.h"
#include "Support/Errors.h"
#include "Support/LinesAlongEdges.h"

using namespace dmg;
using namespace dmg::test;

namespace
{

Vector3 Middle(const TriangleMesh& mesh, int face)
{
  return PositionOf(mesh, { face, Vector3::Constant(1.0 / 3.0) });
}

std::vector<char> Borders(const TriangleMesh& mesh, const std::vector<int>& regions)
{
  std::vector<char> areBorders(mesh.NumberOfEdges(), 0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (const int twin = mesh.Twin(h); twin >= 0)
    {
      areBorders[mesh.EdgeOf(h)] = regions[TriangleMesh::FaceOf(h)] != regions[TriangleMesh::FaceOf(twin)];
    }
  }
  return areBorders;
}

TEST(QuadRegions, OfDiscHaveTheCircleBetweenThem)
{
  const FramedMesh surface(Disk(16).Mesh());
  QuadOptions options = NumberOfQuads(600.0);
  double radius = 0.0;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    radius = std::max(radius, surface.Mesh.Position(vertex).norm());
  }
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    options.Regions.push_back(Middle(surface.Mesh, face).norm() < 0.5 * radius ? 3 : -1);
  }
  const QuadMesh mesh = MakeQuadsAlongFeatures(surface, options);
  ExpectGoodMesh(surface, mesh);
  EXPECT_NEAR(
    ShareAlongEdges(surface.Mesh, Borders(surface.Mesh, options.Regions), mesh.Quads, mesh.Positions), 1.0, 0.02);
  EXPECT_EQ(mesh.Report.LostRegions, 0);
  EXPECT_GT(mesh.Report.MeanScaledJacobian, 0.9);
  for (std::size_t quad = 0; quad < mesh.Quads.size(); ++quad)
  {
    Vector3 middle = Vector3::Zero();
    for (const int corner : mesh.Quads[quad])
    {
      middle += 0.25 * mesh.Positions.row(corner).transpose();
    }
    EXPECT_EQ(options.Regions[mesh.Faces[quad]] == 3, middle.norm() < 0.5 * radius);
  }
}

// One region beside two others, whose borders meet.
TEST(QuadRegions, MayMeetAtPoints)
{
  const FramedMesh surface(PlaneGrid(20, 20).Mesh());
  QuadOptions options = NumberOfQuads(225.0);
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    const Vector3 middle = Middle(surface.Mesh, face);
    options.Regions.push_back(middle.x() < 7.0 ? 0 : middle.y() < 9.0 ? 1 : 2);
  }
  const QuadMesh mesh = MakeQuadsAlongFeatures(surface, options);
  ExpectGoodMesh(surface, mesh);
  EXPECT_NEAR(
    ShareAlongEdges(surface.Mesh, Borders(surface.Mesh, options.Regions), mesh.Quads, mesh.Positions), 1.0, 1e-9);
  EXPECT_EQ(mesh.Report.InvertedQuads, 0);
  EXPECT_TRUE(mesh.Report.AgainstField.empty());
  std::map<int, double> areas; // of quads by region
  for (std::size_t quad = 0; quad < mesh.Quads.size(); ++quad)
  {
    const auto corner = [&](int k) -> Vector3 { return mesh.Positions.row(mesh.Quads[quad][k]).transpose(); };
    areas[options.Regions[mesh.Faces[quad]]] += 0.5 * (corner(2) - corner(0)).cross(corner(3) - corner(1)).norm();
  }
  EXPECT_NEAR(areas[0], 7.0 * 20.0, 1e-6);
  EXPECT_NEAR(areas[1], 13.0 * 9.0, 1e-6);
  EXPECT_NEAR(areas[2], 13.0 * 11.0, 1e-6);
}

TEST(QuadRegions, ThatAreLostAreCounted)
{
  Surface plane = PlaneGrid(20, 20);
  const FramedMesh surface(plane.Mesh());
  QuadOptions options = NumberOfQuads(16.0);
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    const Vector3 middle = Middle(surface.Mesh, face);
    options.Regions.push_back(std::max(std::abs(middle.x() - 9.5), std::abs(middle.y() - 9.5)) < 0.5 ? 1 : 0);
  }
  const QuadMesh mesh = MakeQuadsAlongFeatures(surface, options);
  ExpectGoodMesh(surface, mesh);
  std::set<int> found;
  for (const int face : mesh.Faces)
  {
    found.insert(options.Regions[face]);
  }
  EXPECT_EQ(mesh.Report.LostRegions, 2 - static_cast<int>(found.size()));
  options.Regions.pop_back();
  EXPECT_THROW(MakeQuadsAlongFeatures(surface, options), InvalidInput);
}

}
