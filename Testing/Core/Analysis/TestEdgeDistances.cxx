#include "Analysis/EdgeDistances.h"

#include "Operators/FunctionSource.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Two grids that do not touch, of 6 x 3 and 4 x 4 unit squares, each cut along its rising diagonal.
TriangleMesh TwoGrids()
{
  return Union(PlaneGrid(6, 3), PlaneGrid(4, 4), Vector3(100.0, 0.0, 0.0)).Mesh();
}

constexpr int VerticesOfFirst = 7 * 4;

}

TEST(EdgeDistances, EndAtTheMaximum)
{
  const TriangleMesh mesh = TwoGrids();
  const Vector<double> all = DistancesAlongEdges(mesh, { 3 });
  const Vector<double> near = DistancesAlongEdges(mesh, { 3 }, 2.5);
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    EXPECT_TRUE(all[vertex] <= 2.5 ? near[vertex] == all[vertex] : std::isinf(near[vertex])) << vertex;
  }
}

TEST(EdgeDistances, AreTheLargestFunctionBelowStartsOfSlopeOne)
{
  const TriangleMesh mesh = TwoGrids();
  Vector<double> starts = Vector<double>::Constant(mesh.NumberOfVertices(), 3.0);
  starts[3] = 1.0;
  const Vector<double> distances = DistancesAlongEdges(mesh, starts), from = DistancesAlongEdges(mesh, { 3 });
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    EXPECT_NEAR(distances[vertex], std::min(3.0, 1.0 + from[vertex]), 1e-12);
  }
}

TEST(EdgeDistances, TakeDiagonalsWhereTheyRise)
{
  const TriangleMesh mesh = TwoGrids();
  int corner = 0;
  for (int vertex = 0; vertex < VerticesOfFirst; ++vertex)
  {
    corner = mesh.Position(vertex).norm() == 0.0 ? vertex : corner;
  }
  const Vector<double> distances = DistancesAlongEdges(mesh, { corner });
  for (int vertex = 0; vertex < VerticesOfFirst; ++vertex)
  {
    const double x = mesh.Position(vertex).x();
    const double y = mesh.Position(vertex).y();
    EXPECT_NEAR(distances[vertex], std::sqrt(2.0) * std::min(x, y) + std::abs(x - y), 1e-12);
  }
  for (int vertex = VerticesOfFirst; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    EXPECT_TRUE(std::isinf(distances[vertex]));
  }
}

TEST(EdgeDistances, DiametersAreAtLeastHalfOfTheLongestDistance)
{
  const TriangleMesh mesh = TwoGrids();
  const std::vector<double> diameters = ComponentDiameters(mesh, VertexComponents(mesh));
  ASSERT_EQ(diameters.size(), 2u);
  // From the upper left to the lower right, diagonals do not help.
  const double longest[] = { 9.0, 8.0 };
  for (int component = 0; component < 2; ++component)
  {
    EXPECT_LE(diameters[component], longest[component]);
    EXPECT_GE(diameters[component], 0.5 * longest[component]);
  }
}
