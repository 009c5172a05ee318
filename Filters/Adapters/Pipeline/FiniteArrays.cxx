#include "Adapters/Pipeline/FiniteArrays.h"

#include "Support/Errors.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dmg
{
namespace
{

/// The numbers that an array may have besides finite ones.
enum Others
{
  None,
  NaN,
  Any
};

vtkInformationIntegerKey* KeyOfOthers()
{
  static vtkInformationIntegerKey* const key = vtkInformationIntegerKey::MakeKey("OTHER_NUMBERS", "dmgFiniteArrays");
  return key;
}

void CheckNumbers(vtkAbstractArray* array, const std::string& name)
{
  auto* const numbers = vtkDoubleArray::SafeDownCast(array);
  const double* const first = numbers ? numbers->GetPointer(0) : nullptr;
  const int others = array && array->HasInformation() && array->GetInformation()->Has(KeyOfOthers())
    ? array->GetInformation()->Get(KeyOfOthers())
    : None;
  const auto isRight = [others](double x)
  { return std::isfinite(x) || others == Any || (others == NaN && std::isnan(x)); };
  if (numbers && !std::all_of(first, first + numbers->GetNumberOfValues(), isRight))
  {
    throw UnexpectedFailure(name + " would not be finite");
  }
  if (others != None)
  {
    array->GetInformation()->Remove(KeyOfOthers());
  }
}

bool Holds(vtkFieldData* data, vtkAbstractArray* array)
{
  for (int k = 0; data && k < data->GetNumberOfArrays(); ++k)
  {
    if (data->GetAbstractArray(k) == array)
    {
      return true;
    }
  }
  return false;
}

void CheckArrays(vtkFieldData* output, vtkFieldData* input)
{
  for (int k = 0; output && k < output->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* const array = output->GetAbstractArray(k);
    if (!Holds(input, array))
    {
      const char* const name = array->GetName();
      CheckNumbers(array, std::string("array '") + (name ? name : "") + "'");
    }
  }
}

}

void AllowNaN(vtkAbstractArray* array)
{
  if (array)
  {
    array->GetInformation()->Set(KeyOfOthers(), NaN);
  }
}

void AllowAnyNumber(vtkFieldData* arrays)
{
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    arrays->GetAbstractArray(k)->GetInformation()->Set(KeyOfOthers(), Any);
  }
}

void CheckArraysAreFinite(vtkDataObject* output, vtkDataSet* input)
{
  if (auto* const composite = vtkCompositeDataSet::SafeDownCast(output))
  {
    const auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      CheckArraysAreFinite(leaf->GetCurrentDataObject(), input);
    }
    return;
  }
  for (int kind = 0; kind < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++kind)
  {
    CheckArrays(output->GetAttributesAsFieldData(kind), input->GetAttributesAsFieldData(kind));
  }
  auto* const points = vtkPointSet::SafeDownCast(output);
  auto* const given = vtkPointSet::SafeDownCast(input);
  if (points && points->GetPoints() && !(given && points->GetPoints() == given->GetPoints()))
  {
    CheckNumbers(points->GetPoints()->GetData(), "a point");
  }
}

}
