#include "Adapters/Data/CellChecks.h"

#include "Support/Errors.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

std::string Cell(vtkIdType id)
{
  return "cell " + std::to_string(id);
}

class CellChecker
{
public:
  CellChecker(vtkDataSet* dataset, const std::string& whose)
    : Data(dataset)
    , Whose(whose)
    , NumberOfPoints(dataset->GetNumberOfPoints())
  {
  }

  void Run()
  {
    if (auto* const polyData = vtkPolyData::SafeDownCast(this->Data))
    {
      this->CheckPolyData(polyData);
    }
    else if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(this->Data))
    {
      this->CheckUnstructuredGrid(grid);
    }
    else
    {
      this->CheckGrid();
    }
  }

private:
  void CheckPolyData(vtkPolyData* polyData) const
  {
    vtkIdType first = 0;
    for (vtkCellArray* const cells :
      { polyData->GetVerts(), polyData->GetLines(), polyData->GetPolys(), polyData->GetStrips() })
    {
      this->CheckIds(cells, first);
      first += cells->GetNumberOfCells();
    }
  }

  void CheckUnstructuredGrid(vtkUnstructuredGrid* grid) const
  {
    this->CheckIds(grid->GetCells(), 0);
    vtkUnsignedCharArray* const types = grid->GetCellTypesArray();
    if (grid->GetNumberOfCells() > 0 && (!types || types->GetNumberOfTuples() < grid->GetNumberOfCells()))
    {
      this->RefuseSize("types", types ? types->GetNumberOfTuples() : 0, grid->GetNumberOfCells(), "cells");
    }
    this->CheckSizes(grid, types);
  }

  void CheckGrid() const
  {
    if (auto* const structured = vtkStructuredGrid::SafeDownCast(this->Data))
    {
      int size[3];
      structured->GetDimensions(size);
      const vtkIdType needed = static_cast<vtkIdType>(size[0]) * size[1] * size[2];
      if (structured->GetNumberOfCells() > 0 && this->NumberOfPoints < needed)
      {
        this->RefuseSize("points", this->NumberOfPoints, needed, "places");
      }
    }
    else if (auto* const rectilinear = vtkRectilinearGrid::SafeDownCast(this->Data))
    {
      vtkDataArray* const along[] = { rectilinear->GetXCoordinates(), rectilinear->GetYCoordinates(),
        rectilinear->GetZCoordinates() };
      for (int axis = 0; axis < 3; ++axis)
      {
        if (along[axis] && along[axis]->GetNumberOfTuples() < rectilinear->GetDimensions()[axis])
        {
          this->RefuseSize("coordinates along an axis", along[axis]->GetNumberOfTuples(),
            rectilinear->GetDimensions()[axis], "places");
        }
      }
    }
    else if (auto* const explicitGrid = vtkExplicitStructuredGrid::SafeDownCast(this->Data))
    {
      this->CheckIds(explicitGrid->GetCells(), 0);
    }
  }

  void CheckIds(vtkCellArray* cells, vtkIdType firstCell) const
  {
    if (!cells || cells->GetNumberOfCells() == 0)
    {
      return;
    }
    vtkDataArray* const points = cells->GetConnectivityArray();
    if (auto* const longs = vtkAOSDataArrayTemplate<vtkTypeInt64>::FastDownCast(points))
    {
      this->CheckIds(cells, firstCell, [ids = longs->GetPointer(0)](vtkIdType k) { return ids[k]; });
    }
    else if (auto* const ints = vtkAOSDataArrayTemplate<vtkTypeInt32>::FastDownCast(points))
    {
      this->CheckIds(cells, firstCell, [ids = ints->GetPointer(0)](vtkIdType k) { return ids[k]; });
    }
    else // other memory layouts
    {
      this->CheckIds(
        cells, firstCell, [points](vtkIdType k) { return static_cast<vtkIdType>(points->GetComponent(k, 0)); });
    }
  }

  /// \param pointAt of the list of all points of cells.
  template <class PointAt>
  void CheckIds(vtkCellArray* cells, vtkIdType firstCell, const PointAt& pointAt) const
  {
    const vtkIdType size = cells->GetConnectivityArray()->GetNumberOfValues();
    vtkDataArray* const offsets = cells->GetOffsetsArray(); // VTK 9.1 has no GetOffset
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      const auto begin = static_cast<vtkIdType>(offsets->GetComponent(cell, 0));
      const auto end = static_cast<vtkIdType>(offsets->GetComponent(cell + 1, 0));
      if (begin < 0 || end < begin || end > size)
      {
        throw InvalidInput(Cell(firstCell + cell) + " has points " + std::to_string(begin) + " to " +
          std::to_string(end) + " of a list of " + std::to_string(size) + " in " + this->Whose +
          "; repair the source of " + this->Whose);
      }
      for (vtkIdType k = begin; k < end; ++k)
      {
        const vtkIdType point = pointAt(k);
        if (point < 0 || point >= this->NumberOfPoints)
        {
          throw InvalidInput(Cell(firstCell + cell) + " uses point " + std::to_string(point) + ", and " + this->Whose +
            " has " + std::to_string(this->NumberOfPoints) + " points; repair the source of " + this->Whose);
        }
      }
    }
  }

  void CheckSizes(vtkUnstructuredGrid* grid, vtkUnsignedCharArray* types) const
  {
    std::array<vtkIdType, 256> least;
    least.fill(-1);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      const int type = types->GetValue(cell);
      if (least[type] < 0)
      {
        least[type] = LeastSize(type);
      }
      if (least[type] > 0)
      {
        const vtkIdType size = grid->GetCells()->GetCellSize(cell);
        const vtkIdType needed = std::max(least[type], this->SizeOfOrder(type, cell, size));
        if (size < needed)
        {
          throw InvalidInput(Cell(cell) + " of " + this->Whose + " has " + std::to_string(size) +
            " points, and its type needs " + std::to_string(needed) + "; repair the source of " + this->Whose);
        }
      }
    }
  }

  /// The points that VTK reads of any cell of a type. Where a type has two dimensions and no higher order, cells of fewer points
  /// are polygons.
  static vtkIdType LeastSize(int type)
  {
    if (type == VTK_TRIANGLE || type == VTK_QUAD)
    {
      return 0;
    }
    vtkNew<vtkGenericCell> cell;
    cell->SetCellType(type);
    return cell->GetCellDimension() == 2 ? cell->GetNumberOfPoints() : 0;
  }

  /// The number of points of a quadrilateral: that of the orders in the cell data, where these have any, else its own.
  vtkIdType SizeOfOrder(int type, vtkIdType cell, vtkIdType size) const
  {
    if (type != VTK_LAGRANGE_QUADRILATERAL && type != VTK_BEZIER_QUADRILATERAL)
    {
      return 0;
    }
    vtkDataArray* const degrees = this->Data->GetCellData()->GetHigherOrderDegrees();
    if (degrees && degrees->GetNumberOfComponents() >= 2 && degrees->GetNumberOfTuples() > cell)
    {
      return static_cast<vtkIdType>((degrees->GetComponent(cell, 0) + 1) * (degrees->GetComponent(cell, 1) + 1));
    }
    const auto side = static_cast<vtkIdType>(std::lround(std::sqrt(static_cast<double>(size))));
    return side * side;
  }

  [[noreturn]] void RefuseSize(const std::string& what, vtkIdType size, vtkIdType needed, const std::string& of) const
  {
    throw InvalidInput(this->Whose + " has " + std::to_string(size) + " " + what + " for " + std::to_string(needed) +
      " " + of + "; repair the source of " + this->Whose);
  }

  vtkDataSet* const Data;
  const std::string& Whose;
  const vtkIdType NumberOfPoints;
};

}

void CheckCells(vtkDataSet* dataset, const std::string& whose)
{
  CellChecker(dataset, whose).Run();
}

}
