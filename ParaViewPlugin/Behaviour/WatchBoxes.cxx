#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSmartPointer.h"

namespace
{
struct Switch
{
  vtkSMProperty* Box;
  vtkSMProperty* Weight;
  double Last = 1.0; // weight that was not 0
};

// Of the values that the panel shows, which are unchecked, or of those that are applied.
void Agree(Switch& pair, bool weightDecides, bool ofPanel)
{
  vtkSMPropertyHelper box(pair.Box), weight(pair.Weight);
  box.SetUseUnchecked(ofPanel);
  weight.SetUseUnchecked(ofPanel);
  const double value = weight.GetAsDouble();
  const bool isOn = box.GetAsInt() != 0;
  pair.Last = value > 0.0 ? value : pair.Last;
  if (isOn != value > 0.0)
  {
    weightDecides ? box.Set(isOn ? 0 : 1) : weight.Set(isOn ? pair.Last : 0.0);
  }
}

void AfterChange(vtkObject* caller, unsigned long event, void* data, void*)
{
  auto& pair = *static_cast<Switch*>(data);
  Agree(pair, caller == pair.Weight, event == vtkCommand::UncheckedPropertyModifiedEvent);
}
}

//------------------------------------------------------------------------------
void WatchBoxes(vtkSMProxy* filter)
{
  const auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(filter->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    vtkSMProperty* const box = properties->GetProperty();
    vtkPVXMLElement* const hints = box->GetHints();
    vtkPVXMLElement* const hint = hints ? hints->FindNestedElementByName("Switches") : nullptr;
    if (!hint)
    {
      continue;
    }
    vtkNew<vtkCallbackCommand> after;
    after->SetCallback(AfterChange);
    after->SetClientData(new Switch{ box, filter->GetProperty(hint->GetAttributeOrEmpty("property")) });
    after->SetClientDataDeleteCallback([](void* data) { delete static_cast<Switch*>(data); });
    auto& pair = *static_cast<Switch*>(after->GetClientData());
    for (vtkSMProperty* const property : { pair.Box, pair.Weight })
    {
      property->AddObserver(vtkCommand::ModifiedEvent, after);
      property->AddObserver(vtkCommand::UncheckedPropertyModifiedEvent, after);
    }
    // A script may have set the box, and a state of former versions knows the weight alone.
    Agree(pair, pair.Box->IsValueDefault() || !pair.Weight->IsValueDefault(), false);
  }
  filter->UpdateVTKObjects();
}
