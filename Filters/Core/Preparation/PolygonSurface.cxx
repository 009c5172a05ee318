#include "Preparation/PolygonSurface.h"

#include "Preparation/EarClipping.h"
#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

namespace dmg
{

namespace
{

int NumberOfTriangles(int corners)
{
  return corners == 0 ? 0 : std::max(1, corners - 2);
}

/// The number of triangles of all polygons before each one.
std::vector<int> FirstTriangles(const PolygonSurface& polygons)
{
  std::vector<int> first(polygons.Size() + 1, 0);
  for (int p = 0; p < polygons.Size(); ++p)
  {
    first[p + 1] = first[p] + NumberOfTriangles(polygons.Offsets[p + 1] - polygons.Offsets[p]);
  }
  return first;
}

/// \throw InvalidInput a corner is not among the points.
void CheckCorners(const PolygonSurface& polygons)
{
  const auto size = static_cast<int>(polygons.Positions.rows());
  const auto wrong = std::find_if(
    polygons.Corners.begin(), polygons.Corners.end(), [size](int point) { return point < 0 || point >= size; });
  if (wrong != polygons.Corners.end())
  {
    const auto corner = static_cast<int>(wrong - polygons.Corners.begin());
    const auto polygon = static_cast<int>(
      std::upper_bound(polygons.Offsets.begin(), polygons.Offsets.end(), corner) - polygons.Offsets.begin() - 1);
    throw InvalidInput("cell " +
      std::to_string(polygons.FirstCell + (polygons.Cells.empty() ? polygon : polygons.Cells[polygon])) +
      " uses point " + std::to_string(*wrong) + ", and the surface has " + std::to_string(size) +
      " points; repair the source of the surface");
  }
}

/// The corners of a polygon from its smallest one on, towards the smaller of both neighbours: the same for polygons with the same sides.
/// \return the corners, and whether they go the other way round.
std::pair<std::vector<int>, bool> SidesInOrder(const PolygonSurface& polygons, int p)
{
  std::vector<int> corners(
    polygons.Corners.begin() + polygons.Offsets[p], polygons.Corners.begin() + polygons.Offsets[p + 1]);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  const bool isReversed = corners.back() < corners[1];
  if (isReversed)
  {
    std::reverse(corners.begin() + 1, corners.end());
  }
  return { std::move(corners), isReversed };
}

/// For each polygon of more than three corners the first one with the same sides, or itself.
std::vector<int> FirstWithSameSides(const PolygonSurface& polygons, const ExecutionContext& context)
{
  const auto isLarge = [&polygons](int p) { return polygons.Offsets[p + 1] - polygons.Offsets[p] > 3; };
  std::vector<int> firsts = Identity(polygons.Size());
  const std::vector<int> large = Choose(polygons.Size(), isLarge, context);
  const int numberOfPoints = static_cast<int>(polygons.Positions.rows());
  const ItemsByPair byCorners = SortByPair(
    static_cast<int>(large.size()), numberOfPoints,
    [&](int k) -> std::pair<int, int>
    {
      const int* const begin = polygons.Corners.data();
      const auto [least, largest] =
        std::minmax_element(begin + polygons.Offsets[large[k]], begin + polygons.Offsets[large[k] + 1]);
      return { *least, *largest };
    },
    context);
  for (int point = 0; point < numberOfPoints; ++point)
  {
    for (int k = byCorners.Begins[point], end = k; k < byCorners.Begins[point + 1]; k = end)
    {
      std::map<std::vector<int>, int> known;
      for (; end < byCorners.Begins[point + 1] && byCorners.Items[end].Second == byCorners.Items[k].Second; ++end)
      {
        const int p = large[byCorners.Items[end].Item];
        const bool isAlone = end == k &&
          (end + 1 == byCorners.Begins[point + 1] || byCorners.Items[end + 1].Second != byCorners.Items[k].Second);
        firsts[p] = isAlone ? p : known.emplace(SidesInOrder(polygons, p).first, p).first->second;
      }
    }
  }
  return firsts;
}

/// Cuts polygons along other diagonals where two of them have one in common, or where it is a side of another.
class SharedDiagonals
{
public:
  /// \param first triangle of each polygon.
  /// \param same for each polygon the first one with the same sides; the others take no part.
  SharedDiagonals(
    const PolygonSurface& polygons, const std::vector<int>& first, const std::vector<int>& same, Triangles& triangles)
    : Polygons(polygons)
    , First(first)
    , Same(same)
    , Corners(triangles)
  {
  }

  void Replace(const ExecutionContext& context)
  {
    const std::set<int> wrong = this->Find(context);
    if (wrong.empty())
    {
      return;
    }
    for (int p = 0; p < this->Polygons.Size(); ++p)
    {
      this->CountSides(this->First[p], this->Same[p] == p ? this->First[p + 1] : this->First[p], 1);
    }
    PolygonCutter cut(this->Polygons.Positions, &context);
    cut.Avoid(
      [this](int a, int b)
      {
        const auto found = this->Sides.find(Key(a, b));
        return found != this->Sides.end() && found->second > 0;
      });
    for (const int polygon : wrong)
    {
      const int begin = this->Polygons.Offsets[polygon];
      this->CountSides(this->First[polygon], this->First[polygon + 1], -1);
      cut(this->Polygons.Corners.data() + begin, this->Polygons.Offsets[polygon + 1] - begin,
        this->Corners.data() + 3 * this->First[polygon]);
      this->CountSides(this->First[polygon], this->First[polygon + 1], 1);
    }
  }

private:
  static std::uint64_t Key(int a, int b)
  {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  }

