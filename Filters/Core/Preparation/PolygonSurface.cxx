#include "Preparation/PolygonSurface.h"

#include "Preparation/EarClipping.h"
#include "Support/CountingSort.h"
#include "Support/Errors.h"

#include <algorithm>
#include <cstdint>
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

/// Cuts polygons along other diagonals where two of them have one in common, or where it is a side of another.
class SharedDiagonals
{
public:
  /// \param first triangle of each polygon.
  SharedDiagonals(const PolygonSurface& polygons, const std::vector<int>& first, Triangles& triangles)
    : Polygons(polygons)
    , First(first)
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
    this->CountSides(0, static_cast<int>(this->Corners.rows()), 1);
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
        for (int k = first; k < last && last - first > 2; ++k)
        {
          const int triangle = sides.Items[k].Item / 3;
          const int polygon = static_cast<int>(
            std::upper_bound(this->First.begin(), this->First.end(), triangle) - this->First.begin() - 1);
          if (point != sides.Items[k].Second && !this->HasSide(polygon, point, sides.Items[k].Second))
          {
            wrong.insert(polygon);
          }
        }
      }
    }
    return wrong;
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
  Triangles& Corners;
  std::unordered_map<std::uint64_t, int> Sides; ///< of triangles, by their points: how many there are
};

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
    SharedDiagonals(polygons, first, result.Corners).Replace(context);
  }
  result.Positions = std::move(polygons.Positions);
  return result;
}

}
