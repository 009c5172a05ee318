#include "vtkSMCyclicColorsInitializationHelper.h"

#include "ColorsAroundZero.h"
#include "Watches.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"

#include <string>

vtkStandardNewMacro(vtkSMCyclicColorsInitializationHelper);

namespace
{
double HalfOfPeriod(vtkSMSourceProxy* filter)
{
  filter->UpdatePropertyInformation(filter->GetProperty("Period"));
  return 0.5 * vtkSMPropertyHelper(filter, "Period").GetAsDouble();
}

// A bar of these colours says what its numbers are, as whole degrees.
void AfterRegistration(vtkObject* proxies, unsigned long, void*, void* registered)
{
  const auto& added = *static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(registered);
  vtkNew<vtkSMTransferFunctionManager> manager;
  if (std::string(added.GroupName) == "scalar_bars" && added.Proxy &&
    vtkSMPropertyHelper(added.Proxy, "LookupTable", true).GetAsProxy() ==
      manager->GetColorTransferFunction("Angle", vtkSMSessionProxyManager::SafeDownCast(proxies)))
  {
    vtkSMPropertyHelper(added.Proxy, "Title").Set("Angle (degrees)");
    vtkSMPropertyHelper(added.Proxy, "ComponentTitle").Set("");
    vtkSMPropertyHelper(added.Proxy, "AutomaticLabelFormat").Set(0);
    vtkSMPropertyHelper(added.Proxy, "LabelFormat").Set("%.0f");
    vtkSMPropertyHelper(added.Proxy, "RangeLabelFormat").Set("%.0f");
    added.Proxy->UpdateVTKObjects();
  }
}

constexpr ColorsAroundZero Cyclic = { "Angle", "hue_L60", HalfOfPeriod, false }; // hues of one lightness
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
  static const vtkNew<vtkCallbackCommand> after; // for all filters of a session
  after->SetCallback(AfterRegistration);
  filter->GetSessionProxyManager()->RemoveObserver(after);
  filter->GetSessionProxyManager()->AddObserver(vtkCommand::RegisterEvent, after);
}
