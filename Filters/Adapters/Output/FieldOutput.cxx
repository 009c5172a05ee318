#include "Adapters/Output/FieldOutput.h"

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Output/FieldToArrays.h"
#include "Adapters/Output/ReportToArrays.h"
#include "Adapters/Surface/PreparationToFieldData.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

namespace dmg
{

void WriteField(const SolverOfDataSet& surface, const Field& field, const FieldInputs& inputs,
  const FieldProperties& properties, const std::string& followed, vtkInformationVector* outputs,
  const ExecutionContext& context)
{
  vtkDataSet* const output = vtkDataSet::GetData(outputs, 0);
  vtkPolyData* const edges = vtkPolyData::GetData(outputs, 1);
  vtkTable* const convergence = vtkTable::GetData(outputs, 2);
  const FramedSurface on = surface.Surface();
  const double most = field.HarmonicBasis ? 0.2 : 1.0;
  output->ShallowCopy(inputs.Surface);
  AddField(on, field, properties.AllDirections, output, edges, PartOfContext(context, 0.0, most));
  AddPrescribed(on.Relation, field.Solution->Constraints, field.Solution->Discretisation->Elements(), output, edges);
  AddBasis(on, field, output, edges, PartOfContext(context, most, 1.0));
  AddPreparation(surface.Preparation(), properties.Preparation, output->GetFieldData());
  PathsToPolyData(field.Guides.Paths, vtkPolyData::GetData(outputs, 3));
  MakeConvergenceTable(field.Report, convergence);
  for (vtkFieldData* const data : { output->GetFieldData(), convergence->GetFieldData() })
  {
    RemoveReport(data);
    AddFollowed(followed, data);
    AddReport(field, surface.SetupSeconds(field), data);
    if (!inputs.Guides.Data.empty())
    {
      AddGuidesReport(field.Guides, data);
    }
  }
}

}
