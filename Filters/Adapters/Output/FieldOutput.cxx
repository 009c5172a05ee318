#include "Adapters/Output/FieldOutput.h"

#include "Adapters/Output/ReportToArrays.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"

namespace dmg
{

void FieldOutput::SetSurface(const SolverOfSurface& surface)
{
  if (this->Surface != surface.Number())
  {
    this->Arrays.reset();
    this->BasisOfSurface.reset();
    this->Surface = surface.Number();
  }
}

void FieldOutput::MakeArrays(
  const SolverOfSurface& surface, const dmg::Field& field, vtkDataSet* input, const ExecutionContext& context)
{
  this->SetSurface(surface);
  if (!this->Arrays || this->Field != field.Number || this->HasUnitLength != field.HasUnitLength)
  {
    const FramedSurface framed = surface.Surface();
    const SolvedField& solved = surface.Solver().Solved();
    this->Arrays.reset(); // the memory of another field first
    this->Arrays =
      MakeFieldArrays(framed.On, framed.Relation, solved.Field(), solved.Unknowns(), field, input, context);
    this->Field = field.Number;
    this->HasUnitLength = field.HasUnitLength;
  }
}

bool FieldOutput::MakeBasis(const SolverOfSurface& surface, vtkDataSet* input, const ExecutionContext& context)
{
  this->SetSurface(surface);
  const SolvedField& solved = surface.Solver().Solved();
  if (this->BasisOfSurface && this->BasisOfSurface->Fields == solved.Field().Name())
  {
    return false;
  }
  const FramedSurface framed = surface.Surface();
  this->BasisOfSurface.reset(); // the memory of another discretisation first
  this->BasisOfSurface =
    MakeBasisArrays(framed.On, framed.Relation, solved.Field(), solved.HarmonicFields(), input, context);
  return true;
}

void FieldOutput::AddArraysTo(
  const SolverOfSurface& surface, bool hasBasis, vtkDataSet* output, vtkPolyData* edges) const
{
  const SolvedField& solved = surface.Solver().Solved();
  AddFieldArrays(*this->Arrays, output, edges);
  AddPrescribed(surface.Surface().Relation, solved.Constraints(), solved.Field().Elements(), output, edges);
  if (hasBasis)
  {
    AddBasisArrays(this->Basis(), output, edges);
  }
}

void FieldOutput::AddReportTo(
  const SolverOfSurface& surface, const dmg::Field& field, bool hasBasis, vtkFieldData* data) const
{
  AddReport(field.Report, field.N, surface.SetupSeconds(field), data);
  if (hasBasis)
  {
    AddBasisSize(this->Basis(), data);
  }
}

}
