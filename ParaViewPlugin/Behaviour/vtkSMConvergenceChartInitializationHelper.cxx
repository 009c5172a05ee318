#include "vtkSMConvergenceChartInitializationHelper.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkWeakPointer.h"

#include <string>

vtkStandardNewMacro(vtkSMConvergenceChartInitializationHelper);

namespace
{
const std::string TitleBelow = "iteration";
const std::string TitleAtTheLeft = "log10 of the relative residual";

// Of 1, 2, 5, 10, 20, 50 and so on the first that makes at most ten steps.
vtkIdType StepOf(vtkIdType iterations)
{
  vtkIdType power = 1;
  while (iterations > 100 * power)
  {
    power *= 10;
  }
  for (const vtkIdType factor : { 1, 2, 5 })
  {
    if (iterations <= 10 * factor * power)
    {
      return factor * power;
    }
  }
  return 10 * power;
}

bool IsTitle(vtkSMProxy* view, const char* property, const std::string& title)
{
  const char* const text = vtkSMPropertyHelper(view, property).GetAsString();
  return (text ? text : "") == title;
}

void SetTitle(vtkSMProxy* view, const char* property, const std::string& title)
{
  if (IsTitle(view, property, ""))
  {
    vtkSMPropertyHelper(view, property).Set(title.c_str());
  }
}

void LabelAxes(vtkSMProxy* view, vtkIdType iterations)
{
  SetTitle(view, "BottomAxisTitle", TitleBelow);
  SetTitle(view, "LeftAxisTitle", TitleAtTheLeft);
  if (IsTitle(view, "BottomAxisTitle", TitleBelow))
  {
    vtkSMPropertyHelper(view, "BottomAxisUseCustomLabels").Set(1);
    vtkSMPropertyHelper labels(view, "BottomAxisLabels"); // pairs of a number and its text
    const vtkIdType step = StepOf(iterations);
    labels.SetNumberOfElements(2 * static_cast<unsigned int>(iterations / step + 1));
    unsigned int element = 0;
    for (vtkIdType iteration = 0; iteration <= iterations; iteration += step)
    {
      const std::string text = std::to_string(iteration);
      labels.Set(element++, text.c_str());
      labels.Set(element++, text.c_str());
    }
  }
  view->UpdateVTKObjects();
}

// Views use the representations that they show.
void AfterUpdate(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const representation = vtkSMProxy::SafeDownCast(caller);
  auto* const filter = vtkSMSourceProxy::SafeDownCast(vtkSMPropertyHelper(representation, "Input").GetAsProxy());
  const vtkIdType rows = filter ? filter->GetDataInformation(0)->GetNumberOfRows() : 0; // the first one is iteration 0
  for (unsigned int index = 0; rows > 0 && index < representation->GetNumberOfConsumers(); ++index)
  {
    auto* const view = vtkSMViewProxy::SafeDownCast(representation->GetConsumerProxy(index));
    if (view && view->GetProperty("BottomAxisLabels"))
    {
      LabelAxes(view, rows - 1);
    }
  }
}

// Waits for representations of the filter. There is none yet when it is updated for the first time.
void AfterRegistration(vtkObject*, unsigned long, void* data, void* registered)
{
  const auto& filter = *static_cast<vtkWeakPointer<vtkSMProxy>*>(data);
  vtkSMProxy* const proxy = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(registered)->Proxy;
  if (filter && proxy && proxy->IsA("vtkSMRepresentationProxy") &&
    vtkSMPropertyHelper(proxy, "Input", true).GetAsProxy() == filter)
  {
    vtkNew<vtkCallbackCommand> after;
    after->SetCallback(AfterUpdate);
    proxy->AddObserver(vtkCommand::UpdateDataEvent, after);
  }
}
}

//------------------------------------------------------------------------------
void vtkSMConvergenceChartInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterRegistration);
  after->SetClientData(new vtkWeakPointer<vtkSMProxy>(filter)); // the manager outlives it
  after->SetClientDataDeleteCallback([](void* data) { delete static_cast<vtkWeakPointer<vtkSMProxy>*>(data); });
  filter->GetSessionProxyManager()->AddObserver(vtkCommand::RegisterEvent, after);
}
