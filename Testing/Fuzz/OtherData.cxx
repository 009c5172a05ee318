#include "Fuzz/OtherData.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTable.h"

#include <iterator>
#include <vector>

namespace dmg::test
{

namespace
{

struct CellType
{
  int Type;
  int NumberOfPoints;
};

constexpr CellType Volumes[] = { { VTK_TETRA, 4 }, { VTK_VOXEL, 8 }, { VTK_HEXAHEDRON, 8 }, { VTK_WEDGE, 6 },
  { VTK_PYRAMID, 5 }, { VTK_PENTAGONAL_PRISM, 10 }, { VTK_HEXAGONAL_PRISM, 12 }, { VTK_QUADRATIC_TETRA, 10 },
  { VTK_QUADRATIC_HEXAHEDRON, 20 }, { VTK_QUADRATIC_WEDGE, 15 }, { VTK_QUADRATIC_PYRAMID, 13 },
  { VTK_TRIQUADRATIC_HEXAHEDRON, 27 }, { VTK_LAGRANGE_TETRAHEDRON, 10 }, { VTK_LAGRANGE_HEXAHEDRON, 27 },
  { VTK_LAGRANGE_WEDGE, 18 }, { VTK_BEZIER_TETRAHEDRON, 10 }, { VTK_BEZIER_HEXAHEDRON, 27 }, { VTK_BEZIER_WEDGE, 18 } };
constexpr CellType Others[] = { { VTK_TRIANGLE, 3 }, { VTK_QUAD, 4 }, { VTK_POLYGON, 5 }, { VTK_LINE, 2 },
  { VTK_QUADRATIC_EDGE, 3 }, { VTK_VERTEX, 1 } };

/// A number for each cell or point, of any length and kind.
vtkSmartPointer<vtkDoubleArray> NumbersOf(Choices& choose, vtkIdType size, const char* name)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(choose.OneIn(2) ? 3 : 1);
  array->SetNumberOfTuples(choose.OneIn(6) ? choose.Below(static_cast<int>(size) + 2) : size);
  for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
  {
    array->SetValue(value, choose.Number());
  }
  return array;
}

/// A tetrahedron as a polyhedron, whose faces may be wrong.
void AddPolyhedron(Choices& choose, vtkUnstructuredGrid* grid, int numberOfPoints)
{
  std::vector<vtkIdType> points(4);
  for (vtkIdType& point : points)
  {
    point = choose.Below(numberOfPoints);
  }
  std::vector<vtkIdType> faces;
  for (int face = 0; face < 4; ++face)
  {
    faces.push_back(3);
    for (int k = 0; k < 3; ++k)
    {
      faces.push_back(choose.OneIn(40) ? choose.Below(2 * numberOfPoints) : points[(face + k) % 4]);
    }
  }
  grid->InsertNextCell(VTK_POLYHEDRON, 4, points.data(), 4, faces.data());
}

}

vtkSmartPointer<vtkUnstructuredGrid> DamagedGrid(Choices& choose, vtkPolyData* surface)
{
  constexpr int Types[] = { VTK_TRIANGLE, VTK_PIXEL, VTK_POLYGON, VTK_TRIANGLE_STRIP, VTK_QUADRATIC_TRIANGLE,
    VTK_BIQUADRATIC_QUAD, VTK_LAGRANGE_TRIANGLE, VTK_LAGRANGE_QUADRILATERAL, VTK_BEZIER_TRIANGLE,
    VTK_BEZIER_QUADRILATERAL, VTK_QUADRATIC_POLYGON, VTK_LINE, VTK_VERTEX };
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(surface->GetPoints());
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, corners);
    grid->InsertNextCell(VTK_POLYGON, corners);
  }
  const int size = static_cast<int>(surface->GetNumberOfPoints());
  for (int more = choose.Below(4); more > 0; --more)
  {
    corners->Reset();
    for (int k = choose.Below(12); k > 0; --k)
    {
      corners->InsertNextId(choose.OneIn(40) ? choose.Below(2000000000) - 1000000000 : choose.Below(size));
    }
    grid->InsertNextCell(Types[choose.Below(static_cast<int>(std::size(Types)))], corners);
  }
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfTuples(choose.Below(static_cast<int>(grid->GetNumberOfCells()) + 1));
  array->Fill(choose.Number());
  grid->GetCellData()->AddArray(array); // without a name
  return grid;
}

vtkSmartPointer<vtkDataObject> VolumeOf(Choices& choose)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const int size = 4 + choose.Below(60);
  vtkNew<vtkPoints> points;
  for (int point = 0; point < size; ++point)
  {
    points->InsertNextPoint(choose.Unit(), choose.Unit(), choose.OneIn(60) ? choose.Number() : choose.Unit());
  }
  grid->SetPoints(points);
  vtkNew<vtkIdList> corners;
  for (int cells = 1 + choose.Below(12); cells > 0; --cells)
  {
    if (choose.OneIn(8))
    {
      AddPolyhedron(choose, grid, size);
      continue;
    }
    const bool isVolume = !choose.OneIn(4);
    const CellType cell = isVolume ? Volumes[choose.Below(static_cast<int>(std::size(Volumes)))]
                                   : Others[choose.Below(static_cast<int>(std::size(Others)))];
    corners->Reset();
    for (int k = choose.OneIn(10) ? choose.Below(30) : cell.NumberOfPoints; k > 0; --k)
    {
      corners->InsertNextId(choose.OneIn(400) ? choose.Below(2000000000) - 1000000000 : choose.Below(size));
    }
    grid->InsertNextCell(cell.Type, corners);
  }
  grid->GetCellData()->AddArray(NumbersOf(choose, grid->GetNumberOfCells(), "Given"));
  grid->GetPointData()->AddArray(NumbersOf(choose, size, "Given"));
  return grid;
}

vtkSmartPointer<vtkDataObject> BlocksOf(Choices& choose, vtkPolyData* surface)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const int count = choose.Below(5);
  for (int block = 0; block < count; ++block)
  {
    switch (choose.Below(6))
    {
      case 0:
        blocks->SetBlock(block, vtkNew<vtkTable>());
        break;
      case 1:
        blocks->SetBlock(block, VolumeOf(choose));
        break;
      case 2:
      {
        vtkNew<vtkPolyData> lines;
        lines->SetPoints(surface->GetPoints());
        lines->SetLines(vtkNew<vtkCellArray>());
        lines->GetLines()->InsertNextCell({ 0, 1, 2 });
        blocks->SetBlock(block, lines);
        break;
      }
      case 3:
        blocks->SetBlock(block, BlocksOf(choose, surface));
        break;
      case 4:
        break; // none
      default:
        blocks->SetBlock(block, surface);
    }
  }
  return blocks;
}

}
