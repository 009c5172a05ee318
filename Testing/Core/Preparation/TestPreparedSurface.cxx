#include "Preparation/PreparedSurface.h"

#include "PreparedSurfaces.h"

#include "Mesh/TangentFrames.h"
#include "Support/Errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// The relation says the same both ways, and corners lie where their points are.
void ExpectConsistent(const PreparedSurface& prepared, const Points& positions, int numberOfCells)
{
  const TriangleMesh& mesh = prepared.Mesh;
  const SurfaceRelation& relation = prepared.Relation;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const std::vector<int> faces = Items(relation.FacesOf(relation.CellOf(face)));
    EXPECT_TRUE(relation.IsPartOfSurface(relation.CellOf(face)));
    EXPECT_EQ(std::count(faces.begin(), faces.end(), face), 1);
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const int point = relation.PointOf(vertex);
    const std::vector<int> vertices = Items(relation.VerticesOf(point));
    EXPECT_EQ(std::count(vertices.begin(), vertices.end(), vertex), 1);
    EXPECT_EQ(mesh.Position(vertex), Vector3(positions.row(point).transpose()));
  }
  for (int cell = 0; cell < numberOfCells; ++cell)
  {
    for (const int face : relation.FacesOf(cell))
    {
      EXPECT_TRUE(face >= 0 && face < mesh.NumberOfFaces());
    }
  }
}

Surface WithFaces(const Surface& surface, const std::vector<std::array<int, 3>>& more)
{
  Surface result = surface;
  result.F.conservativeResize(surface.F.rows() + static_cast<Eigen::Index>(more.size()), 3);
  for (std::size_t i = 0; i < more.size(); ++i)
  {
    result.F.row(surface.F.rows() + static_cast<Eigen::Index>(i)) << more[i][0], more[i][1], more[i][2];
  }
  return result;
}

/// A plate of squares with a wall on its middle line.
Surface PlateWithStiffener(int size)
{
  Surface plate = PlaneGrid(size, size);
  std::vector<int> line;
  for (int v = 0; v < plate.V.rows(); ++v)
  {
    if (plate.V(v, 0) == size / 2)
    {
      line.push_back(v);
    }
  }
  const int below = static_cast<int>(plate.V.rows());
  plate.V.conservativeResize(below + static_cast<Eigen::Index>(line.size()), 3);
  std::vector<std::array<int, 3>> wall;
  for (int j = 0; j < static_cast<int>(line.size()); ++j)
  {
    plate.V.row(below + j) = plate.V.row(line[j]) + Eigen::RowVector3d(0.0, 0.0, 1.0);
    if (j > 0)
    {
      wall.push_back({ line[j - 1], line[j], below + j });
      wall.push_back({ line[j - 1], below + j, below + j - 1 });
    }
  }
  return WithFaces(plate, wall);
}

}

TEST(PreparedSurface, LeavesAManifoldAsItIs)
{
  for (const Surface& surface : { Icosphere(2), PlaneGrid(5, 4), Torus(9, 7), CapsuleFromRectangle(8, 4) })
  {
    const PreparedSurface prepared = Prepared(surface, { Numbering::AsGiven, false, false });
    EXPECT_TRUE(prepared.Relation.IsOneToOne());
    EXPECT_EQ(prepared.Report.Text(), "");
    EXPECT_EQ(prepared.Mesh.FaceCorners(), surface.F);
    EXPECT_EQ(prepared.Mesh.VertexPositions(), surface.V);
    ExpectConsistent(Prepared(surface), surface.V, static_cast<int>(surface.F.rows()));
  }
}

// The second axis of each frame stays, the first one and the normal are reversed.
TEST(PreparedSurface, IsSeenFromItsPositiveSide)
{
  Surface inside = Icosphere(1);
  inside.F.col(1).swap(inside.F.col(2));
  const Surface both = Union(inside, PlaneGrid(3, 3), { 9.0, 0.0, 0.0 });
  const PreparedSurface asGiven = Prepared(both, { Numbering::AsGiven, true, false, true });
  const PreparedSurface prepared = Prepared(both, { Numbering::AsGiven });
  const TangentFrames before = FaceFrames(asGiven.Mesh), after = FaceFrames(prepared.Mesh);
  for (int face = 0; face < prepared.Mesh.NumberOfFaces(); ++face)
  {
    EXPECT_EQ(prepared.Relation.IsTurned(face), face < 80);
    const double sign = face < 80 ? -1.0 : 1.0;
    EXPECT_LT((after.X.row(face) - sign * before.X.row(face)).norm(), 1e-14);
    EXPECT_LT((after.Y.row(face) - before.Y.row(face)).norm(), 1e-14);
  }
  EXPECT_FALSE(prepared.Report.IsChanged());
  EXPECT_EQ(prepared.Report.Sides, (std::vector<PositiveSide>{ PositiveSide::Outside, PositiveSide::Up }));
  EXPECT_TRUE(asGiven.Relation.Turned().empty());
  EXPECT_EQ(asGiven.Report.Sides, std::vector<PositiveSide>{ PositiveSide::OfCells });
}

