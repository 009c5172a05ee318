#include "Preparation/PartsWithoutArea.h"

#include "Support/DisjointSets.h"

#include <algorithm>

namespace dmg
{

namespace
{

Vector3 SideOf(const Points& positions, const Triangles& triangles, int triangle, int k)
{
  return positions.row(triangles(triangle, (k + 1) % 3)) - positions.row(triangles(triangle, k % 3));
}

bool IsFlat(const Points& positions, const Triangles& triangles, int triangle)
{
  constexpr double Rounding = 1e-12; // of a product of sides in double precision
  const int longest = LongestSide(positions, triangles, triangle);
  const Vector3 side = SideOf(positions, triangles, triangle, longest);
  const double length = side.stableNorm();
  return (side / length).cross(SideOf(positions, triangles, triangle, longest + 1)).stableNorm() <= Rounding * length;
}

}

int LongestSide(const Points& positions, const Triangles& triangles, int triangle)
{
  int longest = 0;
  double length = -1.0;
  for (int k = 0; k < 3; ++k)
  {
    const double other = SideOf(positions, triangles, triangle, k).stableNorm();
    if (other > length)
    {
      longest = k;
      length = other;
    }
  }
  return longest;
}

std::vector<char> InPartsWithoutArea(
  const Points& positions, const Triangles& triangles, const std::function<int(int side)>& opposite)
{
  const int size = static_cast<int>(triangles.rows());
  std::vector<char> isFlat(size);
  for (int t = 0; t < size; ++t)
  {
    isFlat[t] = IsFlat(positions, triangles, t);
  }
  if (std::find(isFlat.begin(), isFlat.end(), 1) == isFlat.end())
  {
    return {};
  }
  DisjointSets sets(size);
  for (int side = 0; side < 3 * size; ++side)
  {
    if (opposite(side) >= 0)
    {
      sets.Unite(side / 3, opposite(side) / 3);
    }
  }
  const std::vector<int> partOf = sets.AllSmallest();
  std::vector<char> hasArea(size, 0), inPart(size);
  for (int t = 0; t < size; ++t)
  {
    hasArea[partOf[t]] |= isFlat[t] == 0;
  }
  for (int t = 0; t < size; ++t)
  {
    inPart[t] = hasArea[partOf[t]] == 0;
  }
  return std::find(inPart.begin(), inPart.end(), 1) == inPart.end() ? std::vector<char>() : inPart;
}

}
