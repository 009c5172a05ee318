#include "Adapters/Output/FieldOutput.h"

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Output/FieldToArrays.h"
#include "Adapters/Output/GuidesToArrays.h"
#include "Adapters/Output/ReportToArrays.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

namespace dmg
{

void WriteField(SurfaceView& view, const Field& field, double setupSeconds, const FieldInputs& inputs,
  const FieldProperties& properties, const std::string& followed, vtkInformationVector* outputs,
  const ExecutionContext& context)
{
  vtkDataSet* const output = vtkDataSet::GetData(outputs, 0);
  vtkPolyData* const edges = vtkPolyData::GetData(outputs, 1);
  vtkTable* const convergence = vtkTable::GetData(outputs, 2);
  const double most = field.HarmonicBasis ? 0.2 : 1.0;
  view.StartOutput(output, "vtkHarmonicFieldSolver");
  AddField(view, field, properties.AllDirections, edges, PartOfContext(context, 0.0, most));
  AddPrescribed(view, field.Solution->Constraints, field.Solution->Discretisation->Elements(), edges);
  AddPrincipalValues(view, inputs.Choices);
  AddBasis(view, field, edges, PartOfContext(context, most, 1.0));
  PathsToPolyData(field.Guides.Paths, vtkPolyData::GetData(outputs, 3));
  MakeConvergenceTable(field.Report, convergence);
  for (vtkFieldData* const data : { output->GetFieldData(), convergence->GetFieldData() })
  {
    AddFollowed(followed, data);
    AddReport(field, setupSeconds, data);
    if (!inputs.Guides.Data.empty())
    {
      AddGuidesReport(field.Guides, data);
    }
  }
}

}
