#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <string>

namespace
{
// A property that a filter says after its updates, and what it said last.
struct Sentence
{
  const char* Property;
  const char* Begin; // of the sentence
  std::string Said;
};

// Says it, unless it is what was said last.
void AfterUpdate(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const sentence = static_cast<Sentence*>(data);
  auto* const filter = vtkSMProxy::SafeDownCast(caller);
  filter->UpdatePropertyInformation(filter->GetProperty(sentence->Property));
  const char* const found = vtkSMPropertyHelper(filter, sentence->Property).GetAsString();
  const std::string now = found ? found : "";
  if (!now.empty() && now != sentence->Said)
  {
    const char* const name = filter->GetLogName();
    vtkOutputWindowDisplayText(
      (std::string(name ? name : filter->GetXMLLabel()) + ": " + sentence->Begin + now + "\n").c_str());
  }
  sentence->Said = now;
}

void Say(vtkSMProxy* filter, const Sentence& sentence)
{
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  after->SetClientData(new Sentence(sentence));
  after->SetClientDataDeleteCallback([](void* data) { delete static_cast<Sentence*>(data); });
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
}

//------------------------------------------------------------------------------
void WatchFollowed(vtkSMProxy* filter)
{
  Say(filter, { "Followed", "the field follows ", "" });
}

//------------------------------------------------------------------------------
void WatchSummary(vtkSMProxy* filter)
{
  Say(filter, { "Summary", "", "" });
}
