#include "Adapters/Data/HiddenCells.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

namespace dmg
{

vtkSmartPointer<vtkDataSet> WithHidden(vtkDataSet* dataset, const std::vector<char>& isHidden)
{
  vtkSmartPointer<vtkDataSet> rest = vtk::TakeSmartPointer(dataset->NewInstance());
  rest->ShallowCopy(dataset);
  auto* const former =
    vtkUnsignedCharArray::SafeDownCast(dataset->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(dataset->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
  {
    const int before = former ? former->GetValue(cell) : 0;
    const int hidden = isHidden[cell] ? static_cast<int>(vtkDataSetAttributes::HIDDENCELL) : 0;
    ghosts->SetValue(cell, static_cast<unsigned char>(before | hidden));
  }
  rest->GetCellData()->AddArray(ghosts);
  return rest;
}

}
