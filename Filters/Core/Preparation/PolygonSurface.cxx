#include "Preparation/PolygonSurface.h"

#include "Preparation/EarClipping.h"

#include <algorithm>
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

}

CellTriangles Triangulate(PolygonSurface&& polygons, const ExecutionContext& context)
{
  constexpr int Grain = 1024;
  const int size = polygons.Size();
  const std::vector<int> first = FirstTriangles(polygons);
  CellTriangles result;
  result.FirstCell = polygons.FirstCell;
  result.NumberOfCells = polygons.Cells.empty() ? size : polygons.NumberOfCells;
  result.IsDuplicate = std::move(polygons.IsDuplicate);
  result.Corners.resize(first.back(), 3);
  result.Cells.resize(first.back());
  context.ParallelFor(0, size, Grain,
    [&](int begin, int end)
    {
      PolygonCutter cut(polygons.Positions);
      for (int p = begin; p < end; ++p)
      {
        const int* const corners = polygons.Corners.data() + polygons.Offsets[p];
        cut(corners, polygons.Offsets[p + 1] - polygons.Offsets[p], result.Corners.data() + 3 * first[p]);
        std::fill(result.Cells.begin() + first[p], result.Cells.begin() + first[p + 1],
          polygons.Cells.empty() ? p : polygons.Cells[p]);
      }
    });
  result.Positions = std::move(polygons.Positions);
  return result;
}

}
