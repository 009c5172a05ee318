#include "FieldStages.h"

#include "Discretisations/MakeDiscretisation.h"
#include "FieldSetup.h"
#include "Solvers/HarmonicProblem.h"
#include "Solvers/SolveInUnits.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/Errors.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

/// Operators of levels that were built for a surface.
struct BuiltOperators
{
  OperatorSelection Selection;
  std::shared_ptr<const ProlongationOperators> Operators;
  double Seconds;
};

/// The key of the last part of the set-up.
struct SetupKey
{
  std::string Fields; ///< the discretisation by name
  bool IsFactored;
  bool SplitsOperator;
  CoarseSpaceKind Space;
  std::shared_ptr<const ProlongationOperators> Operators; ///< null for samples and factors

  friend bool operator==(const SetupKey& a, const SetupKey& b)
  {
    const auto members = [](const SetupKey& key)
    {
      const auto& [fields, isFactored, splits, space, operators] = key;
      return std::tie(fields, isFactored, splits, space, operators);
    };
    return members(a) == members(b);
  }
};

struct SetupStage
{
  SetupKey Key;
  std::shared_ptr<const MultigridSetup> Setup;
  double Seconds;
};

struct SystemStage
{
  FieldConstraints Constraints;
  FieldOptions Options;
  std::shared_ptr<const SetupStage> Setup;
  HarmonicProblem Problem;
  std::unique_ptr<HarmonicProblem> Reference; ///< factors the same system, to compare; or null
};

struct SolveStage
{
  Vector<double> Values;
  Vector<double> Source;
  StoppingCriteria Stop;
  Vector<double> Unknowns;
  SolveReport Report;
};

bool SameElements(const FieldConstraints& a, const FieldConstraints& b)
{
  return std::tie(a.Elements, a.Weights) == std::tie(b.Elements, b.Weights);
}

bool SameValues(const Vector<double>& a, const Vector<double>& b)
{
  return a.size() == b.size() && a == b;
}

/// Whether two options differ in nothing but the weights of energies.
bool DifferInWeights(FieldOptions a, const FieldOptions& b)
{
  a.Smoothness = b.Smoothness;
  a.Alignment = b.Alignment;
  a.Constraints = b.Constraints;
  return a == b;
}

bool NeedsReference(const SolverOptions& options, const SolverMethod& method)
{
  const bool isRule = method.HasSweeps && options.Nested.Rule == SweepRule::WhileErrorFalls;
  return (options.CompareWithCholesky || isRule) && !method.IsDirect;
}

}

/// Each stage is built as a whole and then put in place, and takes away the later ones that refer to it: a run that stops
/// half-way leaves nothing half-made.
class FieldStages::Internals
{
public:
  Internals(TriangleMesh mesh, const ExecutionContext& context)
    : Surface(std::move(mesh), context)
  {
  }

  void SetDiscretisation(const DiscretisationOptions& options);
  void ForgetSetups();
  void SetUp(const FieldOptions& options, const ExecutionContext& context);
  void CheckTakesSource(const FieldConstraints& constraints) const;
  void Prepare(const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context);
  void Solve(const FieldConstraints& constraints, const StoppingCriteria& stop, const ExecutionContext& context);

  FramedMesh Surface;
  std::shared_ptr<const ProlongationOperators> Given;
  std::optional<BuiltOperators> Built;
  DiscretisationOptions FieldOptionsOfDiscretisation;
  std::shared_ptr<const Discretisation> Field;
  std::optional<CycleObstacles> Obstacles; ///< of the surface
  SolverPlan Plan;
  /// The set-up in use stands last; those before it are kept while there is room.
  std::vector<std::shared_ptr<const SetupStage>> Setups;
  long long MemoryLimit = 1LL << 30;
  std::unique_ptr<SystemStage> System;
  std::unique_ptr<SolveStage> Solution;
  std::shared_ptr<const Discretisation> SolvedField;
  double SecondsOfOperators = 0.0;
  StageCounts Counts;
  bool IsSetupUncounted = true; ///< something has been set up since the last count

private:
  std::shared_ptr<const ProlongationOperators> OperatorsOfPlan(const ExecutionContext& context);
  bool UpdateSystem(const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context);
  std::unique_ptr<HarmonicProblem> MakeReference(
    const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context) const;

  Vector<double> Start; ///< where there is no solution: unknowns of the system before its last update, or empty
};

void FieldStages::Internals::SetDiscretisation(const DiscretisationOptions& options)
{
  if (!this->Field || !(this->FieldOptionsOfDiscretisation == options))
  {
    this->Field = MakeDiscretisation(options, this->Surface);
    this->FieldOptionsOfDiscretisation = options;
  }
}

