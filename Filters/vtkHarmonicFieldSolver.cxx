#include "vtkHarmonicFieldSolver.h"

#include "Adapters/ConstraintsFromArrays.h"
#include "Adapters/ContextFromAlgorithm.h"
#include "Adapters/FieldToArrays.h"
#include "Adapters/MeshFromPolyData.h"
#include "Adapters/OperatorsToFieldData.h"
#include "Adapters/PieceRequest.h"
#include "HarmonicField.h"
#include "Support/Errors.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <chrono>
#include <optional>
#include <tuple>
#include <vector>

vtkStandardNewMacro(vtkHarmonicFieldSolver);

namespace
{

// What the system stage and the solve stage depend on; equality decides what is redone.

bool SameElements(const dmg::FieldConstraints& a, const dmg::FieldConstraints& b)
{
  return std::tie(a.Elements, a.Weights) == std::tie(b.Elements, b.Weights);
}

bool operator==(const dmg::SweepOptions& a, const dmg::SweepOptions& b)
{
  return std::tie(a.Rule, a.Sweeps, a.LeastImprovement, a.MaximumSweeps, a.Cycles) ==
    std::tie(b.Rule, b.Sweeps, b.LeastImprovement, b.MaximumSweeps, b.Cycles);
}

bool operator==(const dmg::SolverOptions& a, const dmg::SolverOptions& b)
{
  const auto values = [](const dmg::SolverOptions& o)
  {
    return std::tie(o.Kind, o.Sweeps, o.FinestSweepsFactor, o.FinestProlongationSteps,
      o.StartingLevel, o.CompareWithCholesky, o.ExpectedSolves);
  };
  return values(a) == values(b) && a.Nested == b.Nested;
}

bool operator==(const dmg::FieldOptions& a, const dmg::FieldOptions& b)
{
  const auto values = [](const dmg::FieldOptions& o)
  {
    return std::tie(
      o.Kind, o.N, o.Smoothness, o.Alignment, o.Constraints, o.CoarseSpace, o.Areas);
  };
  return values(a) == values(b) && a.Solver == b.Solver;
}

bool operator==(const dmg::StoppingCriteria& a, const dmg::StoppingCriteria& b)
{
  return std::tie(a.RelativeTolerance, a.MaximumIterations) ==
    std::tie(b.RelativeTolerance, b.MaximumIterations);
}

bool SameValues(const dmg::Vector<double>& a, const dmg::Vector<double>& b)
{
  return a.size() == b.size() && a == b;
}

/// What was built once is kept when more is needed.
void AddTo(dmg::OperatorSelection& all, const dmg::OperatorSelection& more)
{
  all.PowerFields |= more.PowerFields;
  all.FaceFields |= more.FaceFields;
  all.OneForms |= more.OneForms;
}

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}

//------------------------------------------------------------------------------
// The three stages. Each is built as a whole and then put in place, and takes away the later ones
// that refer to it: a run that stops half-way leaves nothing half-made.
class vtkHarmonicFieldSolver::vtkInternals
{
public:
  /// Set-up, first half: what every solver needs.
  struct SurfaceStage
  {
    std::string Digest;
    dmg::Numbering Numbering;
    dmg::FramedSurface Framed;
    double Seconds;
  };

  /// Set-up, second half: the thesis's levels, or those of the input.
  struct OperatorsStage
  {
    dmg::OperatorsOrigin Origin;
    dmg::ProlongationOperators Operators;
    double Seconds;
  };

  /// What cycles need for one discretisation.
  struct LevelsStage
  {
    std::shared_ptr<const OperatorsStage> From; ///< null for samples
    dmg::Discretisation Kind;
    int N;
    dmg::VertexAreas Areas;
    std::shared_ptr<const dmg::RoughnessSurface> Levels; ///< null where there are too few faces
    double Seconds;
  };

  /// Output of the surface and a discretisation, whatever is prescribed.
  struct BasisStage
  {
    dmg::BasisArrays Arrays;
  };

