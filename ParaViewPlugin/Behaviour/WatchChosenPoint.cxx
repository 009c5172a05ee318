#include "Watches.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkProcessModule.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <cmath>

namespace
{
void AfterPoint(vtkObject* caller, unsigned long, void*, void*)
{
  vtkSMPropertyHelper(vtkSMProperty::SafeDownCast(caller)->GetParent(), "UsePoint").Set(1);
}

void AfterUpdate(vtkObject* caller, unsigned long, void*, void*)
{
  auto* const filter = vtkSMProxy::SafeDownCast(caller);
  filter->UpdatePropertyInformation(filter->GetProperty("PointOnSurface"));
  double point[3];
  vtkSMPropertyHelper(filter, "PointOnSurface").Get(point, 3);
  if (!vtkSMPropertyHelper(filter, "UsePoint").GetAsInt() && std::isfinite(point[0]))
  {
    vtkSMPropertyHelper(filter, "Point").Set(point, 3); // the filter hears of it with the next change, and runs once
  }
}
}

//------------------------------------------------------------------------------
void WatchChosenPoint(vtkSMProxy* filter)
{
  vtkNew<vtkCallbackCommand> afterPoint;
  afterPoint->SetCallback(AfterPoint);
  filter->GetProperty("Point")->AddObserver(vtkCommand::ModifiedEvent, afterPoint);

  // In symmetric mode each rank has properties of its own, and the first one alone knows the point.
  if (!vtkProcessModule::GetProcessModule()->GetSymmetricMPIMode())
  {
    vtkNew<vtkCallbackCommand> afterUpdate;
    afterUpdate->SetCallback(AfterUpdate);
    filter->AddObserver(vtkCommand::UpdateDataEvent, afterUpdate);
  }
}
