#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <string>

namespace
{
// Says it, unless it is what was said last.
void AfterUpdate(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* const said = static_cast<std::string*>(data);
  auto* const filter = vtkSMProxy::SafeDownCast(caller);
  filter->UpdatePropertyInformation(filter->GetProperty("Followed"));
  const char* const found = vtkSMPropertyHelper(filter, "Followed").GetAsString();
  const std::string followed = found ? found : "";
  if (!followed.empty() && followed != *said)
  {
    const char* const name = filter->GetLogName();
    vtkOutputWindowDisplayText(
      (std::string(name ? name : filter->GetXMLLabel()) + ": the field follows " + followed + "\n").c_str());
  }
  *said = followed;
}
}

//------------------------------------------------------------------------------
void WatchFollowed(vtkSMProxy* filter)
{
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterUpdate);
  after->SetClientData(new std::string);
  after->SetClientDataDeleteCallback([](void* data) { delete static_cast<std::string*>(data); });
  filter->AddObserver(vtkCommand::UpdateDataEvent, after);
}
