#ifndef dmgNewArrays_h
#define dmgNewArrays_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <string>

namespace dmg
{

/// Its values are to be written. \throw std::bad_alloc
vtkSmartPointer<vtkDoubleArray> NewArray(const std::string& name, int components, vtkIdType tuples);

/// An array of values, one after the other. \param values a std::vector, or an Eigen vector.
template <class Array, class Values>
vtkSmartPointer<Array> NewArray(const std::string& name, int components, const Values& values)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy_n(values.data(), values.size(), array->GetPointer(0));
  return array;
}

/// An array of one value, which may be a text.
template <class Array, class Value>
vtkSmartPointer<Array> NewValue(const std::string& name, const Value& value)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->InsertNextValue(value);
  return array;
}

/// Adds an array that no menu offers, as for colours (vtkAbstractArray::GUI_HIDE).
void AddHidden(vtkFieldData* fieldData, vtkAbstractArray* array);

}

#endif
