#include "Preparation/DoubledTriangles.h"

#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dmg
{

namespace
{

using Triple = std::array<int, 3>;

Triple Sorted(Triple corners)
{
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The same cyclic order, beginning with the smallest.
Triple Turned(Triple corners)
{
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

}

std::vector<int> FirstOfDoubled(const Triangles& triangles, const std::vector<int>& places,
  const std::vector<char>& takesPart, const ExecutionContext& context)
{
  const auto cornersOf = [&triangles](int t) -> Triple {
    return { triangles(t, 0), triangles(t, 1), triangles(t, 2) };
  };
  const auto placesOf = [&](int t) -> Triple {
    return { places[triangles(t, 0)], places[triangles(t, 1)], places[triangles(t, 2)] };
  };
  const auto areSame = [&](int t, int u)
  { return Sorted(cornersOf(t)) == Sorted(cornersOf(u)) || Turned(placesOf(t)) == Turned(placesOf(u)); };
  const int size = static_cast<int>(triangles.rows());
  const ItemsByPair byPlaces = SortByPair(
    size, static_cast<int>(places.size()),
    [&](int t) -> std::pair<int, int>
    {
      const Triple sorted = Sorted(placesOf(t));
      return { sorted[0], sorted[1] };
    },
    context);
  std::vector<int> firsts = Identity(size);
  std::vector<std::pair<int, int>>
    group; // (largest place, triangle) of triangles that have the other two places in common
  for (std::size_t place = 0; place < places.size(); ++place)
  {
    for (int k = byPlaces.Begins[place], end = k; k < byPlaces.Begins[place + 1]; k = end)
    {
      group.clear();
      for (; end < byPlaces.Begins[place + 1] && byPlaces.Items[end].Second == byPlaces.Items[k].Second; ++end)
      {
        const int t = byPlaces.Items[end].Item;
        if (takesPart[t])
        {
          group.emplace_back(Sorted(placesOf(t))[2], t);
        }
      }
      std::sort(group.begin(), group.end());
      std::vector<int> different; // of the triangles at one place
      for (std::size_t i = 0; i < group.size(); ++i)
      {
        const int t = group[i].second;
        if (i > 0 && group[i].first != group[i - 1].first)
        {
          different.clear();
        }
        const auto first = std::find_if(different.begin(), different.end(), [&](int u) { return areSame(t, u); });
        if (first != different.end())
        {
          firsts[t] = *first;
        }
        else
        {
          different.push_back(t);
        }
      }
    }
  }
  return firsts;
}

namespace
{

/// For each triangle the one that is its only double and has its corners in opposite order; -1 for none.
std::vector<int> OppositeTwins(
  const Triangles& triangles, const std::vector<char>& takesPart, const std::vector<int>& firsts)
{
  const int size = static_cast<int>(triangles.rows());
  std::vector<int> twins(size, -1), doubles(size, 0);
  for (int t = 0; t < size; ++t)
  {
    const int u = firsts[t];
    doubles[u] += u != t;
    const Triple corners{ triangles(t, 0), triangles(t, 1), triangles(t, 2) };
    const Triple others{ triangles(u, 0), triangles(u, 1), triangles(u, 2) };
    if (u != t && takesPart[t] && takesPart[u] && Sorted(corners) == Sorted(others) &&
      Turned(corners) != Turned(others))
    {
      twins[u] = t;
    }
  }
  for (int u = 0; u < size; ++u)
  {
    twins[u] = doubles[u] == 1 ? twins[u] : -1;
  }
  return twins;
}

/// For each triangle whether it has a twin and lies in a patch of such triangles between solids.
/// \param alone triangles, none of which is another's double; \param sides theirs, 3 each, by their points.
std::vector<char> LieBetweenSolids(
  const std::vector<int>& alone, const std::vector<int>& twins, const ItemsByPair& sides, int numberOfPoints)
{
  const int size = static_cast<int>(twins.size());
  DisjointSets patches(size);
  std::vector<int> between; // triangles of patches that lie between solids
  for (int point = 0; point < numberOfPoints; ++point)
  {
    for (int first = sides.Begins[point], last = first; first < sides.Begins[point + 1]; first = last)
    {
      std::vector<int> ofPatches;
      for (; last < sides.Begins[point + 1] && sides.Items[last].Second == sides.Items[first].Second; ++last)
      {
        if (const int t = alone[sides.Items[last].Item / 3]; twins[t] >= 0)
        {
          ofPatches.push_back(t);
        }
      }
      const int others = last - first - static_cast<int>(ofPatches.size());
      for (const int t : ofPatches)
      {
        if (others == 0)
        {
          patches.Unite(t, ofPatches[0]);
        }
        else if (others % 2 == 0)
        {
          between.push_back(t);
        }
      }
    }
  }
  std::vector<char> isBetween(size, 0);
  for (const int t : between)
  {
    isBetween[patches.Smallest(t)] = 1;
  }
  std::vector<char> result(size, 0);
  for (int t = 0; t < size; ++t)
  {
    result[t] = twins[t] >= 0 && isBetween[patches.Smallest(t)];
  }
  return result;
}

}

void KeepTwinsOfSolids(const Triangles& triangles, const std::vector<char>& takesPart, std::vector<int>& firsts,
  const ExecutionContext& context)
{
  const std::vector<int> twins = OppositeTwins(triangles, takesPart, firsts);
  if (std::all_of(twins.begin(), twins.end(), [](int twin) { return twin < 0; }))
  {
    return;
  }
  const int size = static_cast<int>(triangles.rows());
  const std::vector<int> alone = Choose(
    size, [&](int t) { return takesPart[t] && firsts[t] == t; }, context);
  const int numberOfPoints = triangles.maxCoeff() + 1;
  const ItemsByPair sides = SortByPair(
    3 * static_cast<int>(alone.size()), numberOfPoints,
    [&](int side) -> std::pair<int, int>
    {
      const int t = alone[side / 3], k = side % 3;
      return std::minmax({ triangles(t, k), triangles(t, (k + 1) % 3) });
    },
    context);
  const std::vector<char> isBetween = LieBetweenSolids(alone, twins, sides, numberOfPoints);
  for (int t = 0; t < size; ++t)
  {
    if (isBetween[t])
    {
      firsts[twins[t]] = twins[t];
    }
  }
}

}