TEST(PreparedSurface, MakesASphereOfASoup)
{
  const Surface soup = Soup(Icosphere(2)); // 320 faces, 162 vertices
  const PreparedSurface prepared = Prepared(soup);
  EXPECT_EQ(prepared.Mesh.NumberOfVertices(), 162);
  EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2);
  EXPECT_EQ(NumberOfBoundaryEdges(prepared.Mesh), 0);
  EXPECT_EQ(prepared.Report.Text(), "798 points joined"); // 960 - 162
  EXPECT_FALSE(prepared.Report.IsChanged());
  for (int point = 0; point < 960; ++point)
  {
    ASSERT_EQ(prepared.Relation.VerticesOf(point).size(), 1);
    const Vector3 position = prepared.Mesh.Position(prepared.Relation.VerticesOf(point).front());
    EXPECT_EQ(position, Vector3(soup.V.row(point).transpose()));
  }
  ExpectConsistent(prepared, soup.V, 320);
  EXPECT_EQ(Prepared(soup, { Numbering::Spatial, false, false }).Mesh.NumberOfVertices(), 960);
}

// The seam of a surface of revolution, computed in single precision, closes; a capsule from a rectangle has collapsed sides.
TEST(PreparedSurface, ClosesSeamsOfRounding)
{
  const Surface capsule = CapsuleFromRectangle(16, 9);
  for (const double rounding : { 0.0, 1e-8, 2e-7 })
  {
    Surface rounded = capsule;
    rounded.V += rounding * Points::Random(capsule.V.rows(), 3);
    const PreparedSurface prepared = Prepared(rounded);
    EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2);
    EXPECT_EQ(NumberOfBoundaryEdges(prepared.Mesh), 0);
    EXPECT_GT(prepared.Report.PointsJoined, 0);
  }
}

TEST(PreparedSurface, KeepsGapsAndThinWalls)
{
  for (const double gap : { 1e-1, 1e-3, 1e-4 })
  {
    const PreparedSurface beside = Prepared(Union(PlaneGrid(4, 4), PlaneGrid(4, 4), Vector3(4.0 + gap, 0.0, 0.0)));
    EXPECT_EQ(NumberOfComponents(beside.Mesh), 2) << gap;
    const PreparedSurface above = Prepared(Union(PlaneGrid(4, 4), PlaneGrid(4, 4), Vector3(0.0, 0.0, gap)));
    EXPECT_EQ(NumberOfComponents(above.Mesh), 2) << gap;
  }
  const PreparedSurface joined = Prepared(Union(PlaneGrid(4, 4), PlaneGrid(4, 4), Vector3(4.0, 0.0, 0.0)));
  EXPECT_EQ(NumberOfComponents(joined.Mesh), 1);
  EXPECT_EQ(joined.Mesh.EulerCharacteristic(), 1);
  EXPECT_EQ(joined.Report.PointsJoined, 5);
}

// Metres of a national grid, in double precision, tell a slit of a millimetre; in single precision they round by half a metre.
TEST(PreparedSurface, ClosesGapsByThePrecisionThatCoordinatesHave)
{
  for (const double gap : { 1e-2, 1e-3, 1e-4 })
  {
    Surface far = Union(PlaneGrid(4, 4), PlaneGrid(4, 4), Vector3(4.0 + gap, 0.0, 0.0));
    far.V.rowwise() += Eigen::RowVector3d(5e5, 4.6e6, 0.0);
    EXPECT_EQ(NumberOfComponents(Prepared(far).Mesh), 2) << gap;
  }
  for (const double rounding : { 0.0, 1e-9, 1e-6 })
  {
    Surface far = Union(PlaneGrid(4, 4), PlaneGrid(4, 4), Vector3(4.0 + rounding, 0.0, 0.0));
    far.V.rowwise() += Eigen::RowVector3d(5e5 + 0.1, 4.6e6, 0.0);
    EXPECT_EQ(Prepared(far).Report.PointsJoined, 5) << rounding;
  }
  Surface single = Union(PlaneGrid(4, 4), PlaneGrid(4, 4), Vector3(4.0, 0.0, 0.0));
  single.V = (100.0 * single.V).eval();
  single.V.rowwise() += Eigen::RowVector3d(5e5, 4.6e6, 0.0);
  single.V.row(25) += Eigen::RowVector3d(0.0, 0.5, 0.0); // the next number in single precision
  EXPECT_EQ(Prepared(single).Report.PointsJoined, 5);
}

