#include "Mesh/SpatialOrder.h"

#include "Support/MeshFactory.h"
#include "Support/NamedSurfaces.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace
{

using namespace dmg;
using namespace dmg::test;

bool IsPermutation(std::vector<int> numbers, int size)
{
  std::sort(numbers.begin(), numbers.end());
  std::vector<int> all(size);
  std::iota(all.begin(), all.end(), 0);
  return numbers == all;
}

TEST(SpatialOrder, KeepsTheSurface)
{
  for (const NamedSurface& surface : SmallSurfaces())
  {
    SCOPED_TRACE(surface.Name);
    const Surface shape = Relabel(surface.Shape, 3).Result;
    const TriangleMesh mesh = shape.Mesh();
    const SpatialOrder order(shape.V, shape.F, SerialContext());
    ASSERT_TRUE(IsPermutation(order.Faces(), mesh.NumberOfFaces()));
    ASSERT_TRUE(IsPermutation(order.Vertices(), mesh.NumberOfVertices()));

    const TriangleMesh sorted = order.Apply(shape.V, shape.F, SerialContext());
    for (int v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      EXPECT_EQ(sorted.Position(v), mesh.Position(order.Vertices()[v]));
    }
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      EXPECT_EQ(order.Vertices()[sorted.Tail(h)], mesh.Tail(3 * order.Faces()[h / 3] + h % 3));
    }
    const SpatialOrder::SignedEdges edges = order.Edges(mesh, sorted);
    ASSERT_TRUE(IsPermutation(edges.Numbers, mesh.NumberOfEdges()));
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      auto [tail, head] = sorted.EdgeVertices(edge);
      if (edges.Signs[edge] < 0.0)
      {
        std::swap(tail, head);
      }
      EXPECT_EQ(order.Vertices()[tail], mesh.EdgeVertices(edges.Numbers[edge])[0]);
      EXPECT_EQ(order.Vertices()[head], mesh.EdgeVertices(edges.Numbers[edge])[1]);
      EXPECT_EQ(std::abs(edges.Signs[edge]), 1.0);
    }
  }
}

// On Morton's curve half of the steps stay in a block of two by two, three quarters in one of four by
// four; at random they would be a third of the surface long.
TEST(SpatialOrder, NeighboursHaveNearbyNumbers)
{
  const Surface shape = Relabel(Icosphere(5), 3).Result;
  const SpatialOrder order(shape.V, shape.F, SerialContext());
  const TriangleMesh sorted = order.Apply(shape.V, shape.F, SerialContext());
  std::vector<int> steps, stepsOfVertices;
  for (int edge = 0; edge < sorted.NumberOfEdges(); ++edge)
  {
    const int h = sorted.HalfedgeOf(edge);
    steps.push_back(std::abs(TriangleMesh::FaceOf(h) - TriangleMesh::FaceOf(sorted.Twin(h))));
    stepsOfVertices.push_back(std::abs(sorted.Tail(h) - sorted.Head(h)));
  }
  for (std::vector<int>* numbers : { &steps, &stepsOfVertices })
  {
    const auto median = numbers->begin() + numbers->size() / 2;
    std::nth_element(numbers->begin(), median, numbers->end());
    EXPECT_LT(*median, 32);
  }
}

TEST(SpatialOrder, IsTheSameForAnyNumberOfThreads)
{
  const Surface shape = Relabel(IrregularSphere(5, 2), 3).Result;
  const SpatialOrder order(shape.V, shape.F, SerialContext());
  const SpatialOrder byThreads(shape.V, shape.F, TbbContext(5));
  EXPECT_EQ(byThreads.Faces(), order.Faces());
  EXPECT_EQ(byThreads.Vertices(), order.Vertices());
}

TEST(SpatialOrder, HasRoomForElementsThatWillBeRefused)
{
  Surface broken = Icosphere(2);
  for (const double value : { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
         -std::numeric_limits<double>::infinity() })
  {
    for (int v : { 0, 7, 100 })
    {
      broken.V(v, v % 3) = value;
    }
    const SpatialOrder order(broken.V, broken.F, SerialContext());
    EXPECT_TRUE(IsPermutation(order.Faces(), static_cast<int>(broken.F.rows())));
    EXPECT_TRUE(IsPermutation(order.Vertices(), static_cast<int>(broken.V.rows())));
  }
  broken.V.setConstant(2.0); // all in one place
  EXPECT_TRUE(
    IsPermutation(SpatialOrder(broken.V, broken.F, SerialContext()).Faces(), static_cast<int>(broken.F.rows())));
}

}
