#include "Adapters/Data/NumberedCells.h"

#include "Adapters/Data/VisitCells.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>

namespace dmg
{

namespace
{

/// A list of cells with the fewest points that its cells may have, and their type.
struct CellList
{
  vtkCellArray* Cells;
  vtkIdType FewestPoints;
  unsigned char Type;
};

std::array<CellList, 4> ListsOf(vtkPolyData* data)
{
  return { CellList{ data->GetVerts(), 1, VTK_POLY_VERTEX }, CellList{ data->GetLines(), 2, VTK_POLY_LINE },
    CellList{ data->GetPolys(), 3, VTK_POLYGON }, CellList{ data->GetStrips(), 3, VTK_TRIANGLE_STRIP } };
}

bool HasTooFewPoints(const CellList& list)
{
  bool has = false;
  VisitCells(list.Cells, [&](vtkIdType, vtkIdType size, const vtkIdType*) { has = has || size < list.FewestPoints; });
  return has;
}

}

vtkSmartPointer<vtkDataSet> WithNumberedCells(vtkDataSet* dataset)
{
  auto* const data = vtkPolyData::SafeDownCast(dataset);
  const std::array<CellList, 4> lists = data ? ListsOf(data) : std::array<CellList, 4>();
  if (!data || std::none_of(lists.begin(), lists.end(), HasTooFewPoints))
  {
    return dataset;
  }
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  for (const CellList& list : lists)
  {
    VisitCells(list.Cells,
      [&](vtkIdType, vtkIdType size, const vtkIdType* points)
      {
        cells->InsertNextCell(size, points); // vtkCellArray::Append is wrong where all cells have no points
        types->InsertNextValue(list.Type);
      });
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(data->GetPoints());
  grid->SetCells(types, cells);
  grid->GetPointData()->ShallowCopy(data->GetPointData());
  grid->GetCellData()->ShallowCopy(data->GetCellData());
  grid->SetFieldData(data->GetFieldData());
  return grid;
}

}