// A plane from 0 to 100 whose cells have heights from 1e-6 on, as those along a wall in a flow: single precision does not tell
// the first 30 rows from each other, but they are rows.
TEST(PreparedSurface, KeepsLayersThatAreThinnerThanRounding)
{
  Surface layers = PlaneGrid(10, 60);
  for (int v = 0; v < layers.V.rows(); ++v)
  {
    layers.V(v, 0) *= 10.0;
    layers.V(v, 1) = 5e-6 * (std::pow(1.2, layers.V(v, 1)) - 1.0);
  }
  const PreparedSurface prepared = Prepared(layers);
  EXPECT_EQ(prepared.Mesh.NumberOfFaces(), layers.F.rows());
  EXPECT_EQ(prepared.Report.Text(), "");
  // Also where something else is to be repaired.
  Surface withFlip = layers;
  std::swap(withFlip.F(700, 0), withFlip.F(700, 1));
  const PreparedSurface repaired = Prepared(withFlip);
  EXPECT_EQ(repaired.Mesh.NumberOfFaces(), layers.F.rows());
  EXPECT_EQ(repaired.Report.Text(), "1 cell turned");
}

// Nothing would be left of a plane that is 1e-6 as wide as long if points were joined across it.
TEST(PreparedSurface, KeepsANarrowPlane)
{
  Surface plane = PlaneGrid(5, 5);
  plane.V.col(1) *= 1e-6;
  const PreparedSurface prepared = Prepared(plane);
  EXPECT_EQ(prepared.Mesh.NumberOfFaces(), plane.F.rows());
  EXPECT_EQ(NumberOfComponents(prepared.Mesh), 1);
}

TEST(PreparedSurface, RefusesDuplicatesOnly)
{
  const Surface plane = PlaneGrid(2, 2);
  CellTriangles triangles = TrianglesOf(plane);
  triangles.IsDuplicate.assign(plane.F.rows(), 1);
  try
  {
    PrepareSurface(std::move(triangles), {});
    ADD_FAILURE() << "no error";
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("duplicates of other ones"), std::string::npos) << error.what();
  }
}

TEST(PreparedSurface, OrientsAsMostOfAComponent)
{
  const Surface both = Union(Icosphere(1), Torus(8, 6), Vector3(5.0, 0.0, 0.0));
  Surface turned = both;
  for (const int face : { 2, 3, 40, 100, 101 })
  {
    std::swap(turned.F(face, 0), turned.F(face, 1));
  }
  const PreparedSurface prepared = Prepared(turned);
  EXPECT_EQ(prepared.Report.Text(), "5 cells turned");
  double volume = 0.0, expected = 0.0; // positive where normals point outwards
  const TriangleMesh mesh = both.Mesh();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    expected += mesh.Position(mesh.Tail(3 * face)).dot(mesh.FaceAreaVector(face));
    volume += prepared.Mesh.Position(prepared.Mesh.Tail(3 * face)).dot(prepared.Mesh.FaceAreaVector(face));
  }
  EXPECT_NEAR(volume, expected, 1e-12 * expected);
  EXPECT_THROW(Prepared(turned, { Numbering::Spatial, true, true }), InvalidInput);
}

// Files of finite elements have the sides of solids as cells of their own.
TEST(PreparedSurface, LetsDoubledQuadsHaveTheFacesOfTheirTwins)
{
  const std::vector<std::vector<int>> quads = { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 },
    { 2, 3, 7, 6 }, { 3, 0, 4, 7 } };
  Points corners(8, 3);
  corners << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1;
  for (int doubled = 1; doubled <= 6; ++doubled)
  {
    for (const bool isTurned : { false, true })
    {
      std::vector<std::vector<int>> all = quads;
      for (int k = 0; k < doubled; ++k)
      {
        std::vector<int> twin = quads[k];
        std::rotate(twin.begin(), twin.begin() + 1, twin.end());
        isTurned ? std::reverse(twin.begin(), twin.end()) : void();
        all.push_back(twin);
      }
      const PreparedSurface prepared = PrepareSurface(Triangulate(Polygons(corners, all)), {});
      EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2);
      EXPECT_EQ(prepared.Report.CellsDoubled, doubled);
      EXPECT_EQ(prepared.Report.EdgesParted + prepared.Report.PointsParted, 0) << prepared.Report.Text();
      for (int k = 0; k < doubled; ++k)
      {
        EXPECT_GT(prepared.Relation.FacesOf(6 + k).size(), 0u);
      }
    }
  }
  const PreparedSurface quad = PrepareSurface(Triangulate(Polygons(corners, { quads[0], quads[0] })), {});
  EXPECT_EQ(quad.Mesh.EulerCharacteristic(), 1);
}

