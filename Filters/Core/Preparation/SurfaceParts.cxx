#include "Preparation/SurfaceParts.h"

#include <algorithm>

namespace dmg
{

UsedPoints DropUnusedPoints(CellTriangles& triangles)
{
  UsedPoints used;
  used.Rows.assign(triangles.Positions.rows(), -1);
  for (int i = 0; i < static_cast<int>(triangles.Corners.size()); ++i)
  {
    used.Rows[triangles.Corners.data()[i]] = 0;
  }
  for (int point = 0; point < static_cast<int>(used.Rows.size()); ++point)
  {
    if (used.Rows[point] == 0)
    {
      used.Rows[point] = static_cast<int>(used.Points.size());
      used.Points.push_back(point);
    }
  }
  const int size = static_cast<int>(used.Points.size());
  if (size == triangles.Positions.rows())
  {
    return used;
  }
  for (int i = 0; i < static_cast<int>(triangles.Corners.size()); ++i)
  {
    triangles.Corners.data()[i] = used.Rows[triangles.Corners.data()[i]];
  }
  for (int row = 0; row < size; ++row)
  {
    triangles.Positions.row(row) = triangles.Positions.row(used.Points[row]).eval();
  }
  triangles.Positions.conservativeResize(size, 3);
  return used;
}

ElementRows RowsOf(int numberOfCells, const std::vector<int>& cellsOfFaces)
{
  ElementRows rows;
  const int size = static_cast<int>(cellsOfFaces.size());
  const bool isSingle = std::adjacent_find(cellsOfFaces.begin(), cellsOfFaces.end()) == cellsOfFaces.end();
  if (isSingle)
  {
    rows.Items.assign(numberOfCells, -1);
    for (int face = 0; face < size; ++face)
    {
      rows.Items[cellsOfFaces[face]] = face;
    }
    return rows;
  }
  rows.Offsets.assign(numberOfCells + 1, 0);
  rows.Items.resize(size);
  for (int face = 0; face < size; ++face)
  {
    ++rows.Offsets[cellsOfFaces[face] + 1];
    rows.Items[face] = face;
  }
  for (int cell = 0; cell < numberOfCells; ++cell)
  {
    rows.Offsets[cell + 1] += rows.Offsets[cell];
  }
  return rows;
}

}
