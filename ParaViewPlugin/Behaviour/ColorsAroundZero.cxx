#include "ColorsAroundZero.h"

#include "NewColors.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <locale>
#include <set>
#include <sstream>
#include <string>

namespace
{
constexpr int Never = -1; // is when ParaView fits the colours to the range of the data by itself

// Half the interval that colours were given here, of the transfer function, which states keep with it. Colours without it are somebody's own.
constexpr const char* Half = "DirectionalMultigrid.HalfOfInterval";

bool HasInterval(vtkSMProxy* function, double half)
{
  double range[2];
  return vtkSMTransferFunctionProxy::GetRange(function, range) && std::abs(range[0] + half) <= 1e-9 * half &&
    std::abs(range[1] - half) <= 1e-9 * half;
}

void AfterUpdate(vtkObject* caller, unsigned long, void* data, void*)
{
  const auto& colors = *static_cast<const ColorsAroundZero*>(data);
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  vtkSMProxy* const function = TransferFunctionOf(colors.Array, filter);
  if (!function->HasAnnotation(Half))
  {
    return;
  }
  const double former = std::strtod(function->GetAnnotation(Half), nullptr);
  if (former > 0.0 && !HasInterval(function, former))
  {
    function->RemoveAnnotation(Half);
    return;
  }
  const double needed = colors.HalfOf(filter);
  const double half = colors.OnlyGrows ? std::max(former, needed) : needed;
  if (half > 0.0 && half != former)
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(function, -half, half);
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::setprecision(17) << half;
    function->SetAnnotation(Half, text.str().c_str());
  }
}

// All colours whose bars have titles, of a session after the other.
std::set<const ColorsAroundZero*>& WithTitles()
{
  static std::set<const ColorsAroundZero*> colors;
  return colors;
}

void AfterRegistration(vtkObject* proxies, unsigned long, void*, void* registered)
{
  const auto& added = *static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(registered);
  if (std::string(added.GroupName) != "scalar_bars" || !added.Proxy)
  {
    return;
  }
  vtkSMProxy* const function = vtkSMPropertyHelper(added.Proxy, "LookupTable", true).GetAsProxy();
  const char* const found = vtkSMSessionProxyManager::SafeDownCast(proxies)->GetProxyName("lookup_tables", function);
  const std::string name = found ? found : "";
  for (const ColorsAroundZero* const colors : WithTitles())
  {
    if (name == colors->Array + std::string(".PVLookupTable"))
    {
      vtkSMPropertyHelper(added.Proxy, "Title").Set(colors->BarTitle);
      vtkSMPropertyHelper(added.Proxy, "ComponentTitle").Set("");
      vtkSMPropertyHelper(added.Proxy, "AutomaticLabelFormat").Set(0);
      vtkSMPropertyHelper(added.Proxy, "LabelFormat").Set(colors->BarNumbers);
      vtkSMPropertyHelper(added.Proxy, "RangeLabelFormat").Set(colors->BarNumbers);
      added.Proxy->UpdateVTKObjects();
    }
  }
}
}

//------------------------------------------------------------------------------
void SetColorsAroundZero(vtkSMProxy* filter, const ColorsAroundZero& colors)
{
  if (vtkSMProxy* const function = NewTransferFunctionOf(colors.Array, filter))
  {
    if (colors.Preset)
    {
      vtkSMTransferFunctionProxy::ApplyPreset(function, colors.Preset, true);
    }
    constexpr double Land[] = { 0.72, 0.68, 0.55 }; // where there is no number: ParaView's yellow would be read as one
    vtkSMPropertyHelper(function, "NanColor").Set(Land, 3);
    vtkSMPropertyHelper(function, "AutomaticRescaleRangeMode").Set(Never);
    vtkSMPropertyHelper(function, "ScalarRangeInitialized").Set(1); // else it is that of the first data
    function->UpdateVTKObjects();
    function->SetAnnotation(Half, "0");
  }
}

//------------------------------------------------------------------------------
void FitColorsAroundZero(vtkSMProxy* filter, const ColorsAroundZero& colors)
{
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  after->SetClientData(const_cast<ColorsAroundZero*>(&colors));
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
  WithTitles().insert(&colors);
  static const vtkNew<vtkCallbackCommand> afterRegistration; // for all filters of a session
  afterRegistration->SetCallback(AfterRegistration);
  filter->GetSessionProxyManager()->RemoveObserver(afterRegistration);
  filter->GetSessionProxyManager()->AddObserver(vtkCommand::RegisterEvent, afterRegistration);
}