// Longitudes of a file go on beyond 360 degrees, and cosines round these columns otherwise than the first ones.
TEST(PreparedSurface, CyclicColumnsCountOnceThoughCosinesRoundThem)
{
  constexpr int Around = 78, Rows = 20;
  for (const int more : { 1, 2, 5, Around })
  {
    for (const double first : { 0.0, 0.1 })
    {
      for (const bool areSingle : { false, true })
      {
        SCOPED_TRACE(std::to_string(more) + " columns more, in " + (areSingle ? "single" : "double") + " precision");
        const int columns = Around + more + 1;
        Points places(columns * (Rows + 1), 3);
        std::vector<std::vector<int>> quads;
        for (int row = 0; row <= Rows; ++row)
        {
          const double latitude = 3.0 * (row - 0.5 * Rows) / 180.0 * Pi;
          for (int column = 0; column < columns; ++column)
          {
            const double longitude = first + column * (2.0 * Pi / Around);
            const int at = row * columns + column;
            places.row(at) << std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
              std::sin(latitude);
            if (row < Rows && column + 1 < columns)
            {
              quads.push_back({ at, at + 1, at + columns + 1, at + columns });
            }
          }
        }
        places *= 6371.0;
        places = areSingle ? places.cast<float>().cast<double>().eval() : places;
        const PreparedSurface prepared = PrepareSurface(Triangulate(Polygons(places, quads)), {});
        EXPECT_EQ(prepared.Mesh.NumberOfFaces(), 2 * Around * Rows);
        EXPECT_EQ(NumberOfComponents(prepared.Mesh), 1);
        EXPECT_EQ(NumberOfBoundaryEdges(prepared.Mesh), 2 * Around);
        EXPECT_EQ(prepared.Report.CellsDoubled, more * Rows);
        EXPECT_EQ(prepared.Report.EdgesParted + prepared.Report.PointsParted + prepared.Report.EdgesCut, 0)
          << prepared.Report.Text();
      }
    }
  }
}

TEST(PreparedSurface, LetsADoubledTriangleHaveTheFaceOfItsTwin)
{
  const Surface sphere = Icosphere(1);
  const auto f = [&sphere](int t, int k) { return sphere.F(t, k); };
  const Surface doubled =
    WithFaces(sphere, { { f(5, 0), f(5, 1), f(5, 2) }, { f(9, 2), f(9, 1), f(9, 0) }, { f(5, 1), f(5, 2), f(5, 0) } });
  const PreparedSurface prepared = Prepared(doubled);
  EXPECT_EQ(prepared.Mesh.NumberOfFaces(), 80);
  EXPECT_EQ(prepared.Report.Text(), "3 cells doubled");
  EXPECT_EQ(Items(prepared.Relation.FacesOf(80)), Items(prepared.Relation.FacesOf(5)));
  EXPECT_EQ(Items(prepared.Relation.FacesOf(81)), Items(prepared.Relation.FacesOf(9)));
  EXPECT_FALSE(prepared.Relation.IsPartOfSurface(82));
  ExpectConsistent(prepared, doubled.V, 83);
}

// A copied sheet has the field of the first; solids that touch stay two.
TEST(PreparedSurface, TellsCopiesFromSolidsThatTouch)
{
  const Surface plane = PlaneGrid(4, 3);
  const PreparedSurface copied = Prepared(Union(plane, plane, Vector3::Zero()));
  EXPECT_EQ(copied.Mesh.NumberOfFaces(), 24);
  EXPECT_EQ(copied.Mesh.EulerCharacteristic(), 1);
  EXPECT_EQ(Items(copied.Relation.FacesOf(24 + 7)), Items(copied.Relation.FacesOf(7)));
  EXPECT_EQ(Items(copied.Relation.VerticesOf(20 + 6)), Items(copied.Relation.VerticesOf(6)));
}

TEST(PreparedSurface, CutsAMoebiusStripOnce)
{
  for (const int around : { 5, 9, 40 })
  {
    const PreparedSurface prepared = Prepared(MoebiusStrip(around));
    EXPECT_EQ(prepared.Mesh.NumberOfFaces(), 2 * around);
    EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 1); // a disc
    EXPECT_EQ(NumberOfComponents(prepared.Mesh), 1);
    EXPECT_EQ(prepared.Report.EdgesCut, 1); // the strip is one edge wide
  }
}

