#include "ChartsOfFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkWeakPointer.h"

namespace
{
struct Charts
{
  vtkWeakPointer<vtkSMProxy> Filter; // the manager outlives it
  ChartFunction Function;
};

// Views use the representations that they show.
void AfterUpdate(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const representation = vtkSMProxy::SafeDownCast(caller);
  auto* const filter = vtkSMSourceProxy::SafeDownCast(vtkSMPropertyHelper(representation, "Input").GetAsProxy());
  for (unsigned int index = 0; filter && index < representation->GetNumberOfConsumers(); ++index)
  {
    auto* const view = vtkSMViewProxy::SafeDownCast(representation->GetConsumerProxy(index));
    if (view && view->GetProperty("BottomAxisLabels"))
    {
      static_cast<Charts*>(data)->Function(filter, representation, view);
    }
  }
}

void Observe(vtkObject* subject, unsigned long event, void (*callback)(vtkObject*, unsigned long, void*, void*),
  const Charts& charts)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(callback);
  command->SetClientData(new Charts(charts));
  command->SetClientDataDeleteCallback([](void* data) { delete static_cast<Charts*>(data); });
  subject->AddObserver(event, command);
}

// Waits for representations of the filter. There is none yet when it is updated for the first time.
void AfterRegistration(vtkObject*, unsigned long, void* data, void* registered)
{
  const Charts& charts = *static_cast<Charts*>(data);
  vtkSMProxy* const proxy = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(registered)->Proxy;
  if (charts.Filter && proxy && proxy->IsA("vtkSMRepresentationProxy") &&
    vtkSMPropertyHelper(proxy, "Input", true).GetAsProxy() == charts.Filter)
  {
    Observe(proxy, vtkCommand::UpdateDataEvent, AfterUpdate, charts);
  }
}
}

void AfterUpdatesOfCharts(vtkSMProxy* filter, ChartFunction function)
{
  Observe(filter->GetSessionProxyManager(), vtkCommand::RegisterEvent, AfterRegistration, { filter, function });
}