/// Null where the solver does without.
std::shared_ptr<const ProlongationOperators> FieldStages::Internals::OperatorsOfPlan(const ExecutionContext& context)
{
  this->SecondsOfOperators = 0.0;
  if (!this->Plan.NeedsLevels() || this->Given || this->Plan.BuildsSamples)
  {
    return this->Plan.NeedsLevels() ? this->Given : nullptr;
  }
  OperatorSelection selection = this->Plan.Selection;
  if (this->Built && this->Built->Selection.Includes(selection))
  {
    this->SecondsOfOperators = this->Built->Seconds;
    return this->Built->Operators;
  }
  if (this->Built)
  {
    selection.Add(this->Built->Selection); // what was built once is kept when more is needed
  }
  const Stopwatch watch;
  auto operators = std::make_shared<const ProlongationOperators>(
    BuildSurfaceHierarchy(this->Surface.Mesh, HierarchyOptions(), context, selection).Operators);
  this->SecondsOfOperators = watch.Seconds();
  this->Built = BuiltOperators{ selection, operators, this->SecondsOfOperators };
  this->IsSetupUncounted = true;
  return operators;
}

void FieldStages::Internals::SetUp(const FieldOptions& options, const ExecutionContext& context)
{
  this->SetDiscretisation(options.Field);
  if (!this->Obstacles)
  {
    constexpr bool HasHarmonicFields = true;
    this->Obstacles = ObstaclesOf(this->Surface.Mesh, HasHarmonicFields, context);
  }
  this->Plan = PlanSolver(*this->Field, options, this->Given.get(), *this->Obstacles);
  const auto operators = this->OperatorsOfPlan(PartOfContext(context, 0.0, 0.6));
  const SetupKey key{ this->Field->Name(), !this->Plan.NeedsLevels(), this->Plan.SplitsOperator, options.CoarseSpace,
    operators };
  const auto known =
    std::find_if(this->Setups.begin(), this->Setups.end(), [&key](const auto& setup) { return setup->Key == key; });
  if (known != this->Setups.end())
  {
    std::rotate(known, known + 1, this->Setups.end());
  }
  else
  {
    const Stopwatch watch;
    auto setup = MakeSetup(this->Surface, *this->Field, operators.get(), this->Plan, options.CoarseSpace,
      PartOfContext(context, operators ? 0.6 : 0.0, 1.0));
    this->IsSetupUncounted |= this->Plan.BuildsSamples;
    this->Setups.push_back(std::make_shared<const SetupStage>(SetupStage{ key, std::move(setup), watch.Seconds() }));
    this->ForgetSetups();
  }
  this->Counts.Setups += this->IsSetupUncounted;
  this->IsSetupUncounted = false;
}

/// The oldest ones that there is no room for; never the last.
void FieldStages::Internals::ForgetSetups()
{
  long long bytes = 0;
  auto first = this->Setups.end();
  while (first != this->Setups.begin())
  {
    bytes += (*(first - 1))->Setup->Bytes();
    if (bytes > this->MemoryLimit && first != this->Setups.end())
    {
      break;
    }
    --first;
  }
  this->Setups.erase(this->Setups.begin(), first);
}

void FieldStages::Internals::CheckTakesSource(const FieldConstraints& constraints) const
{
  if (constraints.Source.size() > 0 && this->Plan.ChoiceOn(*this->Setups.back()->Setup).Method->IsApproximation())
  {
    throw InvalidInput("nested iterations and coarse prolongations take no source; choose another solver");
  }
}

void FieldStages::Internals::Prepare(
  const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context)
{
  const auto& current = this->Setups.back();
  const bool isSameSetup = this->System && this->System->Setup == current;
  if (isSameSetup && SameElements(this->System->Constraints, constraints) && this->System->Options == options)
  {
    return;
  }
  if (isSameSetup && this->UpdateSystem(constraints, options, context))
  {
    return;
  }
  const SolverChoice& choice = this->Plan.ChoiceOn(*current->Setup);
  const bool isCompared = NeedsReference(options.Solver, *choice.Method);
  std::unique_ptr<SystemStage> system(new SystemStage{ constraints, options, current,
    HarmonicProblem(current->Setup, this->Field->PenaltiesOf(constraints, options.Weights(), context),
      options.Smoothness, options.Solver, choice, PartOfContext(context, 0.0, isCompared ? 0.5 : 1.0)),
    nullptr });
  if (isCompared)
  {
    system->Reference = this->MakeReference(constraints, options, PartOfContext(context, 0.5, 1.0));
  }
  this->Solution.reset();
  this->Start.resize(0);
  this->System = std::move(system);
  ++this->Counts.Systems;
}

std::unique_ptr<HarmonicProblem> FieldStages::Internals::MakeReference(
  const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context) const
{
  const SolverPlan factored;
  auto setup =
    MakeSetup(this->Surface, *this->Field, nullptr, factored, options.CoarseSpace, PartOfContext(context, 0.0, 0.3));
  return std::make_unique<HarmonicProblem>(std::move(setup),
    this->Field->PenaltiesOf(constraints, options.Weights(), context), options.Smoothness, options.Solver,
    factored.Choice, PartOfContext(context, 0.3, 1.0));
}