TEST(PreparedSurface, LetsAPlateGoOnUnderItsStiffener)
{
  const Surface surface = PlateWithStiffener(8);
  const PreparedSurface prepared = Prepared(surface);
  EXPECT_EQ(NumberOfComponents(prepared.Mesh), 2);
  EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2); // two discs
  EXPECT_EQ(prepared.Report.Text(), "8 edges of more than two sheets parted");
  const std::vector<int> components = FaceComponents(prepared.Mesh);
  for (int cell = 0; cell < 128 + 16; ++cell)
  {
    EXPECT_EQ(components[prepared.Relation.FacesOf(cell).front()] == components[prepared.Relation.FacesOf(0).front()],
      cell < 128);
  }
  ExpectConsistent(prepared, surface.V, 144);
}

// Two cubes with an edge in common, a zigzag of three and a checkerboard, as voxels have them; also with all normals inwards.
TEST(PreparedSurface, KeepsSolidsWithACommonEdgeClosed)
{
  std::vector<std::array<int, 3>> checkerboard;
  for (int k = 0; k < 64; ++k)
  {
    if ((k % 4 + k / 4 % 4 + k / 16) % 2 == 0)
    {
      checkerboard.push_back({ k % 4, k / 4 % 4, k / 16 });
    }
  }
  for (const auto& voxels : { std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 1, 0 } },
         std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 } }, checkerboard })
  {
    for (const bool isInsideOut : { false, true })
    {
      Surface surface = Voxels(voxels);
      if (isInsideOut)
      {
        surface.F.col(1).swap(surface.F.col(2));
      }
      const PreparedSurface prepared = Prepared(surface);
      EXPECT_EQ(NumberOfBoundaryEdges(prepared.Mesh), 0);
      EXPECT_EQ(NumberOfComponents(prepared.Mesh), static_cast<int>(voxels.size()));
      EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2 * static_cast<int>(voxels.size()));
      EXPECT_EQ(prepared.Report.CellsTurned + prepared.Report.EdgesCut, 0);
      ExpectConsistent(prepared, surface.V, static_cast<int>(surface.F.rows()));
    }
  }
}

// Both sides of the face stay, so that each solid is a sphere.
TEST(PreparedSurface, KeepsSolidsWithACommonFaceClosed)
{
  for (const auto& voxels : { std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 0, 0 } },
         std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } },
         std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
         std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 1, 1 } } })
  {
    const Surface surface = Voxels(voxels);
    const PreparedSurface prepared = Prepared(surface);
    EXPECT_EQ(prepared.Mesh.NumberOfFaces(), surface.F.rows());
    EXPECT_EQ(NumberOfBoundaryEdges(prepared.Mesh), 0);
    EXPECT_EQ(NumberOfComponents(prepared.Mesh), static_cast<int>(voxels.size()));
    EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2 * static_cast<int>(voxels.size()));
    EXPECT_EQ(prepared.Report.CellsTurned + prepared.Report.CellsDoubled + prepared.Report.EdgesCut, 0);
  }
}

// One sheet of which the file has both sides.
TEST(PreparedSurface, TakesOneSideOfASheetWithTwo)
{
  const Surface plane = PlaneGrid(4, 3);
  Surface both = plane;
  both.F.conservativeResize(48, 3);
  both.F.bottomRows(24) = plane.F.rowwise().reverse();
  const PreparedSurface prepared = Prepared(both);
  EXPECT_EQ(prepared.Mesh.NumberOfFaces(), 24);
  EXPECT_EQ(prepared.Report.Text(), "24 cells doubled");
}

// Three sheets at an edge, of which the flattest two disagree: nothing is turned, as each of them has another that agrees.
TEST(PreparedSurface, TurnsNoSheetThatAgreesWithAnother)
{
  const double angles[] = { 0.0, 125.0, 240.0 };
  Surface book{ Points(5, 3), Triangles(3, 3) };
  book.V.topRows(2) << 0, 0, 0, 0, 0, 1;
  for (int sheet = 0; sheet < 3; ++sheet)
  {
    book.V.row(2 + sheet) << std::cos(angles[sheet] * Pi / 180.0), std::sin(angles[sheet] * Pi / 180.0), 0.5;
    book.F.row(sheet) << (sheet < 2 ? 0 : 1), (sheet < 2 ? 1 : 0), 2 + sheet;
  }
  const PreparedSurface prepared = Prepared(book);
  EXPECT_EQ(prepared.Report.Text(), "1 edge of more than two sheets parted");
  const std::vector<int> components = FaceComponents(prepared.Mesh);
  const auto componentOf = [&](int cell) { return components[prepared.Relation.FacesOf(cell).front()]; };
  EXPECT_EQ(componentOf(0), componentOf(2)); // flatter than 1 and 2
  EXPECT_NE(componentOf(0), componentOf(1));
}

