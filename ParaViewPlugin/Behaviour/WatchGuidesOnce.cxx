#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPVXMLElement.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace
{
using Output = std::pair<vtkSMProxy*, unsigned int>; // a source and its port

// The lists of a filter.
std::vector<vtkSMInputProperty*> ListsOf(vtkSMProxy* filter)
{
  std::vector<vtkSMInputProperty*> lists;
  const auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(filter->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    auto* const input = vtkSMInputProperty::SafeDownCast(properties->GetProperty());
    vtkPVXMLElement* const hints = input ? input->GetHints() : nullptr;
    if (hints && hints->FindNestedElementByName("ChosenOnce"))
    {
      lists.push_back(input);
    }
  }
  return lists;
}

// The panel keeps what is chosen as unchecked values until it is applied.
std::vector<Output> ChosenIn(vtkSMInputProperty* list)
{
  std::vector<Output> chosen;
  for (unsigned int index = 0; index < list->GetNumberOfUncheckedProxies(); ++index)
  {
    if (vtkSMProxy* const source = list->GetUncheckedProxy(index))
    {
      chosen.emplace_back(source, list->GetUncheckedOutputPortForConnection(index));
    }
  }
  return chosen;
}

// Without unchecked values a property has its checked ones, so that a null stands for no choice.
void Choose(std::vector<Output> chosen, vtkSMInputProperty* list)
{
  if (chosen.empty())
  {
    chosen.emplace_back(nullptr, 0);
  }
  const auto size = static_cast<unsigned int>(chosen.size());
  list->SetNumberOfUncheckedProxies(size);
  for (unsigned int index = 0; index < size; ++index)
  {
    list->SetUncheckedInputConnection(index, chosen[index].first, chosen[index].second);
  }
}

void AfterChoice(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const list = vtkSMInputProperty::SafeDownCast(caller);
  const std::vector<Output> chosen = ChosenIn(list);
  const auto isChosen = [&](const Output& output)
  { return std::find(chosen.begin(), chosen.end(), output) != chosen.end(); };
  for (vtkSMInputProperty* const other : ListsOf(list->GetParent()))
  {
    std::vector<Output> kept = ChosenIn(other);
    const auto first = std::remove_if(kept.begin(), kept.end(), isChosen);
    if (other != list && first != kept.end())
    {
      kept.erase(first, kept.end());
      Choose(kept, other);
    }
  }
}
}

//------------------------------------------------------------------------------
void WatchGuidesOnce(vtkSMProxy* filter)
{
  for (vtkSMInputProperty* const list : ListsOf(filter))
  {
    vtkNew<vtkCallbackCommand> after;
    after->SetCallback(AfterChoice);
    list->AddObserver(vtkCommand::UncheckedPropertyModifiedEvent, after);
  }
}
