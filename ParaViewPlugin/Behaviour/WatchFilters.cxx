#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPVXMLElement.h"
#include "vtkProcessModule.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSession.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSessionIterator.h"
#include "vtkSmartPointer.h"
#include "vtkStringList.h"

#include <map>
#include <string>

namespace
{
void Watch(vtkSMProxy* filter, const std::string& what)
{
  static const std::map<std::string, void (*)(vtkSMProxy*)> watches{ { "Boxes", WatchBoxes },
    { "CenteredColors", WatchCenteredColors }, { "ChosenPoint", WatchChosenPoint },
    { "CyclicColors", WatchCyclicColors }, { "DeletedInputs", WatchDeletedInputs }, { "Followed", WatchFollowed },
    { "GuidesFirst", WatchGuidesFirst }, { "GuidesOnce", WatchGuidesOnce }, { "Summary", WatchSummary } };
  const auto watch = watches.find(what);
  if (watch != watches.end())
  {
    watch->second(filter);
  }
}

// A filter that gets another name is registered under both for a while, and is watched already.
void AfterRegistration(vtkObject* caller, unsigned long, void*, void* registered)
{
  const auto& added = *static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(registered);
  vtkPVXMLElement* const hints = added.Proxy ? added.Proxy->GetHints() : nullptr;
  if (!hints || std::string(added.GroupName) != "sources")
  {
    return;
  }
  vtkNew<vtkStringList> names;
  vtkSMSessionProxyManager::SafeDownCast(caller)->GetProxyNames(added.GroupName, added.Proxy, names);
  for (unsigned int k = 0; names->GetLength() == 1 && k < hints->GetNumberOfNestedElements(); ++k)
  {
    vtkPVXMLElement* const hint = hints->GetNestedElement(k);
    if (std::string(hint->GetName()) == "Watch")
    {
      Watch(added.Proxy, hint->GetAttributeOrEmpty("for"));
    }
  }
}

// Servers, and ranks but the first, have no proxies. A session that is reset is another connection.
void WatchSession(vtkSession* session)
{
  static const vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterRegistration);
  auto* const ofClient = vtkSMSession::SafeDownCast(session);
  if (vtkSMSessionProxyManager* const proxies = ofClient ? ofClient->GetSessionProxyManager() : nullptr)
  {
    proxies->RemoveObserver(after);
    proxies->AddObserver(vtkCommand::RegisterEvent, after);
  }
}

void AfterConnection(vtkObject* caller, unsigned long, void*, void* session)
{
  WatchSession(vtkProcessModule::SafeDownCast(caller)->GetSession(*static_cast<vtkIdType*>(session)));
}
}

//------------------------------------------------------------------------------
void WatchFilters()
{
  vtkProcessModule* const process = vtkProcessModule::GetProcessModule();
  const auto sessions = vtkSmartPointer<vtkSessionIterator>::Take(process->NewSessionIterator());
  for (sessions->InitTraversal(); !sessions->IsDoneWithTraversal(); sessions->GoToNextItem())
  {
    WatchSession(sessions->GetCurrentSession());
  }
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterConnection);
  process->AddObserver(vtkCommand::ConnectionCreatedEvent, after);
}