// The skin of a tetrahedron beside a triangle that is given once more, from the other side: the triangle of the skin stays.
TEST(PreparedSurface, KeepsTheTriangleThatAgreesOfTwins)
{
  for (const int place : { 0, 4 }) // of the other side
  {
    Surface skin{ Points(4, 3), Triangles(5, 3) };
    skin.V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    const int corners[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } };
    for (int k = 0; k < 4; ++k)
    {
      skin.F.row(k + (place == 0 ? 1 : 0)) << corners[k][0], corners[k][1], corners[k][2];
    }
    skin.F.row(place) << 1, 3, 2;
    const PreparedSurface prepared = Prepared(skin);
    EXPECT_EQ(prepared.Report.Text(), "1 cell doubled") << place;
    EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2);
    ExpectConsistent(prepared, skin.V, 5);
  }
}

// Two plates that cross, each given with both of its sides, in any order: each goes on through the other.
TEST(PreparedSurface, LetsPlatesWithTwoSidesCross)
{
  for (int order = 0; order < 16; ++order)
  {
    Surface plates{ Points(10, 3), Triangles(16, 3) };
    plates.V << 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, -1, 0, 0, -1, 0, 1, 0, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, 1;
    for (int half = 0; half < 4; ++half)
    {
      for (int side = 0; side < 2; ++side)
      {
        const int low = 2 + 2 * half, row = 4 * half + 2 * side;
        const bool isReversed = (side == 1) != ((order >> half & 1) != 0);
        plates.F.row(row) << 0, low, low + 1;
        plates.F.row(row + 1) << 0, low + 1, 1;
        if (isReversed)
        {
          plates.F.row(row).reverseInPlace();
          plates.F.row(row + 1).reverseInPlace();
        }
      }
    }
    const PreparedSurface prepared = Prepared(plates);
    EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2) << order; // two discs
    const std::vector<int> components = FaceComponents(prepared.Mesh);
    const auto componentOf = [&](int half) { return components[prepared.Relation.FacesOf(4 * half).front()]; };
    EXPECT_EQ(componentOf(0), componentOf(1)) << order;
    EXPECT_EQ(componentOf(2), componentOf(3)) << order;
    EXPECT_NE(componentOf(0), componentOf(2)) << order;
  }
}

// Whatever solids touch along edges, their common boundary is closed, and each triangle runs as it was given.
TEST(PreparedSurface, KeepsAnyVoxelsClosed)
{
  for (unsigned seed = 1; seed <= 100; ++seed)
  {
    std::mt19937 random(seed);
    std::vector<std::array<int, 3>> voxels;
    for (int k = 0; k < 27; ++k)
    {
      if (random() % 2)
      {
        voxels.push_back({ k % 3, k / 3 % 3, k / 9 });
      }
    }
    const Surface surface = Voxels(voxels, Interfaces::Left);
    const PreparedSurface prepared = Prepared(surface);
    EXPECT_EQ(prepared.Mesh.NumberOfFaces(), surface.F.rows()) << seed;
    EXPECT_EQ(NumberOfBoundaryEdges(prepared.Mesh), 0) << seed;
    EXPECT_EQ(prepared.Report.CellsTurned + prepared.Report.EdgesCut, 0) << seed;
  }
}

// 20,000 sheets at one edge.
TEST(PreparedSurface, PairsAnyNumberOfSheets)
{
  const int sheets = 20000;
  Surface book;
  book.V.resize(2 + sheets, 3);
  book.F.resize(sheets, 3);
  book.V.topRows(2) << 0, 0, 0, 0, 0, 1;
  for (int k = 0; k < sheets; ++k)
  {
    const double angle = 2.0 * Pi * k / sheets;
    book.V.row(2 + k) << std::cos(angle), std::sin(angle), 0.5;
    book.F.row(k) << 0, 1, 2 + k;
  }
  const PreparedSurface prepared = Prepared(book);
  EXPECT_EQ(NumberOfComponents(prepared.Mesh), sheets / 2);
  EXPECT_EQ(prepared.Report.CellsTurned, sheets / 2);
}

TEST(PreparedSurface, PartsAPinchedPointIntoItsFans)
{
  const PreparedSurface prepared = Prepared(PinchedTetrahedra());
  EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 4);
  EXPECT_EQ(prepared.Relation.VerticesOf(0).size(), 2);
  EXPECT_EQ(prepared.Report.Text(), "1 pinched point parted");
}

