#include "vtkSMHiddenDrawingsInitializationHelper.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSourceProxy.h"

vtkStandardNewMacro(vtkSMHiddenDrawingsInitializationHelper);

namespace
{
// Hides the other outputs of the source once the filter has data.
void AfterUpdate(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  bool& isDone = *static_cast<bool*>(data);
  vtkSMProxy* const source = vtkSMPropertyHelper(filter, "Input").GetAsProxy();
  if (isDone || !source || filter->GetDataInformation(0)->GetNumberOfPoints() == 0)
  {
    return;
  }
  isDone = true;
  for (unsigned int index = 0; index < source->GetNumberOfConsumers(); ++index)
  {
    vtkSMProxy* const consumer = source->GetConsumerProxy(index); // null once it is deleted
    vtkSMProxy* const shown = consumer ? consumer->GetTrueParentProxy() : nullptr;
    if (shown && shown->IsA("vtkSMRepresentationProxy") &&
      vtkSMPropertyHelper(shown, "Input", true).GetOutputPort() != vtkSMPropertyHelper(filter, "Input").GetOutputPort())
    {
      vtkSMPropertyHelper(shown, "Visibility", true).Set(0);
      shown->UpdateVTKObjects();
    }
  }
}
}

//------------------------------------------------------------------------------
void vtkSMHiddenDrawingsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  if (!vtkSMProxyManager::GetProxyManager()->GetUndoStackBuilder()) // which the window has
  {
    return;
  }
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  after->SetClientData(new bool(false));
  after->SetClientDataDeleteCallback([](void* data) { delete static_cast<bool*>(data); });
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
