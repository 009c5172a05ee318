#include "vtkHarmonicFieldSolver.h"

#include "Adapters/Input/ProblemFromInputs.h"
#include "Adapters/Output/FieldOutput.h"
#include "Adapters/Output/ReportToArrays.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Surface/Kept.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/Surface/SolverOfSurface.h"
#include "Adapters/View/SurfaceView.h"
#include "Mesh/TriangleSoup.h"
#ifdef DMG_PETSC
#include "Adapters/Input/FieldOfPieces.h"
#endif

#include "PropertiesOfSolver.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkHarmonicFieldSolver);

class vtkHarmonicFieldSolver::vtkInternals
{
public:
  explicit vtkInternals(vtkAlgorithm* filter)
    : Solvers(filter)
  {
  }

  dmg::StageCounts Counts() const
  {
#ifdef DMG_PETSC
    return this->Solvers.Counts() + this->Pieces.Counts();
#else
    return this->Solvers.Counts();
#endif
  }

  /// Collective. \return the reason why the outputs are not made in pieces; empty where they are.
  std::string MakeInPieces(vtkHarmonicFieldSolver* filter, const dmg::RanksOfPipeline& ranks,
    vtkInformationVector** inputs, vtkInformationVector* outputs, const dmg::ExecutionContext& context)
  {
#ifdef DMG_PETSC
    dmg::FieldProperties properties;
    ranks.Together([&] { properties = dmg::PropertiesOf(filter, this->GuideChoices); });
    const dmg::FieldOfPieces field =
      dmg::SolveInPieces(filter, properties, this->Pieces, ranks, inputs, dmg::PartOfContext(context, 0.0, 0.95));
    if (field.ReasonToGather.empty())
    {
      this->Followed = field.Followed;
      ranks.Together(
        [&]
        {
          dmg::SurfaceView view(field.Inputs.Surface);
          view.Prepare(properties.Preparation, this->Pieces.Surface(), this->Pieces.Preparation());
          dmg::WriteField(view, *field.Solution, this->Pieces.SetupSeconds(*field.Solution), field.Inputs, properties,
            field.Followed, outputs, dmg::PartOfContext(context, 0.95, 1.0));
        });
    }
    return field.ReasonToGather;
#else
    (void)filter, (void)ranks, (void)inputs, (void)outputs, (void)context;
    return "the filters were built without DMG_PETSC, by which power fields at points and functions stay in pieces";
#endif
  }

  dmg::Kept<dmg::SolverOfSurface> Solvers;
  dmg::ConstraintArrays GuideChoices; ///< SetGuideArrayToProcess
  std::string Followed;
#ifdef DMG_PETSC
  dmg::SolverOfPieces Pieces;
#endif
};

namespace
{

void WarnOfSoup(vtkAlgorithm* algorithm, const dmg::TriangleMesh& mesh)
{
  if (dmg::IsSoup(mesh))
  {
    vtkWarningWithObjectMacro(algorithm,
      "most triangles share no points with those beside them, so each is a surface of its own; apply "
      "Clean (vtkCleanPolyData) first, or switch Join Points on and Strict off");
  }
}

}

//------------------------------------------------------------------------------
vtkHarmonicFieldSolver::vtkHarmonicFieldSolver()
  : Internals(new vtkInternals(this))
{
  dmg::FieldProblem problem;
  dmg::PropertyTableOf(this, problem).ToFilter();
  this->Rotation = problem.Rotation.Everywhere * 180.0 / dmg::Pi;
  this->SetNumberOfInputPorts(6);
  this->SetNumberOfOutputPorts(4);
}

