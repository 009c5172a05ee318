#include "vtkPrincipalDirections.h"

#include "Adapters/Output/CurvaturesToArrays.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PropertyRanges.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/Surface/PreparedDataSet.h"

#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

#include <utility>

vtkStandardNewMacro(vtkPrincipalDirections);

//------------------------------------------------------------------------------
int vtkPrincipalDirections::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* const output = vtkDataSet::GetData(outputVector);
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    dmg::CheckRanges({ { "Scale", this->Scale, 0, 100 } });
    const vtkSmartPointer<vtkDataSet> input = dmg::SurfaceOf(whole[0]);
    const dmg::PreparationOptions options{ dmg::Numbering::Spatial, this->JoinPoints, this->Strict };
    const auto prepared = dmg::PrepareDataSet(input, options, dmg::PartOfContext(context, 0.0, 0.3));
    dmg::WarnOfPreparation(this, prepared->Report);
    const dmg::FramedMesh& framed = prepared->Geometry;
    dmg::PrincipalDirections found =
      dmg::FindPrincipalDirections(framed, this->Scale, dmg::PartOfContext(context, 0.3, 0.85));
    dmg::CombSigns(framed, found, dmg::PartOfContext(context, 0.85, 0.9));
    output->ShallowCopy(input);
    dmg::AddPreparation(prepared->Report, options, output->GetFieldData());
    dmg::AddCurvatures(prepared->Surface(), found, input, output, dmg::PartOfContext(context, 0.9, 1.0));
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkPrincipalDirections::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scale: " << this->Scale << "\n";
}
