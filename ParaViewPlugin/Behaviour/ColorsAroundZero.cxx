#include "ColorsAroundZero.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"

namespace
{
constexpr int Never = -1; // is when ParaView fits the colours to the range of the data by itself

vtkSMProxy* TransferFunctionOf(const char* array, vtkSMProxy* filter)
{
  vtkNew<vtkSMTransferFunctionManager> manager;
  return manager->GetColorTransferFunction(array, filter->GetSessionProxyManager());
}

void AfterUpdate(vtkObject* caller, unsigned long, void* data, void*)
{
  const auto& colors = *static_cast<const ColorsAroundZero*>(data);
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  const double half = colors.HalfOf(filter);
  vtkSMProxy* const function = TransferFunctionOf(colors.Array, filter);
  if (half > 0.0 && vtkSMPropertyHelper(function, "AutomaticRescaleRangeMode").GetAsInt() == Never)
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(function, -half, half);
  }
}
}

//------------------------------------------------------------------------------
void SetColorsAroundZero(vtkSMProxy* filter, const ColorsAroundZero& colors)
{
  const vtkMTimeType before = filter->GetMTime();
  vtkSMProxy* const function = TransferFunctionOf(colors.Array, filter);
  if (function->GetProperty("RGBPoints")->GetMTime() > before) // made just now
  {
    if (colors.Preset)
    {
      vtkSMTransferFunctionProxy::ApplyPreset(function, colors.Preset, true);
    }
    vtkSMPropertyHelper(function, "AutomaticRescaleRangeMode").Set(Never);
    vtkSMPropertyHelper(function, "ScalarRangeInitialized").Set(1); // else it is that of the first data
    function->UpdateVTKObjects();
  }
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  after->SetClientData(const_cast<ColorsAroundZero*>(&colors));
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