  struct SystemStage
  {
    dmg::FieldConstraints Constraints;
    dmg::FieldOptions Options;
    std::shared_ptr<const LevelsStage> Levels; ///< null where its solver needs none
    dmg::FieldProblem Problem;
  };

  struct SolveStage
  {
    dmg::Vector<double> Values;
    dmg::StoppingCriteria Stop;
    dmg::Vector<double> Unknowns;
    dmg::SolveReport Report;
    std::optional<dmg::FieldArrays> Arrays;
  };

  dmg::ConstraintChoices OfGuides; ///< SetGuideArrayToProcess

  std::unique_ptr<SurfaceStage> Surface;
  std::shared_ptr<const OperatorsStage> Operators; ///< null where the solver does without
  /// All that there are of this surface: discretisations and solvers want different levels.
  std::vector<std::shared_ptr<const OperatorsStage>> Built;
  std::shared_ptr<const LevelsStage> Levels;
  std::unique_ptr<BasisStage> Basis;
  std::unique_ptr<SystemStage> System;
  std::unique_ptr<SolveStage> Solution;
  dmg::Vector<double> Start; ///< where there is none: unknowns of the system before its last update, or empty

  bool IsSetupUncounted = false; ///< a run has set up something, and stopped half-way
  int NumberOfSetups = 0;
  int NumberOfSystems = 0;
  int NumberOfSolves = 0;

  /// \param options say whether operators are needed.
  /// \param selection the operators besides the nodal ones.
  void SetUp(vtkPolyData* input, const dmg::FieldOptions& options,
    const dmg::OperatorSelection& selection, const dmg::ExecutionContext& context)
  {
    const std::string digest = dmg::ContentDigest(input);
    const auto stored = dmg::OperatorsOriginOf(input->GetFieldData());
    if (stored && stored->Digest != digest)
    {
      throw dmg::InvalidInput("the surface is another than the one its operators were built for "
                              "(field array '" +
        std::string(dmg::ArrayNames::ProlongationDigest) + "' says " + stored->Digest +
        ", the points and triangles give " + digest +
        "); apply vtkDirectionalProlongation after the last filter that changes the surface");
    }

    // Operators that are stored number the elements as the input does.
    const auto numbering = stored ? dmg::Numbering::OfPolyData : dmg::Numbering::Spatial;
    if (!this->Surface || this->Surface->Digest != digest || this->Surface->Numbering != numbering)
    {
      const auto start = std::chrono::steady_clock::now();
      dmg::FramedSurface framed(dmg::MeshFromPolyData(input, numbering, context), context);
      this->Solution.reset();
      this->System.reset();
      this->Levels.reset();
      this->Operators.reset();
      this->Built.clear();
      this->Basis.reset();
      this->Surface.reset(new SurfaceStage{ digest, numbering, std::move(framed), SecondsSince(start) });
      this->IsSetupUncounted = true;
    }

    dmg::OperatorsOrigin origin{ digest, dmg::LevelsFor(options), selection };
    if (stored)
    {
      origin = *stored;
    }
    const auto known = std::find_if(
      this->Built.begin(), this->Built.end(), [&origin](const auto& stage) {
        dmg::OperatorsOrigin other = stage->Origin;
        other.Selection = origin.Selection;
        return other == origin;
      });
    const auto former = this->Operators;
    this->Operators = known == this->Built.end() ? nullptr : *known;
    if (this->Operators && !stored)
    {
      AddTo(origin.Selection, this->Operators->Origin.Selection);
    }
    const dmg::TriangleMesh& mesh = this->Surface->Framed.Surface.Mesh;
    // What the input brings along is read, and checked, even where the solver might do without.
    const bool areNeeded = stored ? options.Solver.Kind != dmg::SolverKind::Cholesky
                                  : dmg::NeedsLevels(mesh, options) &&
        !dmg::UsesRoughnessSurface(mesh, nullptr, options);
    const bool areBuilt =
      areNeeded && !(this->Operators && this->Operators->Origin == origin);
    if (areBuilt)
    {
      const auto start = std::chrono::steady_clock::now();
      auto operators = stored
        ? dmg::OperatorsFromFieldData(input->GetFieldData(), mesh)
        : dmg::BuildSurfaceHierarchy(mesh, origin.Options, dmg::PartOfContext(context, 0.0, 0.6),
            origin.Selection)
            .Operators;
      if (this->Levels && this->Levels->From)
      {
        this->Levels.reset();
      }
      if (this->Operators)
      {
        this->Built.erase(known);
      }
      this->Operators = std::make_shared<const OperatorsStage>(
        OperatorsStage{ origin, std::move(operators), SecondsSince(start) });
      this->Built.push_back(this->Operators);
      this->IsSetupUncounted = true;
    }
    if (this->Operators != former)
    {
      // The same options may come with other operators of the input.
      this->Solution.reset();
      this->System.reset();
    }
    this->IsSetupUncounted |=
      this->MakeLevels(options, dmg::PartOfContext(context, areBuilt ? 0.6 : 0.0, 1.0));
    this->NumberOfSetups += this->IsSetupUncounted;
    this->IsSetupUncounted = false;
  }

