#include "Adapters/Output/FieldOutput.h"

#include "Adapters/Output/ReportToArrays.h"
#include "Adapters/Surface/PreparationToFieldData.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

namespace dmg
{

void FieldOutput::Write(const SolverOfDataSet& surface, const dmg::Field& field, const FieldInputs& inputs,
  const PreparationOptions& preparation, const std::string& followed, vtkInformationVector* outputs,
  const ExecutionContext& context)
{
  this->MakeArrays(surface, field, inputs.Surface, context);
  vtkDataSet* const output = vtkDataSet::GetData(outputs, 0);
  vtkTable* const convergence = vtkTable::GetData(outputs, 2);
  output->ShallowCopy(inputs.Surface);
  this->AddArraysTo(surface, field, output, vtkPolyData::GetData(outputs, 1));
  AddPreparation(surface.Preparation(), preparation, output->GetFieldData());
  MakeConvergenceTable(field.Report, convergence);
  for (vtkFieldData* const data : { output->GetFieldData(), convergence->GetFieldData() })
  {
    RemoveReport(data);
    AddFollowed(followed, data);
    this->AddReportTo(surface, field, data);
    if (!inputs.Guides.Data.empty())
    {
      AddGuidesReport(field.Guides, data);
    }
  }
}

void FieldOutput::MakeArrays(
  const SolverOfDataSet& surface, const dmg::Field& field, vtkDataSet* input, const ExecutionContext& context)
{
  const double most = field.HarmonicBasis ? 0.2 : 1.0;
  if (!this->Arrays || this->Surface != surface.Number() || this->Field != field.Number ||
    this->HasUnitLength != field.HasUnitLength)
  {
    const FramedSurface framed = surface.Surface();
    this->Arrays.reset(); // the memory of another field first
    this->Arrays = MakeFieldArrays(framed.Geometry, framed.Relation, *field.Solution->Discretisation,
      field.Solution->Unknowns, field, input, PartOfContext(context, 0.0, most));
    this->Surface = surface.Number();
    this->Field = field.Number;
    this->HasUnitLength = field.HasUnitLength;
  }
  this->MakeBasis(surface, field, input, PartOfContext(context, most, 1.0));
}

void FieldOutput::MakeBasis(
  const SolverOfDataSet& surface, const dmg::Field& field, vtkDataSet* input, const ExecutionContext& context)
{
  if (field.HarmonicBasis && this->Basis != field.HarmonicBasis)
  {
    const FramedSurface framed = surface.Surface();
    this->ArraysOfBasis.reset(); // the memory of another basis first
    this->Basis.reset();
    this->ArraysOfBasis = MakeBasisArrays(
      framed.Geometry, framed.Relation, *field.Solution->Discretisation, *field.HarmonicBasis, input, context);
    this->Basis = field.HarmonicBasis;
  }
}

void FieldOutput::AddArraysTo(
  const SolverOfDataSet& surface, const dmg::Field& field, vtkDataSet* output, vtkPolyData* edges) const
{
  const FieldSolution& solution = *field.Solution;
  AddFieldArrays(*this->Arrays, output, edges);
  AddPrescribed(surface.Surface().Relation, solution.Constraints, solution.Discretisation->Elements(), output, edges);
  if (field.HarmonicBasis)
  {
    AddBasisArrays(*this->ArraysOfBasis, output, edges);
  }
}

void FieldOutput::AddReportTo(const SolverOfDataSet& surface, const dmg::Field& field, vtkFieldData* data) const
{
  AddReport(field.Report, field.N, surface.SetupSeconds(field), data);
  if (field.HarmonicBasis)
  {
    AddBasisSize(*this->ArraysOfBasis, data);
  }
}

}
