#include "Drawing/ThinWalls.h"

#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

namespace
{

using namespace dmg;
using namespace dmg::test;

constexpr int Size = 10; // of a sheet, in unit squares
constexpr double Diagonal = 14.15;

/// Two sheets in the planes z = 0 and z = distance; the lower one is seen from below where they are the sides of a wall.
FramedMesh Sheets(double distance, bool lowerFacesDown, bool upperFacesUp)
{
  const Surface sheet = PlaneGrid(Size, Size);
  const auto points = sheet.V.rows();
  const auto faces = sheet.F.rows();
  Surface both{ Points(2 * points, 3), Triangles(2 * faces, 3) };
  both.V << sheet.V, sheet.V.rowwise() + Eigen::RowVector3d(0.0, 0.0, distance);
  both.F << sheet.F, (sheet.F.array() + static_cast<int>(points)).matrix();
  for (const auto& [turned, first] :
    { std::pair(lowerFacesDown, 0), std::pair(!upperFacesUp, static_cast<int>(faces)) })
  {
    for (int face = first; turned && face < first + faces; ++face)
    {
      std::swap(both.F(face, 1), both.F(face, 2));
    }
  }
  return FramedMesh(both.Mesh());
}

/// The normals at the centres of faces, of which those of the lower sheet come first.
std::vector<Vector3> NormalsOfInk(const FramedMesh& surface, const ExecutionContext& context = SerialContext())
{
  std::vector<Vector3> positions;
  std::vector<Vector3> normals;
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    Vector3 sum = Vector3::Zero();
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      sum += Vector3(surface.Mesh.Position(surface.Mesh.Tail(h)));
    }
    positions.emplace_back(sum / 3.0);
    normals.push_back(surface.Faces.Normal(face));
  }
  HalveNormalsAtThinWalls(surface, positions, normals, context);
  return normals;
}

std::vector<double> LengthsOfNormals(const FramedMesh& surface, const ExecutionContext& context = SerialContext())
{
  std::vector<double> lengths;
  for (const Vector3& normal : NormalsOfInk(surface, context))
  {
    lengths.push_back(normal.norm());
  }
  return lengths;
}

void ExpectAll(const std::vector<double>& lengths, double expected)
{
  for (const double length : lengths)
  {
    EXPECT_NEAR(length, expected, 1e-12);
  }
}

TEST(ThinWalls, HaveShortNormalsAtAnyThickness)
{
  for (const double thickness : { 0.0, 1e-12, 1e-3, 0.009 * Diagonal })
  {
    SCOPED_TRACE(thickness);
    ExpectAll(LengthsOfNormals(Sheets(thickness, true, true)), 0.5);
    ExpectAll(LengthsOfNormals(Sheets(thickness, true, true), TbbContext(3)), 0.5);
  }
}

TEST(ThinWalls, AreNoThickOnes)
{
  ExpectAll(LengthsOfNormals(Sheets(0.012 * Diagonal, true, true)), 1.0);
}

TEST(ThinWalls, AreNoSheetsThatFaceEachOther)
{
  for (const double distance : { 1e-3, 0.1 })
  {
    ExpectAll(LengthsOfNormals(Sheets(distance, false, false)), 1.0); // a gap
  }
}

/// Both face up. The lower one shows its lines from below alone, the upper one from above.
TEST(ThinWalls, OfSheetsThatFaceTheSameWayHaveNormalsAwayFromEachOther)
{
  for (const double distance : { 1e-6, 1e-3, 0.1 })
  {
    const std::vector<Vector3> normals = NormalsOfInk(Sheets(distance, false, true));
    for (std::size_t face = 0; face < normals.size(); ++face)
    {
      EXPECT_NEAR(normals[face].z(), face < normals.size() / 2 ? -0.5 : 0.5, 1e-12);
    }
  }
  ExpectAll(LengthsOfNormals(Sheets(0.012 * Diagonal, false, true)), 1.0);
}

TEST(ThinWalls, AreNoSingleSheetsOrBalls)
{
  ExpectAll(LengthsOfNormals(FramedMesh(PlaneGrid(Size, Size).Mesh())), 1.0);
  ExpectAll(LengthsOfNormals(FramedMesh(IrregularSphere(3, 7).Mesh())), 1.0);
}

}
