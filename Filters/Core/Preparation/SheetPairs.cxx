#include "Preparation/SheetPairs.h"

#include "Preparation/SheetsAtEdge.h"
#include "Support/CountingSort.h"

#include <algorithm>
#include <utility>

namespace dmg
{

SheetPairs PairSheets(
  const Points& positions, const Triangles& triangles, const PairingOptions& options, const ExecutionContext& context)
{
  const int* const corners = triangles.data();
  const int numberOfPoints = static_cast<int>(positions.rows());
  const ItemsByPair sides = SortByPair(
    3 * static_cast<int>(triangles.rows()), numberOfPoints,
    [corners](int side) -> std::pair<int, int> {
      return std::minmax({ corners[side], corners[NextSide(side)] });
    },
    context);
  SheetPairs pairs;
  pairs.Opposite.assign(sides.Items.size(), -1);
  SheetsAtEdge sheets(positions, triangles, options);
  for (int point = 0; point < numberOfPoints; ++point)
  {
    const ItemOfPair* const end = sides.Items.data() + sides.Begins[point + 1];
    for (const ItemOfPair* first = sides.Items.data() + sides.Begins[point]; first != end;)
    {
      const ItemOfPair* const last =
        std::find_if(first, end, [first](const ItemOfPair& side) { return side.Second != first->Second; });
      if (last - first == 2)
      {
        pairs.Join(first[0].Item, first[1].Item);
      }
      else if (last - first > 2)
      {
        sheets.Pair(first, last, pairs);
        pairs.Crossed.push_back({ point, first->Second });
      }
      first = last;
    }
  }
  return pairs;
}

}
