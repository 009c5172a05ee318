#include "Preparation/DoubledTriangles.h"

#include "Support/CountingSort.h"

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
  for (std::size_t place = 0; place < places.size(); ++place)
  {
    for (int k = byPlaces.Begins[place]; k < byPlaces.Begins[place + 1]; ++k)
    {
      const int t = byPlaces.Items[k].Item;
      for (int i = k - 1;
           takesPart[t] && i >= byPlaces.Begins[place] && byPlaces.Items[i].Second == byPlaces.Items[k].Second; --i)
      {
        const int u = byPlaces.Items[i].Item; // before t
        if (takesPart[u] && firsts[u] == u && areSame(t, u))
        {
          firsts[t] = u;
        }
      }
    }
  }
  return firsts;
}

}