//------------------------------------------------------------------------------
vtkHarmonicFieldSolver::~vtkHarmonicFieldSolver() = default;

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::AddGuidesConnection(vtkAlgorithmOutput* output)
{
  this->AddInputConnection(1, output);
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::RemoveAllGuides()
{
  this->SetInputConnection(1, nullptr);
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::RemoveSecondGuide()
{
  this->SetInputConnection(3, nullptr);
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::RemoveThirdGuide()
{
  this->SetInputConnection(4, nullptr);
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::RemoveFourthGuide()
{
  this->SetInputConnection(5, nullptr);
}

//------------------------------------------------------------------------------
const char* vtkHarmonicFieldSolver::GetFollowed() const
{
  return this->Internals->Followed.c_str();
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::AddSingularitiesConnection(vtkAlgorithmOutput* output)
{
  this->AddInputConnection(2, output);
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::RemoveAllSingularities()
{
  this->SetInputConnection(2, nullptr);
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::SetGuideArrayToProcess(
  int index, int port, int connection, int association, const char* name)
{
  dmg::ConstraintArrays& choices = this->Internals->GuideChoices;
  dmg::ChosenArray* const chosen[] = { &choices.Mask, &choices.Vectors, &choices.Weights };
  if (index < 0 || index > 2 || port != 1 || connection != 0)
  {
    vtkErrorMacro("guides have no array of index "
      << index << ", port " << port << ", connection " << connection
      << "; choose index 0 (mask), 1 (directions) or 2 (weights), port 1, connection 0");
    return;
  }
  dmg::ChosenArray choice;
  choice.Name = name ? name : "";
  choice.Association = association;
  if (!chosen[index]->IsSameChoiceAs(choice))
  {
    *chosen[index] = choice;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::SetGuideDirections(const char* name)
{
  this->SetGuideArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, name);
}

//------------------------------------------------------------------------------
const char* vtkHarmonicFieldSolver::GetGuideDirections() const
{
  return this->Internals->GuideChoices.Vectors.Name.c_str();
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::SetGuideWeights(const char* name)
{
  this->SetGuideArrayToProcess(2, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, name);
}

//------------------------------------------------------------------------------
const char* vtkHarmonicFieldSolver::GetGuideWeights() const
{
  return this->Internals->GuideChoices.Weights.Name.c_str();
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::GetNumberOfSetups() const
{
  return this->Internals->Counts().Setups;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::GetNumberOfSystems() const
{
  return this->Internals->Counts().Systems;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::GetNumberOfSolves() const
{
  return this->Internals->Counts().Solves;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::FillInputPortInformation(int port, vtkInformation* information)
{
  if (port == 0)
  {
    return dmg::TakeAnyDataSet(information);
  }
  // Composite datasets come as a whole, and other types get an error that says what to do.
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  information->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::FillOutputPortInformation(int port, vtkInformation* information)
{
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkTable" : port == 0 ? "vtkDataSet" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    // Properties are checked before anything is read.
    const dmg::FieldProperties properties = dmg::PropertiesOf(this, this->Internals->GuideChoices);
    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    const std::string digest = dmg::ContentDigest(view.Data(), properties.Preparation);
    dmg::SolverOfSurface& kept = this->Internals->Solvers.Of(digest);
    const dmg::FieldInputs inputs = dmg::InputsOf(properties, view.Given(), whole);
    kept.SetSurface(
      view.Data(), digest, properties.Problem.Options, properties.Preparation, dmg::PartOfContext(context, 0.0, 0.1));
    view.Prepare(properties.Preparation, kept.Surface(), kept.Preparation());
    dmg::WarnOfPreparation(this, view.Repair());
    WarnOfSoup(this, view.Mesh());

    dmg::FieldProblem problem = dmg::ProblemOf(this, properties, inputs, view, kept.Solver());
    problem.Guides.MayMiss = this->Internals->Solvers.IsInLeaf();
    const dmg::Field& field =
      kept.Solver().Solve(problem, dmg::PartOfContext(context, 0.1, 0.95), view.Relation().Names());
    dmg::Warn(this, field.Warnings);
    this->Internals->Followed = dmg::WhatIsFollowed(inputs, field.Features);
    dmg::WriteField(view, field, kept.SetupSeconds(field), inputs, properties, this->Internals->Followed, outputVector,
      dmg::PartOfContext(context, 0.95, 1.0));
  };
  const auto makeInPieces =
    [&](const dmg::RanksOfPipeline& ranks, vtkInformationVector** pieces, const dmg::ExecutionContext& context)
  { return this->Internals->MakeInPieces(this, ranks, pieces, outputVector, context); };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make, makeInPieces);
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  dmg::FieldProblem problem;
  dmg::PropertyTableOf(this, problem).Print(os, indent);
  os << indent << "NumberOfSetups: " << this->GetNumberOfSetups() << "\n";
  os << indent << "NumberOfSystems: " << this->GetNumberOfSystems() << "\n";
  os << indent << "NumberOfSolves: " << this->GetNumberOfSolves() << "\n";
}
