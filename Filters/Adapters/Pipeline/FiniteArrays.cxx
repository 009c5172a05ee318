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

vtkInformationIntegerKey* KeyOfNaN()
{
  static vtkInformationIntegerKey* const key = vtkInformationIntegerKey::MakeKey("NAN_IS_NOTHING", "dmgFiniteArrays");
  return key;
}

void CheckNumbers(vtkAbstractArray* array, const std::string& name)
{
  auto* const numbers = vtkDoubleArray::SafeDownCast(array);
  const double* const first = numbers ? numbers->GetPointer(0) : nullptr;
  const bool allowsNaN = numbers && numbers->HasInformation() && numbers->GetInformation()->Has(KeyOfNaN());
  const auto isRight = [allowsNaN](double x) { return std::isfinite(x) || (allowsNaN && std::isnan(x)); };
  if (numbers && !std::all_of(first, first + numbers->GetNumberOfValues(), isRight))
  {
    throw UnexpectedFailure(name + " would not be finite");
  }
  if (allowsNaN)
  {
    numbers->GetInformation()->Remove(KeyOfNaN());
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
    array->GetInformation()->Set(KeyOfNaN(), 1);
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
