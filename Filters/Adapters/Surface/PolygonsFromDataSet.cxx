#include "Adapters/Surface/PolygonsFromDataSet.h"

#include "Adapters/Data/CellChecks.h"
#include "Adapters/Data/VisitCells.h"
#include "Support/Errors.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

std::string Cell(vtkIdType id)
{
  return "cell " + std::to_string(id);
}

template <class Number>
void CopyPoints(const Number* xyz, Points& positions)
{
  std::copy_n(xyz, positions.size(), positions.data());
}

/// Positions in double precision.
Points ReadPoints(vtkDataSet* surface)
{
  Points positions(surface->GetNumberOfPoints(), 3);
  auto* const pointSet = vtkPointSet::SafeDownCast(surface);
  vtkDataArray* const array = pointSet && pointSet->GetPoints() ? pointSet->GetPoints()->GetData() : nullptr;
  if (auto* const doubles = vtkDoubleArray::FastDownCast(array))
  {
    CopyPoints(doubles->GetPointer(0), positions);
  }
  else if (auto* const floats = vtkFloatArray::FastDownCast(array))
  {
    CopyPoints(floats->GetPointer(0), positions);
  }
  else // other types and memory layouts, and grids
  {
    for (vtkIdType i = 0; i < positions.rows(); ++i)
    {
      surface->GetPoint(i, positions.data() + 3 * i);
    }
  }
  return positions;
}

/// The ghosts among the cells of a dataset.
class Ghosts
{
public:
  explicit Ghosts(vtkDataSet* surface)
    : OfCells(Flags(surface->GetCellData(), surface->GetNumberOfCells()))
    , OfPoints(Flags(surface->GetPointData(), surface->GetNumberOfPoints()))
  {
  }

  bool IsHidden(vtkIdType cell, vtkIdType size, const vtkIdType* points) const
  {
    return (this->OfCells && (this->OfCells->GetValue(cell) & vtkDataSetAttributes::HIDDENCELL) != 0) ||
      (this->OfPoints &&
        std::any_of(points, points + size,
          [this](vtkIdType point)
          { return (this->OfPoints->GetValue(point) & vtkDataSetAttributes::HIDDENPOINT) != 0; }));
  }

  bool AreAny() const { return this->OfCells || this->OfPoints; }

  /// Whether each cell is a duplicate, from the first one on; empty where there are no duplicates.
  std::vector<char> Duplicates(vtkIdType firstCell, vtkIdType numberOfCells) const
  {
    std::vector<char> are;
    for (vtkIdType cell = 0; this->OfCells && cell < numberOfCells; ++cell)
    {
      if ((this->OfCells->GetValue(firstCell + cell) & vtkDataSetAttributes::DUPLICATECELL) != 0)
      {
        are.resize(numberOfCells, 0);
        are[cell] = 1;
      }
    }
    return are;
  }

private:
  /// Null where no flag is set.
  static vtkUnsignedCharArray* Flags(vtkFieldData* data, vtkIdType size)
  {
    auto* const flags =
      vtkUnsignedCharArray::SafeDownCast(data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
    if (!flags || flags->GetNumberOfComponents() != 1 || flags->GetNumberOfTuples() < size)
    {
      return nullptr;
    }
    const unsigned char* const first = flags->GetPointer(0);
    return std::any_of(first, first + size, [](unsigned char flag) { return flag != 0; }) ? flags : nullptr;
  }

  vtkUnsignedCharArray* const OfCells;
  vtkUnsignedCharArray* const OfPoints;
};

/// \return whether all polygons are triangles.
bool ReadTriangles(vtkPolyData* surface, Triangles& corners)
{
  corners.resize(surface->GetNumberOfPolys(), 3);
  bool areTriangles = true;
  VisitCells(surface->GetPolys(),
    [&](vtkIdType polygon, vtkIdType size, const vtkIdType* points)
    {
      areTriangles = areTriangles && size == 3;
      if (areTriangles)
      {
        std::copy_n(points, 3, corners.data() + 3 * polygon);
      }
    });
  return areTriangles;
}

void Add(PolygonSurface& polygons, vtkIdType size, const vtkIdType* points)
{
  if (static_cast<vtkIdType>(polygons.Corners.size()) + size > std::numeric_limits<int>::max() / 3)
  {
    throw InvalidInput(
      "the surface has too many cells to be numbered; apply Triangulate (vtkTriangleFilter) and Decimate "
      "(vtkDecimatePro) first");
  }
  polygons.Corners.insert(polygons.Corners.end(), points, points + size);
  polygons.Offsets.push_back(static_cast<int>(polygons.Corners.size()));
}

SurfaceCells ReadPolyData(vtkPolyData* surface)
{
  const vtkIdType firstCell = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  const vtkIdType numberOfPolygons = surface->GetNumberOfPolys();
  const Ghosts ghosts(surface);
  std::vector<char> duplicates = ghosts.Duplicates(firstCell, numberOfPolygons);
  Triangles corners;
  if (!ghosts.AreAny() && ReadTriangles(surface, corners))
  {
    return CellTriangles{ ReadPoints(surface), std::move(corners), static_cast<int>(firstCell),
      static_cast<int>(numberOfPolygons), {}, {} };
  }
  PolygonSurface polygons;
  polygons.FirstCell = static_cast<int>(firstCell);
  polygons.IsDuplicate = std::move(duplicates);
  polygons.Offsets.reserve(numberOfPolygons + 1);
  VisitCells(surface->GetPolys(),
    [&](vtkIdType polygon, vtkIdType size, const vtkIdType* points)
    { Add(polygons, ghosts.IsHidden(firstCell + polygon, size, points) ? 0 : size, points); });
  polygons.Positions = ReadPoints(surface);
  return polygons;
}

/// Cells of other datasets than vtkPolyData, one after the other.
class CellReader
{
public:
  explicit CellReader(vtkDataSet* surface)
    : Surface(surface)
    , HiddenCells(surface)
  {
    this->Dimensions.fill(-1);
    this->Polygons.NumberOfCells = static_cast<int>(surface->GetNumberOfCells());
  }

