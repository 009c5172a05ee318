#include "vtkSMCyclicColorsInitializationHelper.h"

#include "ColorsAroundZero.h"
#include "Watches.h"
#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

vtkStandardNewMacro(vtkSMCyclicColorsInitializationHelper);

namespace
{
double HalfOfPeriod(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("Period"));
  return 0.5 * vtkSMPropertyHelper(filter, "Period").GetAsDouble();
}

constexpr ColorsAroundZero Cyclic = { "Angle", "hue_L60", HalfOfPeriod, false, "Angle (degrees)",
  "%.0f" }; // hues of one lightness
}

//------------------------------------------------------------------------------
void vtkSMCyclicColorsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  SetColorsAroundZero(filter, Cyclic);
}

//------------------------------------------------------------------------------
void WatchCyclicColors(vtkSMProxy* filter)
{
  FitColorsAroundZero(filter, Cyclic);
}