  /// The points of a side of a triangle.
  std::pair<int, int> EndsOf(int side) const
  {
    return std::minmax({ this->Corners.data()[side], this->Corners.data()[side % 3 == 2 ? side - 2 : side + 1] });
  }

  void CountSides(int firstTriangle, int lastTriangle, int step)
  {
    for (int side = 3 * firstTriangle; side < 3 * lastTriangle; ++side)
    {
      const auto [a, b] = this->EndsOf(side);
      this->Sides[Key(a, b)] += step;
    }
  }

  /// Polygons with a diagonal between points that other polygons join, too.
  std::set<int> Find(const ExecutionContext& context) const
  {
    std::set<int> wrong;
    const int numberOfPoints = static_cast<int>(this->Polygons.Positions.rows());
    const ItemsByPair sides = SortByPair(
      static_cast<int>(this->Corners.size()), numberOfPoints, [this](int side) { return this->EndsOf(side); }, context);
    for (int point = 0; point < numberOfPoints; ++point)
    {
      const int end = sides.Begins[point + 1];
      for (int first = sides.Begins[point], last = first; first < end; first = last)
      {
        while (last < end && sides.Items[last].Second == sides.Items[first].Second)
        {
          ++last;
        }
        int number = 0;
        for (int k = first; k < last && last - first > 2; ++k)
        {
          const int polygon = this->PolygonOf(sides.Items[k].Item / 3);
          number += this->Same[polygon] == polygon;
        }
        for (int k = first; k < last && number > 2; ++k)
        {
          const int polygon = this->PolygonOf(sides.Items[k].Item / 3);
          if (this->Same[polygon] == polygon && point != sides.Items[k].Second &&
            !this->HasSide(polygon, point, sides.Items[k].Second))
          {
            wrong.insert(polygon);
          }
        }
      }
    }
    return wrong;
  }

  int PolygonOf(int triangle) const
  {
    return static_cast<int>(
      std::upper_bound(this->First.begin(), this->First.end(), triangle) - this->First.begin() - 1);
  }

  bool HasSide(int polygon, int a, int b) const
  {
    const int begin = this->Polygons.Offsets[polygon], end = this->Polygons.Offsets[polygon + 1];
    int last = this->Polygons.Corners[end - 1];
    for (int k = begin; k < end; last = this->Polygons.Corners[k++])
    {
      const int corner = this->Polygons.Corners[k];
      if ((last == a && corner == b) || (last == b && corner == a))
      {
        return true;
      }
    }
    return false;
  }

  const PolygonSurface& Polygons;
  const std::vector<int>& First;
  const std::vector<int>& Same;
  Triangles& Corners;
  std::unordered_map<std::uint64_t, int> Sides; ///< of triangles, by their points: how many there are
};

/// Gives polygons the triangles of the first one with the same sides, so that twins are seen as such.
void CutAlike(
  const PolygonSurface& polygons, const std::vector<int>& first, const std::vector<int>& same, Triangles& triangles)
{
  for (int p = 0; p < polygons.Size(); ++p)
  {
    if (same[p] == p)
    {
      continue;
    }
    const bool isOpposite = SidesInOrder(polygons, p).second != SidesInOrder(polygons, same[p]).second;
    for (int k = 0; k < first[p + 1] - first[p]; ++k)
    {
      const Triangles::RowXpr from = triangles.row(first[same[p]] + k);
      triangles.row(first[p] + k) << from[0], from[isOpposite ? 2 : 1], from[isOpposite ? 1 : 2];
    }
  }
}

}

CellTriangles Triangulate(PolygonSurface&& polygons, const ExecutionContext& context)
{
  constexpr int Grain = 1024;
  constexpr int LargeSize = 1000; // of polygons that take so long that they are cut between checkpoints
  CheckCorners(polygons);
  const int size = polygons.Size();
  const std::vector<int> first = FirstTriangles(polygons);
  CellTriangles result;
  result.FirstCell = polygons.FirstCell;
  result.NumberOfCells = polygons.Cells.empty() ? size : polygons.NumberOfCells;
  result.IsDuplicate = std::move(polygons.IsDuplicate);
  result.Corners.resize(first.back(), 3);
  result.Cells.resize(first.back());
  const auto sizeOf = [&polygons](int p) { return polygons.Offsets[p + 1] - polygons.Offsets[p]; };
  const auto cutOne = [&](PolygonCutter& cut, int p)
  { cut(polygons.Corners.data() + polygons.Offsets[p], sizeOf(p), result.Corners.data() + 3 * first[p]); };
  context.ParallelFor(0, size, Grain,
    [&](int begin, int end)
    {
      PolygonCutter cut(polygons.Positions);
      for (int p = begin; p < end; ++p)
      {
        if (sizeOf(p) < LargeSize)
        {
          cutOne(cut, p);
        }
        std::fill(result.Cells.begin() + first[p], result.Cells.begin() + first[p + 1],
          polygons.Cells.empty() ? p : polygons.Cells[p]);
      }
    });
  PolygonCutter cut(polygons.Positions, &context);
  for (int p = 0; p < size; ++p)
  {
    if (sizeOf(p) >= LargeSize)
    {
      cutOne(cut, p);
    }
  }
  if (first.back() > size || polygons.Corners.size() > 3 * static_cast<std::size_t>(size)) // else all are triangles
  {
    const std::vector<int> same = FirstWithSameSides(polygons, context);
    SharedDiagonals(polygons, first, same, result.Corners).Replace(context);
    CutAlike(polygons, first, same, result.Corners);
  }
  result.Positions = std::move(polygons.Positions);
  return result;
}

}
