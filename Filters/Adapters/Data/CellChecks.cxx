#include "Adapters/Data/CellChecks.h"

#include "Adapters/Data/SkinOfVolume.h"
#include "Support/Errors.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

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
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0) // one value may stand for all
    vtkDataArray* const types = grid->GetCellTypes();
#else
    vtkDataArray* const types = grid->GetCellTypesArray();
#endif
    if (grid->GetNumberOfCells() > 0 && (!types || types->GetNumberOfTuples() < grid->GetNumberOfCells()))
    {
      this->RefuseSize("types", types ? types->GetNumberOfTuples() : 0, grid->GetNumberOfCells(), "cells");
    }
    this->CheckSizes(grid);
    this->CheckPolyhedra(grid);
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

  void CheckSizes(vtkUnstructuredGrid* grid) const
  {
    const bool isVolume = IsVolume(grid); // its skin is taken, for which VTK reads all cells
    std::array<vtkIdType, 256> least;
    least.fill(-1);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      const int type = grid->GetCellType(cell);
      if (least[type] < 0)
      {
        least[type] = LeastSize(type, isVolume);
      }
      if (least[type] > 0)
      {
        const vtkIdType size = grid->GetCells()->GetCellSize(cell);
        const vtkIdType ofOrder = this->SizeOfOrder(type, cell, size);
        const vtkIdType needed = std::max(least[type], ofOrder);
        const bool isExact = isVolume && (type == VTK_PIXEL || ofOrder > 0); // else VTK takes the skin of another order
        if (size < needed || (isExact && size > needed))
        {
          throw InvalidInput(Cell(cell) + " of " + this->Whose + " has " + std::to_string(size) +
            " points, and its type needs " + std::to_string(needed) + "; repair the source of " + this->Whose);
        }
      }
    }
  }

  /// The points that VTK reads of any cell of a type. On surfaces, triangles and quadrilaterals of fewer points are polygons, and cells of
  /// no or one dimension take no part.
  static vtkIdType LeastSize(int type, bool isVolume)
  {
    if (!isVolume && (type == VTK_TRIANGLE || type == VTK_QUAD))
    {
      return 0;
    }
    vtkNew<vtkGenericCell> cell;
    cell->SetCellType(type);
    return isVolume || cell->GetCellDimension() == 2 ? cell->GetNumberOfPoints() : 0;
  }

  /// The number of points of a cell of higher order: that of the orders in the cell data, where these have any, else that of the
  /// same order along all axes.
  vtkIdType SizeOfOrder(int type, vtkIdType cell, vtkIdType size) const
  {
    const auto isOneOf = [type](int lagrange, int bezier) { return type == lagrange || type == bezier; };
    vtkDataArray* const degrees = this->Data->GetCellData()->GetHigherOrderDegrees();
    const bool hasDegrees = degrees && degrees->GetNumberOfComponents() >= 3 && degrees->GetNumberOfTuples() > cell;
    const auto order = [&](int axis, double root)
    { return static_cast<vtkIdType>(hasDegrees ? degrees->GetComponent(cell, axis) : std::lround(root) - 1.0); };
    const auto number = static_cast<double>(size);
    if (isOneOf(VTK_LAGRANGE_QUADRILATERAL, VTK_BEZIER_QUADRILATERAL))
    {
      return (order(0, std::sqrt(number)) + 1) * (order(1, std::sqrt(number)) + 1);
    }
    if (isOneOf(VTK_LAGRANGE_HEXAHEDRON, VTK_BEZIER_HEXAHEDRON))
    {
      const double root = std::cbrt(number);
      return (order(0, root) + 1) * (order(1, root) + 1) * (order(2, root) + 1);
    }
    if (isOneOf(VTK_LAGRANGE_WEDGE, VTK_BEZIER_WEDGE) &&
      size != 21) // 21: quadratic, with points in the middle of sides and inside
    {
      const double root = std::cbrt(2.0 * number);
      return (order(0, root) + 1) * (order(0, root) + 2) / 2 * (order(2, root) + 1);
    }
    if (isOneOf(VTK_LAGRANGE_TETRAHEDRON, VTK_BEZIER_TETRAHEDRON) && size != 15) // 15: the same
    {
      vtkIdType n = 1;
      while ((n + 1) * (n + 2) * (n + 3) / 6 < size)
      {
        ++n;
      }
      return (n + 1) * (n + 2) * (n + 3) / 6;
    }
    return 0;
  }

  /// Polyhedra have lists of faces beside that of points.
  void CheckPolyhedra(vtkUnstructuredGrid* grid) const
  {
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      if (grid->GetCellType(cell) != VTK_POLYHEDRON)
      {
        continue;
      }
      const vtkIdType faces = this->CheckFaces(grid, cell);
      if (faces < 4)
      {
        throw InvalidInput(Cell(cell) + " of " + this->Whose + " is a polyhedron of " + std::to_string(faces) +
          " faces; repair the source of " + this->Whose);
      }
    }
  }

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0) // faces are cells of a list
  vtkIdType CheckFaces(vtkUnstructuredGrid* grid, vtkIdType cell) const
  {
    vtkCellArray* const faces = grid->GetPolyhedronFaces();
    vtkCellArray* const facesOfCells = grid->GetPolyhedronFaceLocations();
    if (!faces || !facesOfCells || facesOfCells->GetNumberOfCells() <= cell)
    {
      return 0;
    }
    vtkNew<vtkIdList> ids, corners;
    facesOfCells->GetCellAtId(cell, ids);
    for (const vtkIdType face : *ids)
    {
      if (face < 0 || face >= faces->GetNumberOfCells())
      {
        this->RefuseFace(cell);
      }
      faces->GetCellAtId(face, corners);
      this->CheckFace(cell, corners->GetPointer(0), corners->GetNumberOfIds());
    }
    return ids->GetNumberOfIds();
  }
#else // faces are numbers of corners, each before the corners
  vtkIdType CheckFaces(vtkUnstructuredGrid* grid, vtkIdType cell) const
  {
    vtkIdTypeArray* const stream = grid->GetFaces();
    vtkIdTypeArray* const starts = grid->GetFaceLocations();
    if (!stream || !starts || starts->GetNumberOfTuples() <= cell || starts->GetValue(cell) < 0)
    {
      return 0;
    }
    const vtkIdType size = stream->GetNumberOfValues();
    vtkIdType at = starts->GetValue(cell);
    const vtkIdType faces = at < size ? stream->GetValue(at++) : 0;
    for (vtkIdType face = 0; face < faces; ++face)
    {
      const vtkIdType corners = at < size ? stream->GetValue(at++) : 0;
      if (corners < 0 || corners > size - at)
      {
        this->RefuseFace(cell);
      }
      this->CheckFace(cell, stream->GetPointer(at), corners);
      at += corners;
    }
    return faces;
  }
#endif

  void CheckFace(vtkIdType cell, const vtkIdType* corners, vtkIdType number) const
  {
    if (number < 3 ||
      std::any_of(corners, corners + number, [this](vtkIdType id) { return id < 0 || id >= this->NumberOfPoints; }))
    {
      this->RefuseFace(cell);
    }
  }

  [[noreturn]] void RefuseFace(vtkIdType cell) const
  {
    throw InvalidInput(Cell(cell) + " of " + this->Whose +
      " is a polyhedron with a face of fewer than three corners, or of points that " + this->Whose +
      " has not; repair the source of " + this->Whose);
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
