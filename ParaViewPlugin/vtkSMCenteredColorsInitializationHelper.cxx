#include "vtkSMCenteredColorsInitializationHelper.h"

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

vtkStandardNewMacro(vtkSMCenteredColorsInitializationHelper);

namespace
{
constexpr const char* Array = "StreamFunction";
constexpr int Never = -1; // is when ParaView fits the colours to the range of the data by itself

void AfterUpdate(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  vtkPVArrayInformation* const values = filter->GetDataInformation(0)->GetArrayInformation(Array, vtkDataObject::POINT);
  const double* const range = values ? values->GetComponentRange(0) : nullptr;
  const double largest = range ? std::max(std::abs(range[0]), std::abs(range[1])) : 0.0;
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* const colours = manager->GetColorTransferFunction(Array, filter->GetSessionProxyManager());
  if (largest > 0.0 && vtkSMPropertyHelper(colours, "AutomaticRescaleRangeMode").GetAsInt() == Never)
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(colours, -largest, largest);
  }
}
}

//------------------------------------------------------------------------------
void vtkSMCenteredColorsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  vtkNew<vtkSMTransferFunctionManager> manager;
  const vtkMTimeType before = filter->GetMTime();
  vtkSMProxy* const colours = manager->GetColorTransferFunction(Array, filter->GetSessionProxyManager());
  if (colours->GetProperty("RGBPoints")->GetMTime() > before) // made just now
  {
    vtkSMPropertyHelper(colours, "AutomaticRescaleRangeMode").Set(Never);
    vtkSMPropertyHelper(colours, "ScalarRangeInitialized").Set(1); // else it is that of the first data
    colours->UpdateVTKObjects();
  }
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
