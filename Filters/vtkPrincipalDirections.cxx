#include "vtkPrincipalDirections.h"

#include "Adapters/Output/CurvaturesToArrays.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/View/SurfaceView.h"

#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPrincipalDirections);

//------------------------------------------------------------------------------
dmg::PropertyTable vtkPrincipalDirections::Properties() const
{
  dmg::PropertyTable table;
  table.Number("Scale", this->Scale, 0, 100);
  return table;
}

//------------------------------------------------------------------------------
int vtkPrincipalDirections::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    this->Properties().Check();
    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    view.Prepare({ dmg::Numbering::Spatial, this->JoinPoints, this->Strict }, dmg::PartOfContext(context, 0.0, 0.3));
    dmg::WarnOfPreparation(this, view.Repair());
    const dmg::FramedMesh& framed = view.Surface().Geometry;
    dmg::PrincipalDirections found =
      dmg::FindPrincipalDirections(framed, this->Scale, dmg::PartOfContext(context, 0.3, 0.85));
    dmg::Warn(this, { dmg::WarningOfScale(framed, found, this->Scale) });
    dmg::CombSigns(framed, found, dmg::PartOfContext(context, 0.85, 0.9));
    view.StartOutput(vtkDataSet::GetData(outputVector), this->GetClassName());
    dmg::AddCurvatures(view, found, dmg::PartOfContext(context, 0.9, 1.0));
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkPrincipalDirections::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
}