  PolygonSurface Read()
  {
    for (vtkIdType cell = 0; cell < this->Surface->GetNumberOfCells(); ++cell)
    {
      const int dimension = this->DimensionOf(cell);
      if (dimension == 3)
      {
        throw InvalidInput(Cell(cell) +
          " is a cell of three dimensions, and a field is computed on a surface; apply Extract Surface "
          "(vtkGeometryFilter) first");
      }
      if (dimension == 2)
      {
        this->ReadCell(cell);
      }
    }
    this->Polygons.IsDuplicate = this->HiddenCells.Duplicates(0, this->Surface->GetNumberOfCells());
    this->Polygons.Positions = ReadPoints(this->Surface);
    return std::move(this->Polygons);
  }

private:
  int DimensionOf(vtkIdType cell)
  {
    int& dimension = this->Dimensions.at(this->Surface->GetCellType(cell));
    if (dimension < 0)
    {
      this->Generic->SetCellType(this->Surface->GetCellType(cell));
      dimension = this->Generic->GetCellDimension();
    }
    return dimension;
  }

  void ReadCell(vtkIdType cell)
  {
    this->Surface->GetCellPoints(cell, this->Ids);
    const vtkIdType size = this->Ids->GetNumberOfIds();
    vtkIdType* const points = this->Ids->GetPointer(0);
    if (this->HiddenCells.IsHidden(cell, size, points))
    {
      return;
    }
    switch (this->Surface->GetCellType(cell))
    {
      case VTK_PIXEL:
        std::swap(points[2], points[3]);
        this->AddTo(cell, size, points);
        break;
      case VTK_TRIANGLE:
      case VTK_QUAD:
      case VTK_POLYGON:
        this->AddTo(cell, size, points);
        break;
      default:
        this->AddTriangles(cell);
    }
  }

  void AddTo(vtkIdType cell, vtkIdType size, const vtkIdType* points)
  {
    Add(this->Polygons, size, points);
    this->Polygons.Cells.push_back(static_cast<int>(cell));
  }

  /// Adds the triangles of a cell of higher order, or of a strip.
  void AddTriangles(vtkIdType cell)
  {
    this->Surface->GetCell(cell, this->Generic);
    this->Generic->Triangulate(0, this->Ids, this->Corners);
    for (vtkIdType k = 0; k + 2 < this->Ids->GetNumberOfIds(); k += 3)
    {
      this->AddTo(cell, 3, this->Ids->GetPointer(k));
    }
  }

  vtkDataSet* const Surface;
  const Ghosts HiddenCells;
  std::array<int, 256> Dimensions; ///< of types; -1 where none was met yet
  PolygonSurface Polygons;
  vtkNew<vtkIdList> Ids;
  vtkNew<vtkPoints> Corners;
  vtkNew<vtkGenericCell> Generic;
};

}

SurfaceCells ReadSurfaceCells(vtkDataSet* surface)
{
  if (std::max(surface->GetNumberOfPoints(), surface->GetNumberOfCells()) > std::numeric_limits<int>::max() / 3)
  {
    throw InvalidInput("the surface has " + std::to_string(surface->GetNumberOfCells()) + " cells, at most " +
      std::to_string(std::numeric_limits<int>::max() / 3) + " can be numbered; apply Decimate (vtkDecimatePro) first");
  }
  CheckCells(surface, "the surface");
  SurfaceCells cells;
  if (auto* const polyData = vtkPolyData::SafeDownCast(surface))
  {
    cells = ReadPolyData(polyData);
  }
  else
  {
    cells = CellReader(surface).Read();
  }
  if (std::visit([](const auto& read) { return read.Corners.size() == 0; }, cells))
  {
    throw InvalidInput("the surface has no triangles or other cells of two dimensions; connect another, or the dataset "
                       "that it was made of, through Extract Surface (vtkGeometryFilter)");
  }
  return cells;
}

vtkSmartPointer<vtkDataSet> SurfaceOf(vtkInformationVector* port)
{
  return vtkDataSet::GetData(port);
}

vtkSmartPointer<vtkPoints> PointsOf(vtkDataSet* dataset)
{
  if (auto* const pointSet = vtkPointSet::SafeDownCast(dataset))
  {
    return pointSet->GetPoints();
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(dataset->GetNumberOfPoints());
  for (vtkIdType i = 0; i < dataset->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, dataset->GetPoint(i));
  }
  return points;
}

}