/// Other prescribed elements or weights. \return whether no more than these has changed.
bool FieldStages::Internals::UpdateSystem(
  const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context)
{
  if (!DifferInWeights(options, this->System->Options))
  {
    return false;
  }
  Penalties penalties = this->Field->PenaltiesOf(constraints, options.Weights(), context);
  // Half-updated, it must not be seen again.
  std::unique_ptr<SystemStage> system = std::move(this->System);
  if (this->Solution)
  {
    this->Start = std::move(this->Solution->Unknowns);
    this->Solution.reset();
  }
  if (system->Reference)
  {
    system->Reference->Update(penalties, options.Smoothness, PartOfContext(context, 0.0, 0.5));
  }
  system->Problem.Update(
    std::move(penalties), options.Smoothness, PartOfContext(context, system->Reference ? 0.5 : 0.0, 1.0));
  system->Constraints = constraints;
  system->Options = options;
  this->System = std::move(system);
  ++this->Counts.Systems;
  return true;
}

void FieldStages::Internals::Solve(
  const FieldConstraints& constraints, const StoppingCriteria& stop, const ExecutionContext& context)
{
  const Vector<double>& values = constraints.Values;
  if (this->Solution && SameValues(this->Solution->Values, values) &&
    SameValues(this->Solution->Source, constraints.Source) && this->Solution->Stop == stop)
  {
    return;
  }
  const Vector<double>& start = this->Solution ? this->Solution->Unknowns : this->Start;
  SystemStage& system = *this->System;
  Vector<double> reference;
  if (system.Reference)
  {
    constexpr double Rounding = 1e-13;
    constexpr int Corrections = 10;
    reference = SolveInUnits(*system.Reference, values, {}, {}, { Rounding, Corrections },
      PartOfContext(context, 0.0, 0.2), constraints.Source)
                  .Unknowns;
  }
  auto [unknowns, report] = SolveInUnits(system.Problem, values, start, reference, stop,
    PartOfContext(context, reference.size() > 0 ? 0.2 : 0.0, 1.0), constraints.Source);
  this->Field->CentreFree(constraints, unknowns);
  this->Solution.reset(new SolveStage{ values, constraints.Source, stop, std::move(unknowns), std::move(report) });
  this->SolvedField = this->Field;
  ++this->Counts.Solves;
}

FieldStages::FieldStages(TriangleMesh mesh, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(std::move(mesh), context))
{
}

FieldStages::~FieldStages() = default;

const FramedMesh& FieldStages::Surface() const
{
  return this->Internal->Surface;
}

void FieldStages::SetOperators(std::shared_ptr<const ProlongationOperators> operators)
{
  this->Internal->Given = std::move(operators);
}

void FieldStages::SetMemoryLimit(long long bytes)
{
  this->Internal->MemoryLimit = bytes;
  this->Internal->ForgetSetups();
}

const Discretisation& FieldStages::DiscretisationFor(const DiscretisationOptions& options)
{
  this->Internal->SetDiscretisation(options);
  return *this->Internal->Field;
}

const Vector<double>& FieldStages::Solve(const dmg::Constraints& directions, const FieldOptions& options,
  const StoppingCriteria& stop, const ExecutionContext& context, const ElementNames& names)
{
  Internals& of = *this->Internal;
  of.SetDiscretisation(options.Field);
  const FieldConstraints constraints = of.Field->Prescribe(directions, names);
  CheckSizes(directions, names);
  of.SetUp(options, PartOfContext(context, 0.0, 0.5));
  of.CheckTakesSource(constraints);
  of.Prepare(constraints, options, PartOfContext(context, 0.5, 0.75));
  of.Solve(constraints, stop, PartOfContext(context, 0.75, 1.0));
  context.Checkpoint(1.0);
  return of.Solution->Unknowns;
}

const Discretisation& FieldStages::Field() const
{
  assert(this->Internal->SolvedField);
  return *this->Internal->SolvedField;
}

const FieldOptions& FieldStages::Options() const
{
  return this->Internal->System->Options;
}

const FieldConstraints& FieldStages::Constraints() const
{
  return this->Internal->System->Constraints;
}

const Vector<double>& FieldStages::Unknowns() const
{
  return this->Internal->Solution->Unknowns;
}

const SolveReport& FieldStages::Report() const
{
  return this->Internal->Solution->Report;
}

LinearSystem FieldStages::Equations(const ExecutionContext& context) const
{
  const SolveStage& solution = *this->Internal->Solution;
  return this->Internal->System->Problem.Equations(solution.Values, context, solution.Source);
}

Eigen::MatrixXd FieldStages::HarmonicFields() const
{
  return this->Internal->System->Setup->Setup->HarmonicFields();
}

const FieldStages::StageCounts& FieldStages::Counts() const
{
  return this->Internal->Counts;
}

double FieldStages::SetupSeconds() const
{
  return this->Internal->SecondsOfOperators + this->Internal->Setups.back()->Seconds;
}

}