// A triangle with a corner twice leaves no hole, and has the faces on both sides of it.
TEST(PreparedSurface, JoinsTheNeighboursOfCollapsedTriangles)
{
  const Surface sphere = Icosphere(1);
  const Surface surface = WithFaces(sphere, { { sphere.F(40, 0), sphere.F(40, 0), sphere.F(40, 2) } });
  const PreparedSurface prepared = Prepared(surface);
  EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2);
  EXPECT_EQ(NumberOfBoundaryEdges(prepared.Mesh), 0);
  EXPECT_EQ(prepared.Report.Text(), "1 cell without area");
  const std::vector<int> around = Items(prepared.Relation.FacesOf(80));
  EXPECT_EQ(around.size(), 2u);
  EXPECT_EQ(std::count(around.begin(), around.end(), prepared.Relation.FacesOf(40).front()), 1);

  // Its points only coincide with those of its neighbours.
  Surface apart = WithFaces(sphere, { { 42, 42, 43 } });
  apart.V.conservativeResize(44, 3);
  apart.V.row(42) = sphere.V.row(sphere.F(40, 0));
  apart.V.row(43) = sphere.V.row(sphere.F(40, 2));
  EXPECT_EQ(Items(Prepared(apart).Relation.FacesOf(80)).size(), 2u);
}

// Two triangles back to back, whose corners lie on an edge of others, are a line there, and one beside them is no surface of its own.
TEST(PreparedSurface, MakesLinesOfPartsWithoutArea)
{
  Surface solid{ Points(5, 3), Triangles(6, 3) };
  solid.V << 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 2, 0, 0;
  solid.F << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 4, 1, 1, 4, 0;
  const PreparedSurface prepared = Prepared(solid);
  EXPECT_EQ(prepared.Mesh.NumberOfFaces(), 4);
  EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2);
  EXPECT_EQ(prepared.Report.Text(), "2 cells without area");
  for (const int cell : { 4, 5 })
  {
    std::vector<int> around;
    for (const int face : Items(prepared.Relation.FacesOf(cell)))
    {
      around.push_back(prepared.Relation.CellOf(face));
    }
    std::sort(around.begin(), around.end());
    EXPECT_EQ(around, (std::vector<int>{ 0, 1 })); // which have the edge
  }

  Surface beside = WithFaces(solid, { { 5, 6, 7 } });
  beside.F.row(4) = beside.F.row(5) = beside.F.row(0); // twins
  beside.V.conservativeResize(8, 3);
  beside.V.bottomRows(3) << 9, 0, 0, 9, 1, 0, 9, 2, 0;
  EXPECT_EQ(Prepared(beside).Mesh.EulerCharacteristic(), 2);
  EXPECT_TRUE(Prepared(beside).Relation.FacesOf(6).empty());

  // A flat triangle between others holds them together.
  Surface strip{ Points(4, 3), Triangles(3, 3) };
  strip.V << 0, 0, 0, 2, 0, 0, 1, 1, 0, 1, 0, 0;
  strip.F << 0, 3, 2, 3, 1, 2, 0, 1, 3;
  EXPECT_EQ(Prepared(strip).Mesh.NumberOfFaces(), 3);
}

// Quads with two sides in common have the diagonal in common that is the better one for both.
TEST(PreparedSurface, CutsQuadsAlongDiagonalsOfTheirOwn)
{
  Points positions(6, 3);
  positions << -0.5, 0, 0, 0.5, 0, 0, 0, 0, 0.87, 0, 0.87, 0, 0, -0.87, 0, 0, 0, -0.87;
  const PreparedSurface two =
    PrepareSurface(Polygons(positions, { { 0, 2, 1, 3 }, { 1, 2, 0, 4 } }), { Numbering::Spatial, true, true });
  EXPECT_EQ(two.Mesh.EulerCharacteristic(), 1);
  EXPECT_EQ(two.Report.Text(), "");
  const PreparedSurface sphere =
    PrepareSurface(Polygons(positions, { { 0, 2, 1, 3 }, { 1, 2, 0, 4 }, { 3, 1, 5, 0 }, { 4, 0, 5, 1 } }),
      { Numbering::Spatial, true, true });
  EXPECT_EQ(sphere.Mesh.EulerCharacteristic(), 2);
  EXPECT_EQ(NumberOfBoundaryEdges(sphere.Mesh), 0);
}

