#include "vtkSMDisplayDefaultsInitializationHelper.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMBoundsDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"
#include "vtkVariant.h"

#include <map>
#include <set>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMDisplayDefaultsInitializationHelper);

namespace
{
// What is remembered of a filter between its updates.
struct Memory
{
  std::map<unsigned int, bool> HadPoints; // for each output port, in any update so far
  std::map<vtkSmartPointer<vtkSMProxy>, std::vector<vtkSMProperty*>> DefaultsOfNothing;

  bool IsWithoutPoints(unsigned int port) const
  {
    const auto found = this->HadPoints.find(port); // else there was no update
    return found != this->HadPoints.end() && !found->second;
  }
};

std::set<vtkSMProxy*> RepresentationsOf(vtkSMSourceProxy* filter)
{
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
  return representations;
}

unsigned int PortOf(vtkSMProxy* representation)
{
  return vtkSMPropertyHelper(representation, "Input", true).GetOutputPort();
}

bool IsNoArray(vtkSMProperty* property)
{
  const vtkSMPropertyHelper value(property);
  const unsigned int elements = value.GetNumberOfElements();
  const std::string name = elements == 0 ? "None" : value.GetAsString(elements - 1); // the last one
  return name.empty() || name == "None";
}

// Does the property have the value that the data, as they are now, suggest?
bool HasDefaultOfData(vtkSMProperty* property)
{
  const bool isArray = property->FindDomain<vtkSMArrayListDomain>();
  if (!isArray && !property->FindDomain<vtkSMBoundsDomain>())
  {
    return false;
  }
  constexpr bool IntoUncheckedValues = true; // beside those that it has
  if (!property->ResetToDomainDefaults(IntoUncheckedValues))
  {
    return isArray && IsNoArray(property); // which ParaView 6 does not suggest where there are none
  }
  vtkSMPropertyHelper value(property), suggested(property);
  suggested.SetUseUnchecked(true);
  bool same = value.GetNumberOfElements() == suggested.GetNumberOfElements();
  for (unsigned int element = 0; same && element < value.GetNumberOfElements(); ++element)
  {
    same = value.GetAsVariant(element) == suggested.GetAsVariant(element);
  }
  property->ClearUncheckedElements();
  return same;
}

std::vector<vtkSMProperty*> PropertiesWithDefaultsOfData(vtkSMProxy* representation)
{
  std::vector<vtkSMProperty*> found;
  const auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(representation->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    if (HasDefaultOfData(properties->GetProperty()))
    {
      found.push_back(properties->GetProperty());
    }
  }
  return found;
}

// The representations still know the bounds and arrays of the last update.
void BeforeRepresentations(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const memory = static_cast<Memory*>(data);
  memory->DefaultsOfNothing.clear();
  for (vtkSMProxy* const representation : RepresentationsOf(vtkSMSourceProxy::SafeDownCast(caller)))
  {
    if (memory->IsWithoutPoints(PortOf(representation)))
    {
      memory->DefaultsOfNothing[representation] = PropertiesWithDefaultsOfData(representation);
    }
  }
}

// They know those of this one.
void AfterRepresentations(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const memory = static_cast<Memory*>(data);
  auto* const filter = vtkSMSourceProxy::SafeDownCast(caller);
  for (unsigned int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    bool& hadPoints = memory->HadPoints[port];
    hadPoints = hadPoints || filter->GetDataInformation(port)->GetNumberOfPoints() > 0;
  }
  std::map<vtkSmartPointer<vtkSMProxy>, std::vector<vtkSMProperty*>> defaults;
  defaults.swap(memory->DefaultsOfNothing); // a view that updates below comes here again
  for (const auto& [representation, properties] : defaults)
  {
    if (memory->IsWithoutPoints(PortOf(representation)))
    {
      continue;
    }
    for (vtkSMProperty* const property : properties)
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
}

//------------------------------------------------------------------------------
void vtkSMDisplayDefaultsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  auto* const memory = new Memory;
  vtkNew<vtkCallbackCommand> before;
  before->SetCallback(BeforeRepresentations);
  before->SetClientData(memory);
  before->SetClientDataDeleteCallback([](void* data) { delete static_cast<Memory*>(data); });
  filter->AddObserver(vtkCommand::UpdateDataEvent, before, 1.0f);

  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterRepresentations);
  after->SetClientData(memory);
  filter->AddObserver(vtkCommand::UpdateDataEvent, after, -1.0f);
}
