#include "vtkPrincipalDirections.h"

#include "Adapters/Output/CurvaturesToArrays.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Adapters/Pipeline/PropertyRanges.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <utility>

vtkStandardNewMacro(vtkPrincipalDirections);

//------------------------------------------------------------------------------
int vtkPrincipalDirections::FillInputPortInformation(int, vtkInformation* information)
{
  return dmg::TakeAnyDataSet(information);
}

//------------------------------------------------------------------------------
int vtkPrincipalDirections::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return dmg::AskForInputs(this, request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkPrincipalDirections::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* const input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* const output = vtkPolyData::GetData(outputVector);
  const auto make = [&](const dmg::ExecutionContext& context)
  {
    dmg::CheckRanges({ { "Scale", this->Scale, 0, 100 } });
    dmg::SurfaceMesh surface =
      dmg::MeshFromPolyData(input, dmg::Numbering::Spatial, dmg::PartOfContext(context, 0.0, 0.3));
    const dmg::FramedMesh framed(std::move(surface.Mesh), dmg::PartOfContext(context, 0.3, 0.3));
    const dmg::PrincipalDirections found =
      dmg::FindPrincipalDirections(framed, this->Scale, dmg::PartOfContext(context, 0.3, 0.9));
    output->ShallowCopy(input);
    dmg::AddCurvatures({ framed, surface }, found, input, output, dmg::PartOfContext(context, 0.9, 1.0));
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkPrincipalDirections::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scale: " << this->Scale << "\n";
}
