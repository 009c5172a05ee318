#include "Adapters/Data/WithoutStrips.h"

#include "Adapters/Data/VisitCells.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace dmg
{

namespace
{

/// Copies polygons, and makes triangles of strips. \return the cell that each cell of the new dataset comes from, ascending.
vtkSmartPointer<vtkIdList> TrianglesOfStrips(vtkPolyData* surface, vtkCellArray* polygons)
{
  auto origins = vtkSmartPointer<vtkIdList>::New();
  const vtkIdType others = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  vtkIdType cell = 0;
  for (; cell < others; ++cell)
  {
    origins->InsertNextId(cell);
  }
  VisitCells(surface->GetPolys(),
    [&](vtkIdType, vtkIdType size, const vtkIdType* points)
    {
      polygons->InsertNextCell(size, points);
      origins->InsertNextId(cell++);
    });
  VisitCells(surface->GetStrips(),
    [&](vtkIdType, vtkIdType size, const vtkIdType* points)
    {
      for (vtkIdType k = 0; k + 2 < size; ++k)
      {
        const bool isTurned = k % 2 == 1;
        polygons->InsertNextCell({ points[k], points[isTurned ? k + 2 : k + 1], points[isTurned ? k + 1 : k + 2] });
        origins->InsertNextId(cell);
      }
      ++cell;
    });
  return origins;
}

/// The tuples of some cells, as far as there are any.
vtkSmartPointer<vtkAbstractArray> TuplesOf(vtkAbstractArray* array, vtkIdList* cells)
{
  const vtkIdType* const end = std::lower_bound(cells->begin(), cells->end(), array->GetNumberOfTuples());
  vtkNew<vtkIdList> there;
  for (const vtkIdType* cell = cells->begin(); cell != end; ++cell)
  {
    there->InsertNextId(*cell);
  }
  auto tuples = vtk::TakeSmartPointer(array->NewInstance());
  tuples->SetName(array->GetName());
  tuples->SetNumberOfComponents(array->GetNumberOfComponents());
  tuples->CopyComponentNames(array);
  tuples->SetNumberOfTuples(there->GetNumberOfIds());
  array->GetTuples(there, tuples);
  return tuples;
}

}

vtkSmartPointer<vtkDataSet> WithoutStrips(vtkDataSet* surface)
{
  auto* const given = vtkPolyData::SafeDownCast(surface);
  if (!given || given->GetNumberOfStrips() == 0)
  {
    return surface;
  }
  vtkNew<vtkCellArray> polygons;
  const vtkSmartPointer<vtkIdList> origins = TrianglesOfStrips(given, polygons);
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(given->GetPoints());
  result->SetVerts(given->GetVerts());
  result->SetLines(given->GetLines());
  result->SetPolys(polygons);
  result->GetPointData()->ShallowCopy(given->GetPointData());
  result->GetFieldData()->ShallowCopy(given->GetFieldData());
  vtkCellData* const arrays = given->GetCellData();
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    const int index = result->GetCellData()->AddArray(TuplesOf(arrays->GetAbstractArray(k), origins));
    if (const int attribute = arrays->IsArrayAnAttribute(k); attribute >= 0)
    {
      result->GetCellData()->SetActiveAttribute(index, attribute);
    }
  }
  return result;
}

}
