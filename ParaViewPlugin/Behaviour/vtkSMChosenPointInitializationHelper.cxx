#include "vtkSMChosenPointInitializationHelper.h"

#include "vtkBoundingBox.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

vtkStandardNewMacro(vtkSMChosenPointInitializationHelper);

//------------------------------------------------------------------------------
void vtkSMChosenPointInitializationHelper::PostInitializeProxy(
  vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType initialised)
{
  const vtkSMPropertyHelper connection(filter, "Input");
  auto* const input =
    connection.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(connection.GetAsProxy()) : nullptr;
  vtkBoundingBox bounds;
  if (input)
  {
    bounds.SetBounds(input->GetDataInformation(connection.GetOutputPort())->GetBounds());
  }
  if (filter->GetProperty("Point")->GetMTime() > initialised)
  {
    vtkSMPropertyHelper(filter, "UsePoint").Set(1);
  }
  else if (bounds.IsValid())
  {
    double front[3];
    bounds.GetCenter(front);
    front[2] = bounds.GetBound(5);
    vtkSMPropertyHelper(filter, "Point").Set(front, 3);
  }
  filter->UpdateVTKObjects();
}
