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

#include <cstdlib>
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
void vtkSMDirectionsInitializationHelper::PostInitializeProxy(
  vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType initialised)
{
  const vtkSMPropertyHelper connection(filter, "Input");
  auto* const input =
    connection.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(connection.GetAsProxy()) : nullptr;
  vtkSMProperty* const property = filter->GetProperty("Directions");
  auto* const domain = property->FindDomain<vtkSMArrayListDomain>();
  if (!input || !domain || property->GetMTime() > initialised) // a script has chosen
  {
    return;
  }
  property->ResetToDomainDefaults(); // ParaView would do so later on, unless the property is modified here
  vtkSMPropertyHelper directions(filter, "Directions");
  const unsigned int port = connection.GetOutputPort();
  if (!AreNoField(input, port, std::atoi(directions.GetAsString(3)), directions.GetAsString(4)))
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
