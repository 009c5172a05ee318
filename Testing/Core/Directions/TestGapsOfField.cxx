#include "Directions/GapsOfField.h"

#include "Mesh/TangentFrames.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// One direction in space on all faces but some.
Vector<Complex> Parallel(const FramedMesh& surface, const std::vector<int>& without)
{
  Vector<Complex> first(surface.Mesh.NumberOfFaces());
  for (int face = 0; face < first.size(); ++face)
  {
    first[face] = surface.Faces.ToComplex(face, Vector3(0.8, 0.6, 0.0));
  }
  for (const int face : without)
  {
    first[face] = 0.0;
  }
  return first;
}

}

TEST(GapsOfField, OfOneCellHasTheDirectionBesideIt)
{
  const FramedMesh surface(PlaneGrid(6, 6).Mesh());
  const SurfaceRelation relation = SurfaceRelation::OneToOne(surface.Mesh);
  Vector<Complex> first = Parallel(surface, { 30 });
  EXPECT_EQ(CellsWithoutDirection(relation, first, first.size())[30], 1);
  FillLoneCells(surface, relation, first);
  EXPECT_LT((first - Parallel(surface, {})).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(GapsOfField, OfSeveralCellsStays)
{
  const FramedMesh surface(PlaneGrid(6, 6).Mesh());
  const SurfaceRelation relation = SurfaceRelation::OneToOne(surface.Mesh);
  int neighbour = -1;
  surface.Mesh.VisitNeighbours(30, [&neighbour](int face) { neighbour = face; });
  Vector<Complex> first = Parallel(surface, { 30, neighbour });
  FillLoneCells(surface, relation, first);
  const std::vector<char> isWithout = CellsWithoutDirection(relation, first, first.size());
  EXPECT_EQ(std::count(isWithout.begin(), isWithout.end(), 1), 2);
  EXPECT_TRUE(isWithout[30] && isWithout[neighbour]);
}
