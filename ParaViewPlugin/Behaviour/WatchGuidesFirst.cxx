#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMVectorProperty.h"
#include "vtkSmartPointer.h"

namespace
{
template <class Property, class Function>
void ForEach(vtkSMProxy* proxy, const Function& function)
{
  const auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(proxy->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    if (auto* const property = Property::SafeDownCast(properties->GetProperty()))
    {
      function(property);
    }
  }
}

// The panel keeps values as unchecked ones until they are applied.
void TakePanelValues(vtkSMProxy* proxy)
{
  for (unsigned int producer = 0; producer < proxy->GetNumberOfProducers(); ++producer)
  {
    TakePanelValues(proxy->GetProducerProxy(producer));
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", proxy);
  ForEach<vtkSMVectorProperty>(proxy,
    [](vtkSMVectorProperty* property)
    {
      if (!property->GetInformationOnly())
      {
        vtkSMPropertyHelper ofPanel(property);
        ofPanel.SetUseUnchecked(true);
        vtkSMPropertyHelper(property).Copy(ofPanel);
      }
    });
  proxy->UpdateVTKObjects();
}

void AfterProperties(vtkObject* caller, unsigned long, void*, void*)
{
  ForEach<vtkSMInputProperty>(vtkSMProxy::SafeDownCast(caller),
    [](vtkSMInputProperty* input)
    {
      for (unsigned int index = 0; input->GetPortIndex() > 0 && index < input->GetNumberOfProxies(); ++index)
      {
        TakePanelValues(input->GetProxy(index));
      }
    });
}
}

//------------------------------------------------------------------------------
void WatchGuidesFirst(vtkSMProxy* filter)
{
  vtkNew<vtkCallbackCommand> after;
  after->SetCallback(AfterProperties);
  filter->AddObserver(vtkCommand::UpdateEvent, after);
}
