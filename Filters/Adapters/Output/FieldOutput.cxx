#include "Adapters/Output/FieldOutput.h"

#include "Adapters/Output/ReportToArrays.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"

namespace dmg
{

void FieldOutput::MakeArrays(
  const SolverOfSurface& surface, const dmg::Field& field, vtkDataSet* input, const ExecutionContext& context)
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
  const SolverOfSurface& surface, const dmg::Field& field, vtkDataSet* input, const ExecutionContext& context)
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
  const SolverOfSurface& surface, const dmg::Field& field, vtkDataSet* output, vtkPolyData* edges) const
{
  const FieldSolution& solution = *field.Solution;
  AddFieldArrays(*this->Arrays, output, edges);
  AddPrescribed(surface.Surface().Relation, solution.Constraints, solution.Discretisation->Elements(), output, edges);
  if (field.HarmonicBasis)
  {
    AddBasisArrays(*this->ArraysOfBasis, output, edges);
  }
}

void FieldOutput::AddReportTo(const SolverOfSurface& surface, const dmg::Field& field, vtkFieldData* data) const
{
  AddReport(field.Report, field.N, surface.SetupSeconds(field), data);
  if (field.HarmonicBasis)
  {
    AddBasisSize(*this->ArraysOfBasis, data);
  }
}

}