  const dmg::ProlongationOperators* GivenOperators() const
  {
    return this->Operators ? &this->Operators->Operators : nullptr;
  }

  void Prepare(const dmg::FieldConstraints& constraints, const dmg::FieldOptions& options,
    const dmg::ExecutionContext& context)
  {
    if (this->System && SameElements(this->System->Constraints, constraints) &&
      this->System->Options == options)
    {
      return;
    }
    if (this->UpdateSystem(constraints, options, context))
    {
      return;
    }
    const dmg::FramedSurface& framed = this->Surface->Framed;
    const auto levels = this->LevelsOf(options);
    std::unique_ptr<SystemStage> system(new SystemStage{ constraints, options, levels,
      dmg::FieldProblem(framed.Surface.Mesh, framed.Faces, this->GivenOperators(), constraints,
        options, context, levels ? levels->Levels : nullptr) });
    this->Solution.reset();
    this->Start.resize(0);
    this->System = std::move(system);
    ++this->NumberOfSystems;
  }

  /// Whether levels are those that such options want.
  bool Serves(const LevelsStage* levels, const dmg::FieldOptions& options) const
  {
    return levels && levels->From == this->Operators && levels->Kind == options.Kind &&
      levels->N == options.NumberOfDirections() && levels->Areas == options.Areas;
  }

  /// Null where the solver needs none, or they have not been made.
  std::shared_ptr<const LevelsStage> LevelsOf(const dmg::FieldOptions& options) const
  {
    if (!dmg::UsesRoughnessSurface(this->Surface->Framed.Surface.Mesh, this->GivenOperators(), options))
    {
      return nullptr;
    }
    const auto& ofSystem = this->System ? this->System->Levels : this->Levels;
    return this->Serves(ofSystem.get(), options) ? ofSystem
      : this->Serves(this->Levels.get(), options) ? this->Levels
                                                  : nullptr;
  }

  /// \return whether samples were taken.
  bool MakeLevels(const dmg::FieldOptions& options, const dmg::ExecutionContext& context)
  {
    const dmg::FramedSurface& framed = this->Surface->Framed;
    if (!dmg::UsesRoughnessSurface(framed.Surface.Mesh, this->GivenOperators(), options) ||
      this->LevelsOf(options))
    {
      return false; // what another discretisation has made stays
    }
    const auto start = std::chrono::steady_clock::now();
    auto levels = dmg::MakeRoughnessSurface(
      framed.Surface.Mesh, framed.Faces, this->GivenOperators(), options, context);
    this->Levels = std::make_shared<const LevelsStage>(LevelsStage{ this->Operators, options.Kind,
      options.NumberOfDirections(), options.Areas, std::move(levels), SecondsSince(start) });
    return !this->Operators;
  }

