#include "vtkSMCenteredColorsInitializationHelper.h"

#include "ColorsAroundZero.h"
#include "Watches.h"
#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkSMCenteredColorsInitializationHelper);

namespace
{
constexpr const char* Array = "StreamFunction";

double LargestMagnitude(vtkSMSourceProxy* filter)
{
  vtkPVArrayInformation* const values = filter->GetDataInformation(0)->GetArrayInformation(Array, vtkDataObject::POINT);
  const double* const range = values ? values->GetComponentRange(0) : nullptr;
  return range ? std::max(std::abs(range[0]), std::abs(range[1])) : 0.0;
}

constexpr ColorsAroundZero Centered = { Array, nullptr, LargestMagnitude, true, "Stream function (speed \u00d7 length)",
  "%.3g" };
}

//------------------------------------------------------------------------------
void vtkSMCenteredColorsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  SetColorsAroundZero(filter, Centered);
}

//------------------------------------------------------------------------------
void WatchCenteredColors(vtkSMProxy* filter)
{
  FitColorsAroundZero(filter, Centered);
}
