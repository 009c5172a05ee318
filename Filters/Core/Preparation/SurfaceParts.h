#ifndef dmgSurfaceParts_h
#define dmgSurfaceParts_h

#include "Mesh/SurfaceRelation.h"
#include "Preparation/PolygonSurface.h"

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

}

#endif