// The best diagonals of a quad and of a pentagon run between points 0 and 2, where two other triangles meet.
TEST(PreparedSurface, CutsNothingAlongASideOfOthers)
{
  Points positions(7, 3);
  positions << 0, 0, 0, 0.6, -0.6, 0, 1.2, 0, 0, 0.6, 0.6, 0, 0.6, 0, 1, 0.1, 0.5, 0, 0.6, 0, -1;
  for (const std::vector<int>& polygon : { std::vector<int>{ 0, 1, 2, 3 }, { 0, 1, 2, 3, 5 } })
  {
    Points wide = positions;
    wide.col(1) *= 1.5;
    const CellTriangles alone = Triangulate(Polygons(wide, { polygon }));
    const auto hasSide = [&alone](int t)
    { return (alone.Corners.row(t).array() == 0).any() && (alone.Corners.row(t).array() == 2).any(); };
    EXPECT_TRUE(hasSide(0) || hasSide(1));
    const PreparedSurface prepared = PrepareSurface(Polygons(wide, { polygon, { 0, 2, 4 }, { 2, 0, 6 } }), {});
    EXPECT_EQ(prepared.Report.EdgesParted + prepared.Report.CellsDoubled, 0) << prepared.Report.Text();
  }
}

TEST(PreparedSurface, LeavesOutDuplicatesAndFillsThemFromTheirTwins)
{
  const Surface sphere = Icosphere(1);
  const auto f = [&sphere](int t, int k) { return sphere.F(t, k); };
  const Surface surface = WithFaces(sphere, { { f(3, 0), f(3, 1), f(3, 2) } });
  for (const int duplicate : { 3, 80 }) // whichever comes first
  {
    CellTriangles triangles = TrianglesOf(surface);
    triangles.IsDuplicate.assign(81, 0);
    triangles.IsDuplicate[duplicate] = 1;
    const PreparedSurface prepared = PrepareSurface(std::move(triangles), {});
    EXPECT_EQ(prepared.Mesh.EulerCharacteristic(), 2);
    EXPECT_EQ(prepared.Report.Text(), "");
    EXPECT_EQ(Items(prepared.Relation.FacesOf(3)), Items(prepared.Relation.FacesOf(80)));
    EXPECT_FALSE(prepared.Relation.IsPartOfSurface(duplicate));
  }
}

TEST(PreparedSurface, HasTheEdgesOfPolygonsWithoutDiagonals)
{
  Points cube(8, 3);
  for (int v = 0; v < 8; ++v)
  {
    cube.row(v) << v % 2, v / 2 % 2, v / 4;
  }
  const PreparedSurface prepared = PrepareSurface(
    Polygons(cube, { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } }),
    {});
  EXPECT_EQ(prepared.Mesh.NumberOfFaces(), 12);
  EXPECT_EQ(prepared.Relation.Edges().size(), 12u);
  for (const int edge : prepared.Relation.Edges())
  {
    const auto [a, b] = prepared.Mesh.EdgeVertices(edge);
    EXPECT_NEAR((prepared.Mesh.Position(a) - prepared.Mesh.Position(b)).norm(), 1.0, 1e-15);
  }
}

// Triangles between random points of a lattice: every kind of meeting, many times.
TEST(PreparedSurface, MakesAManifoldOfAnyTriangles)
{
  for (unsigned seed = 1; seed <= 300; ++seed)
  {
    std::mt19937 random(seed * 7919);
    Surface surface;
    surface.V.resize(12, 3);
    for (int i = 0; i < surface.V.size(); ++i)
    {
      surface.V.data()[i] = static_cast<double>(random() % 3);
    }
    surface.F.resize(2 + random() % 40, 3);
    for (int i = 0; i < surface.F.size(); ++i)
    {
      surface.F.data()[i] = static_cast<int>(random() % 12);
    }
    try
    {
      ExpectConsistent(Prepared(surface), surface.V, static_cast<int>(surface.F.rows()));
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find("no triangle of the surface has an area"), std::string::npos)
        << seed << ": " << error.what();
    }
  }
}

TEST(PreparedSurface, NamesTheCallersElements)
{
  Surface surface = PlaneGrid(3, 3);
  surface.V(5, 1) = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Surface& bad) -> std::string
  {
    try
    {
      Prepared(bad);
    }
    catch (const InvalidInput& error)
    {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(surface).find("point 5"), std::string::npos) << message(surface);
  surface = PlaneGrid(3, 3);
  surface.F(7, 1) = 99;
  EXPECT_NE(message(surface).find("cell 7 uses point 99"), std::string::npos) << message(surface);
  try
  {
    PrepareSurface(Polygons(surface.V, { { 0, 1, 2, 3 }, { 0, 1, -1, 2 } }), {});
    ADD_FAILURE() << "no error";
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("cell 1 uses point -1"), std::string::npos) << error.what();
  }
}
