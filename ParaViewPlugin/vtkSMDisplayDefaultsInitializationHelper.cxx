#include "vtkSMDisplayDefaultsInitializationHelper.h"

#include "vtkCallbackCommand.h"
#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMBoundsDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <set>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMDisplayDefaultsInitializationHelper);

namespace
{
// Sizes are shares of the bounds' extent, and the bounds of nothing are 1 to -1.
bool IsSizeOfNothing(vtkSMProperty* property)
{
  auto* const domain = property->FindDomain<vtkSMBoundsDomain>();
  return domain && domain->GetMinimum(0) >= 0 && vtkSMPropertyHelper(property).GetAsDouble() < 0;
}

bool IsNoArray(vtkSMProperty* property)
{
  auto* const value = vtkSMStringVectorProperty::SafeDownCast(property);
  if (!value || !property->FindDomain<vtkSMArrayListDomain>() || value->GetNumberOfElements() == 0)
  {
    return false;
  }
  const std::string name = value->GetElement(value->GetNumberOfElements() - 1); // the name is last
  return name.empty() || name == "None";
}

void DeriveDefaultsAgain(vtkSMProxy* representation, vtkSMSourceProxy* filter)
{
  std::vector<vtkSMProperty*> defaults;
  bool hadNoData = false; // else "None" is somebody's choice among the arrays
  const auto properties =
    vtkSmartPointer<vtkSMPropertyIterator>::Take(representation->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    vtkSMProperty* const property = properties->GetProperty();
    const bool isSizeOfNothing = IsSizeOfNothing(property);
    hadNoData = hadNoData || isSizeOfNothing;
    if (isSizeOfNothing || IsNoArray(property))
    {
      defaults.push_back(property);
    }
  }
  const unsigned int port = vtkSMPropertyHelper(representation, "Input", true).GetOutputPort();
  if (hadNoData && filter->GetDataInformation(port)->GetNumberOfPoints() > 0)
  {
    for (vtkSMProperty* const property : defaults)
    {
      property->ResetToDomainDefaults();
    }
    representation->UpdateVTKObjects();
    // A view that is about to render has just updated its representations, and has to do so again.
    for (unsigned int index = 0; index < representation->GetNumberOfConsumers(); ++index)
    {
      if (auto* const view = vtkSMViewProxy::SafeDownCast(representation->GetConsumerProxy(index)))
      {
        view->Update();
      }
    }
  }
}

void OnUpdate(vtkObject* caller, unsigned long, void*, void*)
{
  vtkSMSourceProxy* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  std::set<vtkSMProxy*> representations; // each once, although its parts use the filter, too
  for (unsigned int index = 0; index < filter->GetNumberOfConsumers(); ++index)
  {
    vtkSMProxy* const consumer = filter->GetConsumerProxy(index); // null once it is deleted
    vtkSMProxy* const whole = consumer ? consumer->GetTrueParentProxy() : nullptr;
    if (whole && whole->IsA("vtkSMRepresentationProxy"))
    {
      representations.insert(whole);
    }
  }
  for (vtkSMProxy* const representation : representations)
  {
    DeriveDefaultsAgain(representation, filter);
  }
}
}

//------------------------------------------------------------------------------
void vtkSMDisplayDefaultsInitializationHelper::Register()
{
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(
    [](vtkClientServerInterpreter* interpreter)
    {
      interpreter->AddNewInstanceFunction("vtkSMDisplayDefaultsInitializationHelper",
        [](void*) -> vtkObjectBase* { return vtkSMDisplayDefaultsInitializationHelper::New(); });
    });
}

//------------------------------------------------------------------------------
void vtkSMDisplayDefaultsInitializationHelper::PostInitializeProxy(
  vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(OnUpdate);
  const float priority = -1; // after the representations have taken over the new bounds and arrays
  filter->AddObserver(vtkCommand::UpdateDataEvent, command, priority);
}
