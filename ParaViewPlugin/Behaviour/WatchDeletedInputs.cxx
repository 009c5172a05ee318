#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSmartPointer.h"
#include "vtkStringList.h"
#include "vtkWeakPointer.h"

#include <string>

namespace
{
using Registration = vtkSMProxyManager::RegisteredProxyInformation;

// A source that gets another name is registered under both for a while.
bool HasOtherName(vtkSMSessionProxyManager* proxies, const Registration& removed)
{
  vtkNew<vtkStringList> names;
  proxies->GetProxyNames(removed.GroupName, removed.Proxy, names);
  for (int k = 0; k < names->GetLength(); ++k)
  {
    if (std::string(names->GetString(k)) != removed.ProxyName)
    {
      return true;
    }
  }
  return false;
}

void BeforeUnregistration(vtkObject* proxies, unsigned long, void* data, void* unregistered)
{
  const auto& filter = *static_cast<vtkWeakPointer<vtkSMProxy>*>(data);
  const auto& removed = *static_cast<Registration*>(unregistered);
  if (!filter || !removed.Proxy || removed.Proxy == filter || std::string(removed.GroupName) != "sources" ||
    HasOtherName(vtkSMSessionProxyManager::SafeDownCast(proxies), removed))
  {
    return;
  }
  const auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(filter->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    auto* const input = vtkSMInputProperty::SafeDownCast(properties->GetProperty());
    for (unsigned int index = 0; input && input->GetPortIndex() > 0 && index < input->GetNumberOfProxies();)
    {
      if (input->GetProxy(index) == removed.Proxy)
      {
        input->RemoveProxy(removed.Proxy);
        index = 0;
      }
      else
      {
        ++index;
      }
    }
  }
  filter->UpdateVTKObjects();
}
}

//------------------------------------------------------------------------------
void WatchDeletedInputs(vtkSMProxy* filter)
{
  vtkNew<vtkCallbackCommand> before;
  before->SetCallback(BeforeUnregistration);
  before->SetClientData(new vtkWeakPointer<vtkSMProxy>(filter)); // the manager outlives it
  before->SetClientDataDeleteCallback([](void* data) { delete static_cast<vtkWeakPointer<vtkSMProxy>*>(data); });
  constexpr float BeforeWindow = 1e6f; // which takes what it knows of the source away
  filter->GetSessionProxyManager()->AddObserver(vtkCommand::UnRegisterEvent, before, BeforeWindow);
}
