// Isolines of a map, and what they cut the surface into.

#include "Quads/Isolines/IndexedQuads.h"
#include "Quads/Isolines/IsolineArrangement.h"
#include "Quads/Isolines/IsolineCells.h"

#include "Support/DisjointSets.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A surface without seams, and a map with these coordinates of its points.
struct MappedSurface
{
  TriangleMesh Mesh;
  CutSurface Cut;
  MapOfCorners Map;

  MappedSurface(const Surface& shape, const Eigen::MatrixX2d& coordinates)
    : Mesh(shape.Mesh())
    , Map(3 * this->Mesh.NumberOfFaces())
  {
    this->Cut.Matchings.assign(3 * this->Mesh.NumberOfFaces(), 0);
    for (int h = 0; h < 3 * this->Mesh.NumberOfFaces(); ++h)
    {
      for (int c = 0; c < 2; ++c)
      {
        this->Map[h][c] = std::llround(coordinates(this->Mesh.Tail(h), c) * FixedOne);
        this->Map[h][c] += this->Map[h][c] % FixedOne == FixedOne / 2 ? 1 : 0;
      }
    }
  }

  IsolineArrangement Isolines() const { return ArrangeIsolines(this->Mesh, this->Cut, this->Map, SerialContext()); }
};

Eigen::MatrixX2d Plane(const Surface& shape)
{
  return shape.V.leftCols<2>();
}

/// Inner points moved at random, by so much that many faces turn over.
MappedSurface FoldedPlane(unsigned seed)
{
  const Surface shape = IrregularPlane(6, 5, seed, 0.0);
  Eigen::MatrixX2d coordinates = Plane(shape);
  Random random(seed);
  for (int point = 0; point < coordinates.rows(); ++point)
  {
    const bool isInner =
      shape.V(point, 0) > 0.0 && shape.V(point, 0) < 6.0 && shape.V(point, 1) > 0.0 && shape.V(point, 1) < 5.0;
    coordinates(point, 0) += isInner ? random.Uniform(-2.0, 2.0) : 0.0;
    coordinates(point, 1) += isInner ? random.Uniform(-2.0, 2.0) : 0.0;
  }
  return MappedSurface(shape, coordinates);
}

TEST(IsolineArrangement, OfGridHasCrossingPerSquareAndCellPerPoint)
{
  for (const int faces : { 1, 4 })
  {
    const Surface shape = PlaneGrid(faces, faces);
    const MappedSurface surface(shape, Plane(shape) * (4.0 / faces)); // to 4 by 4
    const IsolineArrangement isolines = surface.Isolines();
    const IsolineCells cells = FindCells(surface.Mesh, isolines);
    EXPECT_EQ(isolines.NumberOfCrossings, 16);
    EXPECT_EQ(isolines.Nodes.size(), 16u + 16u);
    EXPECT_EQ(cells.Size(), 25 + 1); // and what is outside
    EXPECT_EQ(std::count(cells.IsOnBoundary.begin(), cells.IsOnBoundary.end(), 1), 16 + 1);
  }
}

TEST(IsolineArrangement, OfGridHasQuadsCounterClockwise)
{
  const Surface shape = PlaneGrid(3, 3);
  const MappedSurface surface(shape, Plane(shape));
  const IsolineArrangement isolines = surface.Isolines();
  const IsolineCells cells = FindCells(surface.Mesh, isolines);
  std::vector<int> points(cells.Size(), -1);
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    points[cells.OfVertices[vertex]] = vertex;
  }
  const IndexedQuads quads = QuadsOfCells(isolines, cells);
  ASSERT_EQ(quads.Size(), 9);
  for (const auto& quad : quads.Corners)
  {
    const Vector3 a = surface.Mesh.Position(points[quad[0]]), b = surface.Mesh.Position(points[quad[1]]);
    const Vector3 c = surface.Mesh.Position(points[quad[2]]), d = surface.Mesh.Position(points[quad[3]]);
    EXPECT_NEAR((b - a).cross(c - b)[2], 1.0, 1e-12);
    EXPECT_NEAR((a + c - b - d).norm(), 0.0, 1e-12);
  }
}

