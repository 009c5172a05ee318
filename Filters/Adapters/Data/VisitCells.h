#ifndef dmgVisitCells_h
#define dmgVisitCells_h

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkSmartPointer.h"

namespace dmg
{

/// Calls visit(index, size, points) for each cell of a list in order. Unlike vtkPolyData::GetCell it takes cells of any number of points.
template <class Visitor>
void VisitCells(vtkCellArray* cells, Visitor&& visit)
{
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  vtkIdType index = 0;
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* points;
    iterator->GetCurrentCell(size, points);
    visit(index++, size, points);
  }
}

}

#endif
