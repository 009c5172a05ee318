// Quads on the integer grid, and the progress of making them.

#include "QuadExamples.h"
#include "Quads/SurfaceQuads.h"
#include "Quads/SymmetricQuads.h"
#include "Support/TbbContext.h"

#include <algorithm>

using namespace dmg;
using namespace dmg::test;

namespace
{

using Place = std::array<int, 2>;

/// Expects each quad to be a unit square of the grid.
void ExpectUnitSquares(const QuadMesh& mesh)
{
  ASSERT_EQ(mesh.Grid.size(), mesh.Quads.size());
  for (const CornersInGrid& square : mesh.Grid)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Place &a = square[k], &b = square[(k + 1) % 4], &c = square[(k + 2) % 4];
      EXPECT_EQ(std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]), 1);
      EXPECT_EQ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]), 1) << "counter-clockwise";
    }
  }
}

/// By vertex, the number of edges at which the grid is cut. An edge is cut if its ends have other coordinates in the two quads beside it.
std::map<int, int> CutsAtVertices(const QuadMesh& mesh)
{
  std::map<std::pair<int, int>, std::pair<Place, Place>> sides;
  for (std::size_t quad = 0; quad < mesh.Quads.size(); ++quad)
  {
    for (int k = 0; k < 4; ++k)
    {
      const int next = (k + 1) % 4;
      sides[{ mesh.Quads[quad][k], mesh.Quads[quad][next] }] = { mesh.Grid[quad][k], mesh.Grid[quad][next] };
    }
  }
  std::map<int, int> cuts;
  for (const auto& [ends, places] : sides)
  {
    const auto twin = sides.find({ ends.second, ends.first });
    if (twin != sides.end() && twin->second != std::make_pair(places.second, places.first))
    {
      ++cuts[ends.first]; // the twin counts at the other end
    }
  }
  return cuts;
}

Surface Square()
{
  Surface square = PlaneGrid(20, 20);
  square.V /= 20.0;
  return square;
}

TEST(QuadGrid, OfSquareIsThatOfItsQuads)
{
  const QuadMesh mesh = MakeQuadsAlongFeatures(FramedMesh(Square().Mesh()), NumberOfQuads(100.0));
  ExpectUnitSquares(mesh);
  EXPECT_TRUE(CutsAtVertices(mesh).empty());
  std::set<Place> places;
  for (const CornersInGrid& square : mesh.Grid)
  {
    places.insert(square.begin(), square.end());
  }
  EXPECT_EQ(places.size(), 121u) << "11 x 11";
}

TEST(QuadGrid, IsCutBetweenIrregularVerticesAlone)
{
  for (const bool isSymmetric : { false, true })
  {
    const FramedMesh surface(IrregularSphere(4, 3).Mesh());
    const QuadMesh mesh = isSymmetric
      ? MakeSymmetricQuads(surface, {}, MirrorPlane{ Vector3::Zero(), Vector3::UnitX() }, NumberOfQuads(400.0))
      : MakeQuadsAlongFeatures(surface, NumberOfQuads(400.0));
    ExpectUnitSquares(mesh);
    const std::map<int, int> cuts = CutsAtVertices(mesh);
    int irregular = 0;
    for (const auto& [vertex, count] : cuts)
    {
      EXPECT_TRUE(count != 1 || mesh.Valences[vertex] != 4) << "a cut ends at a regular vertex";
      irregular += mesh.Valences[vertex] != 4 ? 1 : 0;
    }
    EXPECT_EQ(irregular, mesh.Report.IrregularVertices) << "each is on a cut";
    EXPECT_LT(cuts.size(), mesh.Valences.size() / 2) << "most vertices are on none";
  }
}

TEST(QuadGrid, CountsFacesWithoutAreaInTheMap)
{
  const auto at = [](FixedPoint u, FixedPoint v) { return std::array<FixedPoint, 2>{ u, v }; };
  const MapOfCorners map{ at(0, 0), at(1, 0), at(0, 1), at(0, 0), at(2, 2), at(3, 3), at(0, 0), at(0, 1), at(1, 0),
    at(5, 5), at(5, 5), at(5, 5) };
  EXPECT_EQ(NumberOfFaces(map, 1), 1);
  EXPECT_EQ(NumberOfFaces(map, 0), 2);
  EXPECT_EQ(NumberOfFaces(map, -1), 1);
  const QuadMesh mesh = MakeQuadsAlongFeatures(FramedMesh(IrregularSphere(4, 3).Mesh()), NumberOfQuads(12.0));
  EXPECT_EQ(mesh.Report.FacesWithoutArea, NumberOfFaces(mesh.Map, 0));
  EXPECT_EQ(mesh.Report.FlippedFaces, NumberOfFaces(mesh.Map, -1));
}

void ExpectForth(const TbbContext& context, const char* what)
{
  const std::vector<double>& progress = context.Progress();
  for (std::size_t k = 1; k < progress.size(); ++k)
  {
    ASSERT_GE(progress[k], progress[k - 1] - 1e-12) << what << ", checkpoint " << k;
  }
  EXPECT_LE(progress.back(), 1.0 + 1e-12) << what;
}

TEST(QuadProgress, NeverGoesBack)
{
  Surface small = IrregularSphere(1, 2);
  small.V *= 0.001;
  const FramedMesh surfaces[] = { FramedMesh(Square().Mesh()), FramedMesh(IrregularSphere(4, 3).Mesh()),
    FramedMesh(DoubleTorus(4).Mesh()), FramedMesh(Union(IrregularSphere(3, 1), small, { 4, 0, 0 }).Mesh()) };
  for (const FramedMesh& surface : surfaces)
  {
    Vector<Complex> crosses = CrossesOf(surface);
    for (const double number : { 30.0, 1000.0 })
    {
      const TbbContext alongFeatures(1), alongField(1), acrossGaps(1), symmetric(1);
      MakeQuadsAlongFeatures(surface, NumberOfQuads(number), alongFeatures);
      ExpectForth(alongFeatures, "along features");
      MakeQuads(surface, crosses, NumberOfQuads(number), alongField);
      ExpectForth(alongField, "along a field");
      crosses.head(crosses.size() / 4).setZero();
      MakeQuadsAcrossGaps(surface, crosses, NumberOfQuads(number), acrossGaps);
      ExpectForth(acrossGaps, "across gaps");
      MakeSymmetricQuads(surface, {}, {}, NumberOfQuads(number), symmetric);
      ExpectForth(symmetric, "symmetric");
    }
  }
}

}
