#include "Preparation/VerticesOfFans.h"

#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"

#include <utility>
#include <vector>

namespace dmg
{

namespace
{

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

/// Two sides that run alike between the same two vertices.
using SidesAlike = std::pair<int, int>;

/// Pairs of such sides, at most one at each vertex.
std::vector<SidesAlike> FindSidesAlike(const FanVertices& vertices, const ExecutionContext& context)
{
  const int* const corners = vertices.Corners.data();
  const ItemsByPair sides = SortByPair(
    3 * static_cast<int>(vertices.Corners.rows()), static_cast<int>(vertices.Points.size()),
    [corners](int side) -> std::pair<int, int> {
      return { corners[side], corners[NextSide(side)] };
    },
    context);
  std::vector<SidesAlike> alike;
  std::vector<char> isTaken(vertices.Points.size(), 0);
  for (std::size_t vertex = 0; vertex < vertices.Points.size(); ++vertex)
  {
    for (int k = sides.Begins[vertex] + 1; k < sides.Begins[vertex + 1]; ++k)
    {
      const int other = sides.Items[k].Second;
      if (sides.Items[k - 1].Second == other && !isTaken[vertex] && !isTaken[other])
      {
        alike.emplace_back(sides.Items[k - 1].Item, sides.Items[k].Item);
        isTaken[vertex] = isTaken[other] = 1;
      }
    }
  }
  return alike;
}

}

FanVertices VerticesOfFans(
  int numberOfPoints, const Triangles& triangles, SheetPairs& pairs, const ExecutionContext& context)
{
  while (true)
  {
    FanVertices vertices = NumberFans(numberOfPoints, triangles, pairs, context);
    const std::vector<SidesAlike> alike = FindSidesAlike(vertices, context);
    if (alike.empty())
    {
      return vertices;
    }
    for (const auto& [a, b] : alike)
    {
      const int beyondA = pairs.Of(a), beyondB = pairs.Of(b);
      pairs.Join(a, beyondB);
      pairs.Join(b, beyondA);
    }
    context.Checkpoint(0.0);
  }
}

}