  /// Other prescribed elements or weights, numbers only. \return whether the problem can do so.
  bool UpdateSystem(const dmg::FieldConstraints& constraints, const dmg::FieldOptions& options,
    const dmg::ExecutionContext& context)
  {
    dmg::FieldOptions reweighted = options;
    if (!this->System)
    {
      return false;
    }
    const dmg::FieldOptions& old = this->System->Options;
    reweighted.Smoothness = old.Smoothness;
    reweighted.Alignment = old.Alignment;
    reweighted.Constraints = old.Constraints;
    if (!(reweighted == old))
    {
      return false;
    }
    // Half-updated, it must not be seen again.
    std::unique_ptr<SystemStage> system = std::move(this->System);
    if (this->Solution)
    {
      this->Start = std::move(this->Solution->Unknowns);
      this->Solution.reset();
    }
    const dmg::FramedSurface& framed = this->Surface->Framed;
    if (!system->Problem.Update(framed.Surface.Mesh, framed.Faces, constraints, options, context))
    {
      return false;
    }
    system->Constraints = constraints;
    system->Options = options;
    this->System = std::move(system);
    ++this->NumberOfSystems;
    return true;
  }

  /// \return whether it solved, rather than kept what stood.
  bool Solve(const dmg::Vector<double>& values, const dmg::StoppingCriteria& stop,
    const dmg::ExecutionContext& context)
  {
    if (this->Solution && SameValues(this->Solution->Values, values) &&
      this->Solution->Stop == stop)
    {
      return false;
    }
    const dmg::Vector<double>& start = this->Solution ? this->Solution->Unknowns : this->Start;
    dmg::FieldProblem& problem = this->System->Problem;
    dmg::Vector<double> unknowns = problem.Solve(values, start, stop, context);
    this->Solution.reset(
      new SolveStage{ values, stop, std::move(unknowns), problem.Report(), std::nullopt });
    ++this->NumberOfSolves;
    return true;
  }

  /// The output; part of the solution, but for its options.
  void MakeArrays(
    vtkPolyData* input, bool unitLength, bool combing, const dmg::ExecutionContext& context)
  {
    std::optional<dmg::FieldArrays>& arrays = this->Solution->Arrays;
    if (!arrays || arrays->UnitLength != unitLength || arrays->Combing != combing)
    {
      arrays = dmg::MakeFieldArrays(this->Surface->Framed, this->Solution->Unknowns,
        this->System->Options, unitLength, combing, input, context);
    }
  }

  /// The harmonic fields; \return whether they were made, rather than kept.
  bool MakeBasis(vtkPolyData* input, dmg::Discretisation kind, const dmg::ExecutionContext& context)
  {
    if (this->Basis && this->Basis->Arrays.Kind == kind)
    {
      return false;
    }
    this->Basis.reset(); // the memory of another kind first
    this->Basis.reset(
      new BasisStage{ dmg::MakeBasisArrays(this->Surface->Framed, kind,
        this->System->Problem.HarmonicFields(), input, context) });
    return true;
  }

  double SetupSeconds() const
  {
    return this->Surface->Seconds + (this->Operators ? this->Operators->Seconds : 0.0) +
      (this->System->Levels ? this->System->Levels->Seconds : 0.0);
  }
};

