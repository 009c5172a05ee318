#include "vtkSMHiddenDrawingsInitializationHelper.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSourceProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMHiddenDrawingsInitializationHelper);

namespace
{
struct Hiding
{
  bool HidesOutputs; // else lines on the surface alone
  bool IsDone = false;
};

// Of what shows the source of a filter.
void Hide(vtkSMProxy* shown, bool isInput, bool hidesOutputs)
{
  if (isInput)
  {
    vtkSMPropertyHelper representation(shown, "Representation", true);
    const char* const type = representation.GetAsString(); // null of a selection
    if (type && type == std::string("Field Lines"))
    {
      representation.Set("Surface");
    }
  }
  else if (hidesOutputs)
  {
    vtkSMPropertyHelper(shown, "Visibility", true).Set(0);
  }
  shown->UpdateVTKObjects();
}

// Once the filter has data.
void AfterUpdate(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  auto& hiding = *static_cast<Hiding*>(data);
  vtkSMProxy* const source = vtkSMPropertyHelper(filter, "Input").GetAsProxy();
  if (hiding.IsDone || !source || filter->GetDataInformation(0)->GetNumberOfPoints() == 0)
  {
    return;
  }
  hiding.IsDone = true;
  for (unsigned int index = 0; index < source->GetNumberOfConsumers(); ++index)
  {
    vtkSMProxy* const consumer = source->GetConsumerProxy(index); // null once it is deleted
    vtkSMProxy* const shown = consumer ? consumer->GetTrueParentProxy() : nullptr;
    if (shown && shown->IsA("vtkSMRepresentationProxy"))
    {
      const vtkSMPropertyHelper input(shown, "Input", true), taken(filter, "Input");
      Hide(shown, input.GetOutputPort() == taken.GetOutputPort(), hiding.HidesOutputs);
    }
  }
}
}

//------------------------------------------------------------------------------
void vtkSMHiddenDrawingsInitializationHelper::PostInitializeProxy(
  vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType)
{
  if (!vtkSMProxyManager::GetProxyManager()->GetUndoStackBuilder()) // which the window has
  {
    return;
  }
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  after->SetClientData(new Hiding{ std::string(hint->GetAttributeOrEmpty("of")) != "surface" });
  after->SetClientDataDeleteCallback([](void* data) { delete static_cast<Hiding*>(data); });
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