TEST(IsolineArrangement, LiesOnSurfaceWhateverTheMapTurnsOver)
{
  for (const unsigned seed : { 2u, 5u, 11u, 17u, 23u })
  {
    const MappedSurface surface = FoldedPlane(seed);
    ASSERT_GT(NumberOfFaces(surface.Map, -1), 5);
    const IsolineArrangement isolines = surface.Isolines();
    const IsolineCells cells = FindCells(surface.Mesh, isolines);
    const int nodes = static_cast<int>(isolines.Nodes.size());
    DisjointSets parts(nodes);
    int darts = 0;
    for (int node = 0; node < nodes; ++node)
    {
      for (int slot = 0; slot < isolines.NumberOfSlots(node); ++slot)
      {
        const int opposite = isolines.Opposite[node][slot];
        ASSERT_GE(opposite, 0);
        EXPECT_EQ(isolines.Opposite[opposite / 4][opposite % 4], 4 * node + slot);
        parts.Unite(node, opposite / 4);
        ++darts;
      }
    }
    // Each part of the drawing is one of a sphere: nodes less arcs plus what is between them are two.
    const std::vector<int> smallest = parts.AllSmallest();
    const int numberOfParts = static_cast<int>(std::set<int>(smallest.begin(), smallest.end()).size());
    EXPECT_EQ(nodes - darts / 2 + cells.Size(), 2 * numberOfParts) << seed;
  }
}

TEST(IsolineArrangement, TellsCellsAlongEdges)
{
  const Surface shape = PlaneGrid(1, 1);
  const MappedSurface surface(shape, Plane(shape) * 3.0);
  const IsolineArrangement isolines = surface.Isolines();
  const IsolineCells cells = FindCells(surface.Mesh, isolines);
  for (int edge = 0; edge < surface.Mesh.NumberOfEdges(); ++edge)
  {
    const int h = surface.Mesh.HalfedgeOf(edge);
    EXPECT_EQ(cells.OnEdge(surface.Mesh, isolines, edge, 0.0), cells.OfVertices[surface.Mesh.Tail(h)]);
    EXPECT_EQ(cells.OnEdge(surface.Mesh, isolines, edge, 1.0), cells.OfVertices[surface.Mesh.Head(h)]);
    std::set<int> along;
    for (const double t : { 0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 })
    {
      along.insert(cells.OnEdge(surface.Mesh, isolines, edge, t));
    }
    EXPECT_EQ(along.size(), 4u) << "grid points stand in cells of their own";
  }
}

/// \param quads of vertices 0, 1, ...
IndexedQuads QuadsInside(const std::vector<std::array<int, 4>>& quads, int vertices)
{
  return { quads, std::vector<int>(quads.size(), 0), std::vector<char>(vertices, 0) };
}

TEST(CleanUp, JoinsDoublets)
{
  // A cube whose top is two quads around vertex 8.
  IndexedQuads quads = QuadsInside(
    { { 0, 3, 2, 1 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 }, { 4, 5, 6, 8 }, { 4, 8, 6, 7 } },
    9);
  CleanUp(quads, std::vector<int>(9, 0));
  EXPECT_EQ(quads.Size(), 6);
  const QuadTopology topology(quads);
  EXPECT_EQ(topology.NumberOfEdges, 12);
  EXPECT_EQ(topology.Valences[8], 0);
  EXPECT_TRUE(topology.Repeated.empty());
}

TEST(CleanUp, ClosesQuadsWithVertexTwice)
{
  // A cube whose edge from 4 to 5 is opened, with a quad that has 5 twice and a vertex 8 that no other quad has.
  IndexedQuads quads = QuadsInside(
    { { 0, 3, 2, 1 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 }, { 4, 5, 6, 7 }, { 5, 4, 5, 8 } },
    9);
  CleanUp(quads, std::vector<int>(9, 0));
  EXPECT_EQ(quads.Size(), 6);
  EXPECT_TRUE(QuadTopology(quads).TwiceInQuad.empty());
  EXPECT_TRUE(QuadTopology(quads).Repeated.empty());
}

TEST(QuadTopology, FindsWhatIsNoMesh)
{
  // Two quads with a vertex in common, but no side; and one that is there twice.
  const QuadTopology touching(QuadsInside({ { 0, 1, 2, 3 }, { 2, 4, 5, 6 } }, 7));
  EXPECT_EQ(touching.Fans[2], 2);
  EXPECT_EQ(touching.Fans[0], 1);
  EXPECT_TRUE(touching.Repeated.empty());
  const QuadTopology twice(QuadsInside({ { 0, 1, 2, 3 }, { 0, 1, 2, 3 } }, 4));
  EXPECT_EQ(twice.Repeated.size(), 4u);
}

}
