#include "vtkDirectionalField.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/InnerFilter.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Support/Errors.h"

#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFieldLines.h"
#include "vtkFieldSingularities.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <string>

vtkStandardNewMacro(vtkDirectionalField);

namespace
{

/// The parts of the progress that are done when the field is solved for, and when lines are drawn, too.
constexpr double PartOfSolver = 0.7;
constexpr double Drawn = 0.95;

/// Outputs of a solver for the pieces that are asked for, of which the surface and the paths of guides are those of this filter.
void MakeSolverOutputs(vtkInformationVector* asked, vtkInformationVector* outputs)
{
  vtkNew<vtkPolyData> edges;
  vtkNew<vtkTable> convergence;
  vtkDataObject* const data[] = { vtkDataObject::GetData(asked, 0), edges, convergence,
    vtkDataObject::GetData(asked, 3) };
  for (int port = 0; port < 4; ++port)
  {
    vtkNew<vtkInformation> information;
    information->Copy(asked->GetInformationObject(port));
    information->Set(vtkDataObject::DATA_OBJECT(), data[port]);
    information->Remove(vtkDemandDrivenPipeline::DATA_NOT_GENERATED());
    outputs->SetInformationObject(port, information);
  }
}

}

//------------------------------------------------------------------------------
vtkDirectionalField::vtkDirectionalField()
{
  this->SetBoundaryWeight(1.0);
  this->SetSharpEdgesWeight(1.0);
}

//------------------------------------------------------------------------------
int vtkDirectionalField::FillOutputPortInformation(int port, vtkInformation* information)
{
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataSet" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
dmg::PropertyTable vtkDirectionalField::Properties() const
{
  dmg::PropertyTable table;
  table.Number("LineDistance", this->LineDistance, 0.0005, 1);
  table.Number("SphereRadius", this->SphereRadius, 0, 0.1);
  return table;
}

//------------------------------------------------------------------------------
int vtkDirectionalField::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Without ranks, on one process.
  const auto solveAndDraw =
    [&](vtkInformationVector** inputs, const dmg::RanksOfPipeline* ranks, const dmg::ExecutionContext& context)
  {
    this->Properties().Check();
    vtkNew<vtkInformationVector> solved;
    MakeSolverOutputs(outputVector, solved);
    this->SetProgressShiftScale(0.0, PartOfSolver);
    const int success = this->Superclass::RequestData(request, inputs, solved);
    this->SetProgressShiftScale(0.0, 1.0);
    if (solved->GetInformationObject(0)->Has(vtkDemandDrivenPipeline::DATA_NOT_GENERATED()))
    {
      throw dmg::Cancelled();
    }
    if (success == 0)
    {
      throw dmg::ReportedFailure();
    }
    this->Draw(outputVector, ranks, context);
  };
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  { solveAndDraw(whole, nullptr, context); };
  // The filters inside are collective, too: each solves in pieces or gathers them.
  const auto makeInPieces =
    [&](const dmg::RanksOfPipeline& ranks, vtkInformationVector** inputs, const dmg::ExecutionContext& context)
  {
    ranks.Together([&] { solveAndDraw(inputs, &ranks, context); });
    return std::string();
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make, makeInPieces);
}

//------------------------------------------------------------------------------
void vtkDirectionalField::Draw(
  vtkInformationVector* outputVector, const dmg::RanksOfPipeline* ranks, const dmg::ExecutionContext& context)
{
  // A copy: the pipelines of these filters write into the data what was asked for, and the output would seem to be another piece.
  vtkDataSet* const output = vtkDataSet::GetData(outputVector, 0);
  const auto surface = vtk::TakeSmartPointer(output->NewInstance());
  surface->ShallowCopy(output);
  vtkNew<vtkFieldLines> lines;
  lines->SetInputData(surface);
  lines->SetSeparatingDistance(this->LineDistance);
  vtkNew<vtkFieldSingularities> singularities;
  singularities->SetInputData(surface);
  singularities->SetSphereRadius(this->SphereRadius);
  const auto draw = [&](vtkAlgorithm* filter, double from, double to)
  {
    const dmg::PartOfContext part(context, from, to);
    if (!ranks)
    {
      return dmg::UpdateInside(this, filter, part);
    }
    bool isMade = false;
    ranks->Together([&] { isMade = dmg::UpdateInside(this, filter, part, ranks->Rank(), ranks->Size()); });
    return ranks->AreAll(isMade);
  };
  if (draw(lines, PartOfSolver, Drawn) && draw(singularities, Drawn, 1.0))
  {
    vtkPolyData::GetData(outputVector, 1)->ShallowCopy(lines->GetOutput());
    vtkPolyData::GetData(outputVector, 2)->ShallowCopy(singularities->GetOutput(3));
  }
}

//------------------------------------------------------------------------------
void vtkDirectionalField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
}
