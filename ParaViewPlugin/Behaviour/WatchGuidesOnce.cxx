#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPVXMLElement.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <iterator>
#include <locale>
#include <sstream>
#include <string>
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

// Where the numbers of a list begin in Guide Weights: a list has one for each of its sources, and an empty one has one, too.
std::size_t FirstNumberOf(vtkSMInputProperty* list)
{
  std::size_t first = 0;
  for (vtkSMInputProperty* const other : ListsOf(list->GetParent()))
  {
    if (other->GetPortIndex() < list->GetPortIndex())
    {
      first += std::max<std::size_t>(1, ChosenIn(other).size());
    }
  }
  return first;
}

// The numbers up to that of the last source.
std::size_t UsedNumbers(vtkSMProxy* filter)
{
  std::size_t used = 0;
  for (vtkSMInputProperty* const list : ListsOf(filter))
  {
    const std::size_t size = ChosenIn(list).size();
    used = size > 0 ? std::max(used, FirstNumberOf(list) + size) : used;
  }
  return used;
}

// Two lists exchange their numbers in the panel, where only the used ones stay. The name of an array, or one number for all, stays.
void ExchangeWeights(vtkSMProxy* filter, std::size_t one, std::size_t other, std::size_t used)
{
  vtkSMPropertyHelper weights(filter, "Guide Weights");
  weights.SetUseUnchecked(true);
  std::istringstream text(weights.GetAsString());
  std::vector<std::string> words{ std::istream_iterator<std::string>(text), {} };
  const auto isNumber = [](const std::string& word)
  {
    std::istringstream reader(word);
    reader.imbue(std::locale::classic());
    double number = 0.0;
    return reader >> number && reader.eof();
  };
  if (words.size() < 2 || !std::all_of(words.begin(), words.end(), isNumber))
  {
    return;
  }
  words.resize(std::max({ words.size(), one + 1, other + 1 }), "1");
  std::swap(words[one], words[other]);
  words.resize(std::max<std::size_t>(1, used));
  std::string exchanged = words[0];
  for (std::size_t k = 1; k < words.size(); ++k)
  {
    exchanged += " " + words[k];
  }
  weights.Set(exchanged.c_str());
}

// Another list gives up what is chosen in this one. One source that goes from list to list takes its weight with it.
void AfterChoice(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const list = vtkSMInputProperty::SafeDownCast(caller);
  const std::vector<Output> chosen = ChosenIn(list);
  const auto isChosen = [&](const Output& output)
  { return std::find(chosen.begin(), chosen.end(), output) != chosen.end(); };
  for (vtkSMInputProperty* const other : ListsOf(list->GetParent()))
  {
    std::vector<Output> kept = ChosenIn(other);
    const bool isOne = kept.size() == 1 && chosen.size() == 1;
    const auto first = std::remove_if(kept.begin(), kept.end(), isChosen);
    if (other != list && first != kept.end())
    {
      kept.erase(first, kept.end());
      Choose(kept, other);
      if (isOne)
      {
        ExchangeWeights(list->GetParent(), FirstNumberOf(list), FirstNumberOf(other), UsedNumbers(list->GetParent()));
      }
    }
  }
}

vtkSMProxySelectionModel* SelectionOf(vtkSMProperty* property)
{
  return property->GetParent()->GetSessionProxyManager()->GetSelectionModel("ActiveSources");
}

// The window counts the connections of two outputs once, and takes the arrow of a source away when the second list gives it up after the first
// one has it. So what other lists give up goes before the window knows of this list.
void BeforeWindow(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const list = vtkSMInputProperty::SafeDownCast(caller);
  *static_cast<vtkWeakPointer<vtkSMProxy>*>(data) = SelectionOf(list)->GetCurrentProxy();
  for (vtkSMInputProperty* const other : ListsOf(list->GetParent()))
  {
    const std::vector<Output> kept = ChosenIn(other);
    bool givesUp = false;
    for (unsigned int index = 0; other != list && index < other->GetNumberOfProxies(); ++index)
    {
      const Output output(other->GetProxy(index), other->GetOutputPortForConnection(index));
      const bool isKept = std::find(kept.begin(), kept.end(), output) != kept.end();
      for (unsigned int k = 0; !isKept && k < list->GetNumberOfProxies(); ++k)
      {
        givesUp = givesUp || output == Output(list->GetProxy(k), list->GetOutputPortForConnection(k));
      }
    }
    if (givesUp)
    {
      vtkSMPropertyHelper connections(other);
      connections.RemoveAllValues();
      for (const auto& [source, port] : kept)
      {
        connections.Add(source, port);
      }
    }
  }
}

// The window selects something else while an item of the pipeline changes its place.
void AfterWindow(vtkObject* caller, unsigned long, void* data, void*)
{
  vtkSMProxySelectionModel* const selection = SelectionOf(vtkSMInputProperty::SafeDownCast(caller));
  vtkSMProxy* const former = *static_cast<vtkWeakPointer<vtkSMProxy>*>(data);
  if (former && selection->GetCurrentProxy() != former)
  {
    selection->SetCurrentProxy(former, vtkSMProxySelectionModel::CLEAR_AND_SELECT);
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
    vtkNew<vtkCallbackCommand> before;
    before->SetCallback(BeforeWindow);
    before->SetClientData(new vtkWeakPointer<vtkSMProxy>); // what is selected before
    before->SetClientDataDeleteCallback([](void* data) { delete static_cast<vtkWeakPointer<vtkSMProxy>*>(data); });
    constexpr float First = 1e6f;
    list->AddObserver(vtkCommand::ModifiedEvent, before, First);
    vtkNew<vtkCallbackCommand> afterWindow;
    afterWindow->SetCallback(AfterWindow);
    afterWindow->SetClientData(before->GetClientData());
    list->AddObserver(vtkCommand::ModifiedEvent, afterWindow, -First);
  }
}
