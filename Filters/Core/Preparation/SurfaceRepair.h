#ifndef dmgSurfaceRepair_h
#define dmgSurfaceRepair_h

#include "Mesh/SurfaceRelation.h"
#include "Preparation/PolygonSurface.h"
#include "Preparation/PreparationReport.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// The points that triangles use.
struct UsedPoints
{
  std::vector<int> Points; ///< by row, ascending
  std::vector<int> Rows;   ///< by point, -1 for none
};

/// Leaves out the positions of points that no triangle uses. \pre corners are in range.
UsedPoints DropUnusedPoints(CellTriangles& triangles);

/// A SurfaceRelation in the making.
struct SurfaceParts
{
  int FirstCell = 0;
  std::vector<int> CellsOfFaces;
  ElementRows FacesOfCells;
  std::vector<int> PointsOfVertices;
  ElementRows VerticesOfPoints;
};

/// The faces of each cell. \param cellsOfFaces ascending.
ElementRows RowsOf(int numberOfCells, const std::vector<int>& cellsOfFaces);

/// An oriented manifold, before its elements are checked.
struct RepairedSurface
{
  Points Positions;
  Triangles Corners;
  SurfaceParts Parts;
  PreparationReport Report;
};

/// The steps that PrepareSurface tells, from joined points to parted fans.
/// \param given without unused points.
/// \throw InvalidInput no triangle is left, or a coordinate is not finite.
RepairedSurface Repair(
  const CellTriangles& given, const UsedPoints& used, bool joinPoints, const ExecutionContext& context);

/// \throw InvalidInput always: no triangle has an area.
[[noreturn]] void RefuseSurfaceWithoutArea();

}

#endif
