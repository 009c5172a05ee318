#include "Preparation/VerticesOfFans.h"

#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dmg
{

namespace
{

int NextSide(int side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// Vertices in the order of their points and, at one point, of their first corner.
FanVertices NumberFans(
  int numberOfPoints, const Triangles& triangles, const SheetPairs& pairs, const ExecutionContext& context)
{
  const int sides = 3 * static_cast<int>(triangles.rows());
  DisjointSets fans(sides);
  for (int side = 0; side < sides; ++side)
  {
    if (const int beyond = pairs.Of(side); beyond > side)
    {
      fans.Unite(side, NextSide(beyond));
      fans.Unite(NextSide(side), beyond);
    }
  }
  const std::vector<int> first = fans.AllSmallest();
  const std::vector<int> firsts = Choose(
    sides, [&first](int side) { return first[side] == side; }, context);
  const int* const points = triangles.data();
  const std::vector<int> order = SortByKey(
    firsts, numberOfPoints, [points](int side) { return points[side]; }, context)
                                   .Items;
  FanVertices vertices;
  std::vector<int> numbers(sides, -1);
  for (const int side : order)
  {
    numbers[side] = static_cast<int>(vertices.Points.size());
    vertices.Points.push_back(points[side]);
  }
  vertices.Corners.resize(triangles.rows(), 3);
  for (int side = 0; side < sides; ++side)
  {
    vertices.Corners.data()[side] = numbers[first[side]];
  }
  return vertices;
}

/// Triangles that meet others at an edge of two vertices, beside the pair that goes on there.
std::set<int> Surplus(const FanVertices& vertices, const SheetPairs& pairs, const ExecutionContext& context)
{
  const int* const corners = vertices.Corners.data();
  const int numberOfVertices = static_cast<int>(vertices.Points.size());
  const ItemsByPair sides = SortByPair(
    3 * static_cast<int>(vertices.Corners.rows()), numberOfVertices,
    [corners](int side) -> std::pair<int, int> {
      return std::minmax({ corners[side], corners[NextSide(side)] });
    },
    context);
  std::set<int> surplus;
  const auto& items = sides.Items;
  for (int vertex = 0; vertex < numberOfVertices; ++vertex)
  {
    for (int first = sides.Begins[vertex], last = first; first < sides.Begins[vertex + 1]; first = last)
    {
      while (last < sides.Begins[vertex + 1] && items[last].Second == items[first].Second)
      {
        ++last;
      }
      const int side = items[first].Item;
      const bool isManifold =
        last - first == 1 || (last - first == 2 && corners[side] != corners[items[first + 1].Item]);
      for (int k = first + 1; k < last && !isManifold; ++k)
      {
        if (items[k].Item != pairs.Of(side))
        {
          surplus.insert(items[k].Item / 3);
        }
      }
    }
  }
  return surplus;
}

}

FanVertices VerticesOfFans(
  int numberOfPoints, const Triangles& triangles, SheetPairs& pairs, const ExecutionContext& context)
{
  int detached = 0;
  while (true)
  {
    FanVertices vertices = NumberFans(numberOfPoints, triangles, pairs, context);
    const std::set<int> surplus = Surplus(vertices, pairs, context);
    if (surplus.empty())
    {
      vertices.TrianglesDetached = detached;
      return vertices;
    }
    for (const int triangle : surplus)
    {
      for (int side = 3 * triangle; side < 3 * triangle + 3; ++side)
      {
        pairs.Part(side);
      }
    }
    detached += static_cast<int>(surplus.size());
  }
}

}
