#include "vtkSMSequentialColorsInitializationHelper.h"

#include "NewColors.h"
#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

vtkStandardNewMacro(vtkSMSequentialColorsInitializationHelper);

namespace
{
// Light enough everywhere for dark lines to show on them.
constexpr double Colors[] = {
  0.0, 0.97, 0.99, 0.94, //
  0.5, 0.58, 0.83, 0.72, //
  1.0, 0.17, 0.55, 0.62, //
};
constexpr int Lab = 2;
}

//------------------------------------------------------------------------------
void vtkSMSequentialColorsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  if (vtkSMProxy* const function = NewTransferFunctionOf("Distance", filter))
  {
    vtkSMPropertyHelper(function, "RGBPoints").Set(Colors, sizeof(Colors) / sizeof(Colors[0]));
    vtkSMPropertyHelper(function, "ColorSpace").Set(Lab);
    function->UpdateVTKObjects();
  }
}
