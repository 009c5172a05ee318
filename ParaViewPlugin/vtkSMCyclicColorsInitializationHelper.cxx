#include "vtkSMCyclicColorsInitializationHelper.h"

#include "vtkCallbackCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkSMCyclicColorsInitializationHelper);

namespace
{
constexpr const char* Array = "Angle";
constexpr const char* CyclicPreset = "hue_L60"; // hues of one lightness
constexpr int Never = -1;                       // is when ParaView fits the colours to the range of the data by itself

// The smallest 180 / N, N up to 8, that no angle exceeds.
double HalfPeriod(double largest)
{
  int N = 8;
  while (N > 1 && 180.0 / N < largest - 1e-9)
  {
    --N;
  }
  return 180.0 / N;
}

void AfterUpdate(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  vtkPVArrayInformation* const angles =
    filter->GetDataInformation(0)->GetArrayInformation(Array, vtkDataObject::FIELD_ASSOCIATION_CELLS);
  if (!angles)
  {
    return;
  }
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* const colours = manager->GetColorTransferFunction(Array, filter->GetSessionProxyManager());
  if (vtkSMPropertyHelper(colours, "AutomaticRescaleRangeMode").GetAsInt() == Never)
  {
    const double* const range = angles->GetComponentRange(0);
    const double half = HalfPeriod(std::max(std::abs(range[0]), std::abs(range[1])));
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
    colours->UpdateVTKObjects();
  }
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
