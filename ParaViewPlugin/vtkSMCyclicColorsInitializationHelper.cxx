#include "vtkSMCyclicColorsInitializationHelper.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"

vtkStandardNewMacro(vtkSMCyclicColorsInitializationHelper);

namespace
{
constexpr const char* Array = "Angle";
constexpr const char* CyclicPreset = "hue_L60"; // hues of one lightness
constexpr int Never = -1;                       // is when ParaView fits the colours to the range of the data by itself

void AfterUpdate(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  filter->UpdatePropertyInformation(filter->GetProperty("Period"));
  const double half = 0.5 * vtkSMPropertyHelper(filter, "Period").GetAsDouble();
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* const colours = manager->GetColorTransferFunction(Array, filter->GetSessionProxyManager());
  if (half > 0.0 && vtkSMPropertyHelper(colours, "AutomaticRescaleRangeMode").GetAsInt() == Never)
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(colours, -half, half);
  }
}
}

//------------------------------------------------------------------------------
void vtkSMCyclicColorsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMSessionProxyManager* const proxies = filter->GetSessionProxyManager();
  const vtkMTimeType before = filter->GetMTime();
  vtkSMProxy* const colours = manager->GetColorTransferFunction(Array, proxies);
  if (colours->GetProperty("RGBPoints")->GetMTime() > before) // made just now
  {
    vtkSMTransferFunctionProxy::ApplyPreset(colours, CyclicPreset, true);
    vtkSMPropertyHelper(colours, "AutomaticRescaleRangeMode").Set(Never);
    vtkSMPropertyHelper(colours, "ScalarRangeInitialized").Set(1); // else it is that of the first data
    colours->UpdateVTKObjects();
  }
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
