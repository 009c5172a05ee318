#ifndef dmgPolygonSurface_h
#define dmgPolygonSurface_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Triangles as parts of somebody's cells. Nothing is said of how they meet.
struct CellTriangles
{
  Points Positions;
  Triangles Corners;             ///< rows of Positions
  int FirstCell = 0;             ///< number of the first cell that may have triangles
  int NumberOfCells = 0;         ///< from the first one on
  std::vector<int> Cells;        ///< of each triangle, ascending, counted from FirstCell; empty: triangle t is cell t
  std::vector<char> IsDuplicate; ///< by cell: left out, as its twin is there as well; empty: none is

  int CellOf(int triangle) const { return this->Cells.empty() ? triangle : this->Cells[triangle]; }
  bool IsLeftOut(int triangle) const
  {
    return !this->IsDuplicate.empty() && this->IsDuplicate[this->CellOf(triangle)] != 0;
  }
};

/// Polygons of any number of corners. Polygon p has Corners[Offsets[p]] to Corners[Offsets[p + 1] - 1].
struct PolygonSurface
{
  Points Positions;
  std::vector<int> Offsets = { 0 };
  std::vector<int> Corners;      ///< rows of Positions
  int FirstCell = 0;             ///< number of the first cell that may have polygons
  int NumberOfCells = 0;         ///< from the first one on; unused where Cells is empty
  std::vector<int> Cells;        ///< of each polygon, ascending, counted from FirstCell; empty: polygon p is cell p
  std::vector<char> IsDuplicate; ///< as in CellTriangles

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
};

/// Cuts polygons into triangles, without new points. A polygon of n corners has n - 2 triangles, whether it is convex or
/// not, plane or not; one of one or two corners has a triangle without area, and one of none has nothing.
///
/// A quad is cut along the diagonal that leaves the better shaped worse triangle. Larger polygons are projected along
/// their mean normal, and lose their best shaped ear until three corners are left (Meisters 1975). Polygons that cross
/// themselves are cut, too, into triangles that overlap. Which corner a polygon begins with makes no difference. A diagonal
/// that is a side or a diagonal of another polygon is replaced, in the order of the polygons, where there is another
/// one: else four triangles would meet there. Polygons with the same sides, in either direction, are cut alike.
/// \throw InvalidInput a corner is out of range; the message names the cell.
/// \throw Cancelled
/// Cost: linear in the number of polygons; about n log n in the number of corners of one, as far as its triangles are small.
CellTriangles Triangulate(PolygonSurface&& polygons, const ExecutionContext& context = SerialContext());

}

#endif
