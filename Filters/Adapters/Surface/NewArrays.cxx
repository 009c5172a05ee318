#include "Adapters/Surface/NewArrays.h"

#include "vtkAbstractArray.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"

#include <cstdlib>
#include <new>

namespace dmg
{

vtkSmartPointer<vtkDoubleArray> NewArray(const std::string& name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  // Arrays of ParaView's VTK end the process where there is no memory; this throws.
  const vtkIdType size = components * tuples;
  auto* const values = static_cast<double*>(std::malloc(std::max<vtkIdType>(size, 1) * sizeof(double)));
  if (!values)
  {
    throw std::bad_alloc();
  }
  array->SetArray(values, size, 0, vtkDoubleArray::VTK_DATA_ARRAY_FREE);
  return array;
}

void AddHidden(vtkFieldData* fieldData, vtkAbstractArray* array)
{
  array->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
  fieldData->AddArray(array);
}

}
