#include "vtkSMDirectionsInitializationHelper.h"

#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMDirectionsInitializationHelper);

namespace
{
// Normals and texture coordinates: arrays that are marked so, or are called so.
bool AreNoField(vtkSMSourceProxy* input, unsigned int port, int association, const std::string& name)
{
  vtkPVDataSetAttributesInformation* const arrays =
    input->GetDataInformation(port)->GetAttributeInformation(association);
  const auto areActive = [&](int attribute)
  {
    vtkPVArrayInformation* const active = arrays ? arrays->GetAttributeInformation(attribute) : nullptr;
    return active && active->GetName() && name == active->GetName();
  };
  return name == "Normals" || areActive(vtkDataSetAttributes::NORMALS) || areActive(vtkDataSetAttributes::TCOORDS);
}
}

//------------------------------------------------------------------------------
void vtkSMDirectionsInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  const vtkSMPropertyHelper connection(filter, "Input");
  auto* const input =
    connection.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(connection.GetAsProxy()) : nullptr;
  auto* const domain = filter->GetProperty("Directions")->FindDomain<vtkSMArrayListDomain>();
  vtkSMPropertyHelper directions(filter, "Directions");
  if (!input || !domain || directions.GetNumberOfElements() < 5)
  {
    return;
  }
  const unsigned int port = connection.GetOutputPort();
  if (!AreNoField(input, port, directions.GetAsInt(3), directions.GetAsString(4)))
  {
    return;
  }
  for (unsigned int k = 0; k < domain->GetNumberOfStrings(); ++k)
  {
    const int association = domain->GetFieldAssociation(k);
    if (!AreNoField(input, port, association, domain->GetString(k)))
    {
      directions.SetInputArrayToProcess(association, domain->GetString(k));
      filter->UpdateVTKObjects();
      return;
    }
  }
}
