#include "vtkSMDirectionsInitializationHelper.h"

#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

#include <cstdlib>
#include <string>
#include <vector>

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

// The vectors of the list that may be a field, as indices of the list.
std::vector<unsigned int> FieldsOf(vtkSMArrayListDomain* list, vtkSMSourceProxy* input, unsigned int port)
{
  const std::string none = list->GetNoneString() ? list->GetNoneString() : "";
  std::vector<unsigned int> fields;
  for (unsigned int k = 0; k < list->GetNumberOfStrings(); ++k)
  {
    const std::string name = list->GetString(k);
    if (name != none && !AreNoField(input, port, list->GetFieldAssociation(k), name))
    {
      fields.push_back(k);
    }
  }
  return fields;
}
}

//------------------------------------------------------------------------------
void vtkSMDirectionsInitializationHelper::PostInitializeProxy(
  vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised)
{
  const vtkSMPropertyHelper connection(filter, "Input");
  auto* const input =
    connection.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(connection.GetAsProxy()) : nullptr;
  vtkSMProperty* const property = filter->GetProperty("Directions");
  auto* const list = property->FindDomain<vtkSMArrayListDomain>();
  if (!input || !list || property->GetMTime() > initialised) // a script has chosen
  {
    return;
  }
  property->ResetToDomainDefaults(); // ParaView would do so later on, unless the property is modified here
  vtkSMPropertyHelper directions(filter, "Directions");
  const unsigned int port = connection.GetOutputPort();
  const std::vector<unsigned int> fields = FieldsOf(list, input, port);
  const bool isChosen = !AreNoField(input, port, std::atoi(directions.GetAsString(3)), directions.GetAsString(4));
  if (std::string(hint->GetAttributeOrEmpty("choice")) == "only" ? fields.size() == 1 : !isChosen && !fields.empty())
  {
    directions.SetInputArrayToProcess(list->GetFieldAssociation(fields[0]), list->GetString(fields[0]));
    filter->UpdateVTKObjects();
  }
}
