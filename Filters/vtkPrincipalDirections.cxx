#include "vtkPrincipalDirections.h"

#include "Adapters/ContextFromAlgorithm.h"
#include "Adapters/CurvaturesToArrays.h"
#include "Adapters/PieceRequest.h"
#include "Support/Errors.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <utility>

vtkStandardNewMacro(vtkPrincipalDirections);

//------------------------------------------------------------------------------
int vtkPrincipalDirections::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  dmg::RequestWholeInPieceZero(request, inputVector, 1, outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkPrincipalDirections::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* const input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* const output = vtkPolyData::GetData(outputVector);
  output->Initialize();
  if (input->GetNumberOfCells() == 0)
  {
    return 1;
  }
  if (!dmg::IsPieceZero(request, outputVector))
  {
    vtkWarningMacro("a piece of the surface other than the first holds "
      << input->GetNumberOfCells()
      << " cells, which are ignored; if the surface is distributed, gather it in piece 0 first");
    return 1;
  }
  try
  {
    const dmg::ContextFromAlgorithm context(this);
    dmg::SurfaceMesh surface = dmg::MeshFromPolyData(
      input, dmg::Numbering::Spatial, dmg::PartOfContext(context, 0.0, 0.3));
    const dmg::FramedMesh framed(std::move(surface.Mesh), dmg::PartOfContext(context, 0.3, 0.3));
    const dmg::PrincipalDirections found = dmg::FindPrincipalDirections(
      framed, this->Scale, dmg::PartOfContext(context, 0.3, 0.9));
    output->ShallowCopy(input);
    dmg::AddCurvatures(
      { framed, surface }, found, input, output, dmg::PartOfContext(context, 0.9, 1.0));
  }
  catch (const dmg::Cancelled&)
  {
    return dmg::Aborted(this, outputVector);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkPrincipalDirections::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scale: " << this->Scale << "\n";
}