//------------------------------------------------------------------------------
vtkHarmonicFieldSolver::vtkHarmonicFieldSolver()
  : Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
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
void vtkHarmonicFieldSolver::SetGuideArrayToProcess(
  int index, int port, int connection, int association, const char* name)
{
  dmg::ConstraintChoices& choices = this->Internals->OfGuides;
  dmg::ArrayChoice* const chosen[] = { &choices.Mask, &choices.Vectors, &choices.Weights };
  if (index < 0 || index > 2 || port != 1 || connection != 0)
  {
    vtkErrorMacro("guides have no array of index "
      << index << ", port " << port << ", connection " << connection
      << "; choose index 0 (mask), 1 (directions) or 2 (weights), port 1, connection 0");
    return;
  }
  dmg::ArrayChoice choice;
  choice.Name = name ? name : "";
  choice.Association = association;
  if (!(*chosen[index] == choice))
  {
    *chosen[index] = choice;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::GetNumberOfSetups() const
{
  return this->Internals->NumberOfSetups;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::GetNumberOfSystems() const
{
  return this->Internals->NumberOfSystems;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::GetNumberOfSolves() const
{
  return this->Internals->NumberOfSolves;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::FillInputPortInformation(int port, vtkInformation* information)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, information);
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
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkTable" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  dmg::RequestWholeInPieceZero(request, inputVector, 2, outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkHarmonicFieldSolver::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* const input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* const output = vtkPolyData::GetData(outputVector, 0);
  vtkPolyData* const edges = vtkPolyData::GetData(outputVector, 1);
  vtkTable* const convergence = vtkTable::GetData(outputVector, 2);
  output->Initialize();
  edges->Initialize();
  convergence->Initialize();
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

  vtkInternals& stages = *this->Internals;
  const bool hasBasis = this->HarmonicBasis && this->Discretisation != PowerField;
  dmg::Guides guides{ {}, stages.OfGuides, this->MaximumDistance };
  for (int i = 0; i < inputVector[1]->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkDataObject* const data = vtkDataObject::GetData(inputVector[1], i))
    {
      guides.Data.push_back(data);
    }
  }
  dmg::GuidesReport guidesReport;
  try
  {
    const dmg::ContextFromAlgorithm context(this);
    const bool structured = this->CoarseSpace == StructurePreserving;
    const dmg::OperatorSelection selection{ structured && this->Discretisation == PowerField,
      structured && this->Discretisation == FaceField,
      structured && this->Discretisation == OneForm };
    dmg::FieldOptions options;
    options.Kind = static_cast<dmg::Discretisation>(this->Discretisation);
    options.N = this->NumberOfDirections;
    options.Smoothness = this->Smoothness;
    options.Alignment = this->Alignment;
    options.Constraints = static_cast<dmg::ConstraintKind>(this->ConstraintType);
    options.CoarseSpace = static_cast<dmg::CoarseSpaceKind>(this->CoarseSpace);
    options.Areas = static_cast<dmg::VertexAreas>(this->VertexAreas == MixedVoronoi
        ? dmg::VertexAreas::MixedVoronoi
        : dmg::VertexAreas::Barycentric);
    options.Solver.Kind = static_cast<dmg::SolverKind>(this->Solver);
    options.Solver.Sweeps = this->Sweeps;
    options.Solver.Nested.Cycles = this->NestedCycles;
    options.Solver.Nested.Rule = static_cast<dmg::SweepRule>(this->NestedRule);
    options.Solver.Nested.Sweeps = this->NestedSweeps;
    options.Solver.Nested.MaximumSweeps = this->MaximumNumberOfNestedSweeps;
    options.Solver.StartingLevel = this->StartingLevel;
    options.Solver.ExpectedSolves = this->ExpectedSolves;
    options.Solver.CompareWithCholesky = this->CompareWithCholesky ||
      (this->Solver == NestedIterations && this->NestedRule == WhileErrorFalls);

    stages.SetUp(input, options, selection, dmg::PartOfContext(context, 0.0, 0.5));

    const dmg::FramedSurface& framed = stages.Surface->Framed;
    const dmg::Prescription prescribed = dmg::ChosenDirections(
      dmg::ChoicesOf(this), input, guides, framed, dmg::PartOfContext(context, 0.5, 0.5));
    guidesReport = prescribed.Report;
    if (!guidesReport.IsAllTaken())
    {
      vtkWarningMacro(<< guidesReport.LeftOut());
    }
    const dmg::FieldConstraints constraints =
      dmg::MakeFieldConstraints(framed.Surface.Mesh, framed.Faces, framed.Vertices,
        prescribed.Directions, options, framed.Surface.Names());
    stages.Prepare(constraints, options, dmg::PartOfContext(context, 0.5, 0.7));

    const dmg::StoppingCriteria stop{ this->Tolerance, this->MaximumNumberOfIterations };
    if (stages.Solve(constraints.Values, stop, dmg::PartOfContext(context, 0.7, 0.9)))
    {
      for (const std::string& warning : stages.Solution->Report.Warnings)
      {
        vtkWarningMacro(<< warning);
      }
    }
    stages.MakeArrays(input, this->UnitLength, this->Combing,
      dmg::PartOfContext(context, 0.9, hasBasis ? 0.92 : 1.0));
    if (hasBasis &&
      stages.MakeBasis(input, options.Kind, dmg::PartOfContext(context, 0.92, 1.0)) &&
      stages.Basis->Arrays.TooMany)
    {
      vtkWarningMacro("the surface has " << stages.Basis->Arrays.NumberOfLoops
        << " harmonic fields, which are too many to hold: no HarmonicBasis arrays; close its holes "
           "and remove its small handles first, or switch HarmonicBasis off");
    }
  }
  catch (const dmg::Cancelled&)
  {
    return dmg::Aborted(this, outputVector);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }

  const dmg::SolveReport& report = stages.Solution->Report;
  output->ShallowCopy(input);
  dmg::AddFieldArrays(*stages.Solution->Arrays, output, edges);
  const dmg::FieldOptions& solved = stages.System->Options;
  dmg::AddPrescribed(stages.Surface->Framed.Surface, stages.System->Constraints, solved.Kind,
    solved.Kind == dmg::Discretisation::OneForm ? edges : output);
  if (hasBasis)
  {
    dmg::AddBasisArrays(stages.Basis->Arrays, output, edges);
  }
  dmg::MakeConvergenceTable(report, convergence);
  for (vtkDataObject* data :
    { static_cast<vtkDataObject*>(output), static_cast<vtkDataObject*>(convergence) })
  {
    dmg::AddReport(
      report, solved.NumberOfDirections(), stages.SetupSeconds(), data->GetFieldData());
    if (!guides.Data.empty())
    {
      dmg::AddGuidesReport(guidesReport, data->GetFieldData());
    }
    if (hasBasis)
    {
      dmg::AddBasisSize(stages.Basis->Arrays, data->GetFieldData());
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkHarmonicFieldSolver::PrintSelf(ostream& os, vtkIndent indent)
{
  const char* const discretisations[] = { "PowerField", "FaceField", "OneForm" };
  const char* const solvers[] = { "Automatic", "Cholesky", "VCycles", "ConjugateGradients",
    "NestedIterations", "CoarseProlongation" };
  const char* const rules[] = { "FixedNumber", "WhileErrorFalls", "WhileResidualFalls" };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Discretisation: " << discretisations[this->Discretisation] << "\n";
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
  os << indent << "ConstraintType: " << (this->ConstraintType == Soft ? "Soft" : "Hard") << "\n";
  os << indent << "Smoothness: " << this->Smoothness << "\n";
  os << indent << "Alignment: " << this->Alignment << "\n";
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
  os << indent << "Solver: " << solvers[this->Solver] << "\n";
  os << indent << "ExpectedSolves: " << this->ExpectedSolves << "\n";
  os << indent << "CoarseSpace: " << (this->CoarseSpace == Nodal ? "Nodal" : "StructurePreserving")
     << "\n";
  os << indent << "Sweeps: " << this->Sweeps << "\n";
  os << indent << "NestedCycles: " << this->NestedCycles << "\n";
  os << indent << "NestedRule: " << rules[this->NestedRule] << "\n";
  os << indent << "NestedSweeps: " << this->NestedSweeps << "\n";
  os << indent << "MaximumNumberOfNestedSweeps: " << this->MaximumNumberOfNestedSweeps << "\n";
  os << indent << "StartingLevel: " << this->StartingLevel << "\n";
  os << indent
     << "VertexAreas: " << (this->VertexAreas == MixedVoronoi ? "MixedVoronoi" : "Barycentric")
     << "\n";
  os << indent << "CompareWithCholesky: " << (this->CompareWithCholesky ? "On" : "Off") << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "UnitLength: " << (this->UnitLength ? "On" : "Off") << "\n";
  os << indent << "Combing: " << (this->Combing ? "On" : "Off") << "\n";
  os << indent << "HarmonicBasis: " << (this->HarmonicBasis ? "On" : "Off") << "\n";
  os << indent << "NumberOfSetups: " << this->GetNumberOfSetups() << "\n";
  os << indent << "NumberOfSystems: " << this->GetNumberOfSystems() << "\n";
  os << indent << "NumberOfSolves: " << this->GetNumberOfSolves() << "\n";
}
