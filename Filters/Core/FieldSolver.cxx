#include "FieldSolver.h"

#include "Analysis/HarmonicForms.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Mesh/TriangleQuality.h"
#include "Operators/FluxAnisotropy.h"
#include "ProblemConstraints.h"
#include "Setup/FactorChoice.h"
#include "Setup/SetupCache.h"
#include "Setup/UnitLengthDiffusion.h"
#include "Singularities/SingularStages.h"
#include "Solvers/HarmonicProblem.h"
#include "Solvers/SolveInUnits.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace dmg
{
namespace
{

bool AreSame(const Vector<double>& a, const Vector<double>& b)
{
  return a.size() == b.size() && a == b;
}

/// All that a system depends on.
struct SystemKey
{
  std::shared_ptr<const MultigridSetup> Setup;
  FieldOptions Options;
  std::vector<int> Elements;
  std::vector<double> Weights;

  friend bool operator==(const SystemKey& a, const SystemKey& b)
  {
    const auto members = [](const SystemKey& key)
    {
      const auto& [setup, options, elements, weights] = key; // all of them, or it does not compile
      return std::tie(setup, options, elements, weights);
    };
    return members(a) == members(b);
  }
};

/// All that a solve depends on, besides the system.
struct SolveKey
{
  Vector<double> Values;
  Vector<double> Source;
  StoppingCriteria Stop;

  friend bool operator==(const SolveKey& a, const SolveKey& b)
  {
    return AreSame(a.Values, b.Values) && AreSame(a.Source, b.Source) && a.Stop == b.Stop;
  }
};

struct SystemStage
{
  SystemKey Key;
  HarmonicProblem Problem;
};

/// Whether two options differ in nothing but the weights of energies.
bool DifferInWeights(FieldOptions a, const FieldOptions& b)
{
  a.Smoothness = b.Smoothness;
  a.Alignment = b.Alignment;
  a.Constraints = b.Constraints;
  return a == b;
}

/// The share of the surface from which on sheared triangles are worth a note.
constexpr double NotableShare = 0.2;

std::string WarningOfShear(double share)
{
  return std::to_string(std::lround(100.0 * share)) +
    " % of the surface have sheared triangles, as grids have, where power fields on faces are inaccurate at any "
    "resolution; " +
    TextOf(Remedy::FieldAtPoints);
}

/// Cycles leave errors of 1-forms and of face fields along thin triangles that neither they nor their estimate of the error see.
constexpr double ShareWithoutEstimate = 0.5;

std::string WarningOfThinTriangles(double share)
{
  return std::to_string(std::lround(100.0 * share)) +
    " % of the triangles are thin, where cycles cannot estimate the error and may say too early that they have "
    "converged; choose an automatic solver or Cholesky";
}

/// A vertex that shall be singular has no direction: all of those around it belong to it alike.
void ClearSingularVertices(Field& field)
{
  for (int vertex = 0; vertex < field.Indices.size(); ++vertex)
  {
    if (field.Indices[vertex] != 0.0)
    {
      field.Powers.Vertices[vertex] = 0.0;
      field.AtVertices[vertex] = 0.0;
    }
  }
}

}

/// Each stage is built as a whole and then put in place, and takes away the later ones that refer to it: a run that stops
/// half-way leaves nothing half-made.
class FieldSolver::Internals
{
public:
  explicit Internals(
    std::shared_ptr<const FramedMesh> surface, std::unique_ptr<const VertexConnection> connection = nullptr)
    : Shared(std::move(surface))
    , Setups(this->Surface)
    , Singular(this->Surface, this->Setups)
    , ConstraintsOfSurface(this->Surface)
    , GivenConnection(std::move(connection))
  {
  }

  void SetDiscretisation(const DiscretisationOptions& options);
  /// The solution of a field that follows constraints.
  std::shared_ptr<const FieldSolution> Solve(const FieldProblem& problem, const Constraints& constraints,
    const ExecutionContext& context, const ElementNames& names);
  void FindDirections(std::shared_ptr<const FieldSolution> solution, const FieldProblem& problem,
    FollowedConstraints followed, const ExecutionContext& context);
  /// Adds a warning where the discretisation is inaccurate on sheared triangles.
  void WarnOfShear(const FieldProblem& problem, std::vector<std::string>& warnings, const ExecutionContext& context);
  void FindBasis(const FieldProblem& problem, const ExecutionContext& context);
  LinearSystem Equations(const ExecutionContext& context) const
  {
    return this->System->Problem.Equations(this->KeyOfSolution->Values, context, this->KeyOfSolution->Source);
  }

  const std::shared_ptr<const FramedMesh> Shared;
  const FramedMesh& Surface = *Shared;
  std::shared_ptr<const ProlongationOperators> GivenOperators;
  SetupCache Setups;
  SingularStages Singular;
  ConstraintsOnMesh ConstraintsOfSurface;
  const std::unique_ptr<const VertexConnection> GivenConnection; ///< null: that of the surface
  std::shared_ptr<const dmg::Discretisation> Discretisation;     ///< of the solve that goes on
  StageCounts Counts;
  Field Last; ///< whose directions may be those of an earlier solution

private:
  void MakeSystem(const PlannedSetup& setup, const FieldConstraints& constraints, const FieldOptions& options,
    const ExecutionContext& context);
  bool UpdateSystem(SystemKey& key, const Penalties& penalties, const ExecutionContext& context);
  /// \param startsAnew not from the last solution, so that former solves have no influence.
  void SolveSystem(const FieldConstraints& constraints, const StoppingCriteria& stop, const PlannedSetup& setup,
    bool startsAnew, const ExecutionContext& context);
  /// The solution, diffused at unit length.
  std::shared_ptr<const FieldSolution> Diffuse(
    const FieldProblem& problem, const PlannedSetup& setup, const ExecutionContext& context);

  std::optional<double> ShearedShare; ///< of the surface
  DiscretisationOptions OptionsOfDiscretisation;
  DiscretisationOptions OptionsOfBasis;
  std::shared_ptr<const Eigen::MatrixXd> Basis;

  bool HasSetup = false;
  std::unique_ptr<SystemStage> System;
  std::optional<SolveKey> KeyOfSolution;
  std::shared_ptr<const FieldSolution> Solution; ///< of this key; without one, where the next solve starts
  bool HasStartedAnew = false;                   ///< whether no former solution had an influence on this one
  std::shared_ptr<const FieldSolution> Diffused; ///< at unit length
  std::shared_ptr<const FieldSolution> StartOfDiffused;
};

void FieldSolver::Internals::SetDiscretisation(const DiscretisationOptions& options)
{
  if (!this->Discretisation || !(this->OptionsOfDiscretisation == OptionsThatCount(options)))
  {
    this->Discretisation = MakeDiscretisation(options, this->Surface, this->GivenConnection.get());
    this->OptionsOfDiscretisation = OptionsThatCount(options);
  }
}

std::shared_ptr<const FieldSolution> FieldSolver::Internals::Solve(const FieldProblem& problem,
  const Constraints& constraints, const ExecutionContext& context, const ElementNames& names)
{
  const FieldOptions& options = problem.Options;
  const bool isDiffused = problem.UnitLengthWhileSmoothing && HaveLengths(*this->Discretisation);
  const FieldConstraints onElements =
    this->Discretisation->Prescribe(isDiffused ? AtUnitLength(constraints, this->Surface) : constraints, names);
  CheckSizes(constraints, names);
  const double solved = isDiffused ? 0.3 : 1.0;
  const PartOfContext first(context, 0.0, solved);
  const PlannedSetup setup =
    this->Setups.Take(*this->Discretisation, options, this->GivenOperators, PartOfContext(first, 0.0, 0.5));
  const bool isFirst = !std::exchange(this->HasSetup, true);
  this->Counts.Setups += isFirst || setup.HasNewLevels;
  if (onElements.Source.size() > 0 && setup.Choice.Method->IsApproximation())
  {
    throw InvalidInput("nested iterations and coarse prolongations take no source; choose another solver");
  }
  this->MakeSystem(setup, onElements, options, PartOfContext(first, 0.5, 0.75));
  // Diffusion makes the least difference of its start large where singularities balance by symmetry.
  this->SolveSystem(onElements, problem.Stop, setup, isDiffused, PartOfContext(first, 0.75, 1.0));
  context.Checkpoint(solved);
  return isDiffused ? this->Diffuse(problem, setup, PartOfContext(context, solved, 1.0)) : this->Solution;
}

std::shared_ptr<const FieldSolution> FieldSolver::Internals::Diffuse(
  const FieldProblem& problem, const PlannedSetup& setup, const ExecutionContext& context)
{
  if (this->StartOfDiffused != this->Solution)
  {
    this->Diffused = std::make_shared<const FieldSolution>(
      DiffusedAtUnitLength(*this->Solution, setup, problem.Options, this->Surface.Mesh, problem.Stop, context)
        .Solution);
    this->StartOfDiffused = this->Solution;
  }
  return this->Diffused;
}

void FieldSolver::Internals::MakeSystem(const PlannedSetup& setup, const FieldConstraints& constraints,
  const FieldOptions& options, const ExecutionContext& context)
{
  SystemKey key{ setup.Levels, options, constraints.Elements, constraints.Weights };
  if (this->System && this->System->Key == key)
  {
    return;
  }
  Penalties penalties = this->Discretisation->PenaltiesOf(constraints, options.Weights(), context);
  if (this->UpdateSystem(key, penalties, context))
  {
    return;
  }
  HarmonicProblem problem(
    setup.Levels, std::move(penalties), options.Smoothness, options.Solver, setup.Choice, context);
  this->KeyOfSolution.reset();
  this->Solution.reset();
  this->System.reset(new SystemStage{ std::move(key), std::move(problem) });
  ++this->Counts.Systems;
}

/// Other constrained elements or weights. \return whether no more than these has changed.
bool FieldSolver::Internals::UpdateSystem(SystemKey& key, const Penalties& penalties, const ExecutionContext& context)
{
  if (!this->System || this->System->Key.Setup != key.Setup || !DifferInWeights(key.Options, this->System->Key.Options))
  {
    return false;
  }
  // Half-updated, it must not be seen again.
  std::unique_ptr<SystemStage> system = std::move(this->System);
  this->KeyOfSolution.reset();
  system->Problem.Update(penalties, key.Options.Smoothness, context);
  system->Key = std::move(key);
  this->System = std::move(system);
  ++this->Counts.Systems;
  return true;
}

void FieldSolver::Internals::SolveSystem(const FieldConstraints& constraints, const StoppingCriteria& stop,
  const PlannedSetup& setup, bool startsAnew, const ExecutionContext& context)
{
  const SolveKey key{ constraints.Values, constraints.Source, stop };
  if (this->KeyOfSolution && *this->KeyOfSolution == key && (this->HasStartedAnew || !startsAnew))
  {
    return;
  }
  startsAnew = startsAnew || !this->Solution;
  const Vector<double> start = startsAnew ? Vector<double>() : this->Solution->Unknowns;
  auto [unknowns, report] = SolveInUnits(this->System->Problem, key.Values, start, stop, context, key.Source);
  this->Discretisation->CentreFree(constraints, unknowns);
  if (this->Discretisation->HasHarmonicFields() && !setup.Choice.Method->IsDirect && report.Converged &&
    report.Warnings.empty()) // else a factor has taken over
  {
    const double share = ShareOfFacesBelow(ThinTriangleQuality, this->Surface.Mesh, context);
    if (share > ShareWithoutEstimate)
    {
      report.Warnings.push_back(WarningOfThinTriangles(share));
    }
  }
  this->Solution = std::make_shared<const FieldSolution>(
    FieldSolution{ this->Discretisation, constraints, std::move(unknowns), std::move(report), setup.Seconds, nullptr });
  this->KeyOfSolution = key;
  this->HasStartedAnew = startsAnew;
  ++this->Counts.Solves;
}

/// The warnings of the solver come once, where something was solved rather than kept.
void FieldSolver::Internals::FindDirections(std::shared_ptr<const FieldSolution> solution, const FieldProblem& problem,
  FollowedConstraints followed, const ExecutionContext& context)
{
  const bool isNew = this->Last.Solution != solution;
  if (isNew)
  {
    const std::vector<std::string>& more = solution->Report.Warnings;
    followed.Warnings.insert(followed.Warnings.end(), more.begin(), more.end());
    this->WarnOfShear(problem, followed.Warnings, context);
  }
  if (isNew || this->Last.IsCombed != problem.Combing)
  {
    Field field = DirectionsOfField(this->Surface, *solution->Discretisation, solution->Unknowns, problem.Combing,
      this->Last.Solution ? &this->Last : nullptr, context);
    field.Report = solution->Report;
    if (solution->Connection)
    {
      ClearSingularVertices(field);
    }
    field.Solution = std::move(solution);
    this->Last = std::move(field);
  }
  this->Last.HasUnitLength = problem.UnitLength;
  this->Last.Guides = followed.Guides;
  this->Last.Features = std::move(followed.Features);
  this->Last.Warnings = std::move(followed.Warnings);
}

void FieldSolver::Internals::WarnOfShear(
  const FieldProblem& problem, std::vector<std::string>& warnings, const ExecutionContext& context)
{
  if (this->Discretisation->IsAccurateOnShearedTriangles() || problem.Singularities)
  {
    return;
  }
  if (!this->ShearedShare)
  {
    this->ShearedShare = ShareOfShearedArea(this->Surface.Mesh, context);
  }
  if (*this->ShearedShare > NotableShare)
  {
    warnings.push_back(WarningOfShear(*this->ShearedShare));
  }
}

/// Once for a discretisation.
void FieldSolver::Internals::FindBasis(const FieldProblem& problem, const ExecutionContext& context)
{
  if (!problem.HarmonicBasis || !this->Discretisation->HasHarmonicFields())
  {
    this->Last.HarmonicBasis = nullptr;
    return;
  }
  if (!this->Basis || !(this->OptionsOfBasis == this->OptionsOfDiscretisation))
  {
    const int fields = this->Discretisation->NumberOfHarmonicFields();
    Eigen::MatrixXd basis(this->Discretisation->NumberOfUnknowns(), 0);
    if (AreTooManyToHold(fields, this->Surface.Mesh))
    {
      this->Last.Warnings.push_back("the surface has " + std::to_string(fields) +
        " harmonic fields, which are too many to hold; close its holes and remove its small handles first, or " +
        TextOf(Remedy::NoBasis));
    }
    else if (fields > 0)
    {
      basis = this->System->Key.Setup->HarmonicFields();
      basis = this->Discretisation->HarmonicBasis(basis.cols() > 0
          ? std::move(basis)
          : this->Discretisation->HarmonicFields(nullptr, PartOfContext(context, 0.0, 0.7)),
        PartOfContext(context, 0.7, 1.0));
    }
    this->Basis = std::make_shared<const Eigen::MatrixXd>(std::move(basis));
    this->OptionsOfBasis = this->OptionsOfDiscretisation;
  }
  this->Last.HarmonicBasis = this->Basis;
}

FieldSolver::FieldSolver(TriangleMesh mesh, const ExecutionContext& context)
  : FieldSolver(std::make_shared<const FramedMesh>(std::move(mesh), context))
{
}

FieldSolver::FieldSolver(std::shared_ptr<const FramedMesh> surface)
  : Internal(std::make_unique<Internals>(std::move(surface)))
{
}

FieldSolver::FieldSolver(std::shared_ptr<const FramedMesh> surface, const std::vector<double>& lengths)
{
  const bool arePositive =
    std::all_of(lengths.begin(), lengths.end(), [](double length) { return length > 0.0 && std::isfinite(length); });
  if (!arePositive || static_cast<int>(lengths.size()) != surface->Mesh.NumberOfVertices())
  {
    throw InvalidInput("there are " + std::to_string(lengths.size()) + " lengths for " +
      std::to_string(surface->Mesh.NumberOfVertices()) + " vertices, or one is not positive; give one for each");
  }
  auto connection = std::make_unique<VertexConnection>(*surface);
  connection->SetLengths(surface->Mesh, lengths);
  this->Internal = std::make_unique<Internals>(std::move(surface), std::move(connection));
}

FieldSolver::~FieldSolver() = default;

const FramedMesh& FieldSolver::Surface() const
{
  return this->Internal->Surface;
}

const NearestPlaces& FieldSolver::Places()
{
  return this->Internal->ConstraintsOfSurface.Places();
}

void FieldSolver::SetOperators(std::shared_ptr<const ProlongationOperators> operators)
{
  this->Internal->GivenOperators = std::move(operators);
}

void FieldSolver::SetMemoryLimit(long long bytes)
{
  this->Internal->Setups.SetMemoryLimit(bytes);
}

const Field& FieldSolver::Solve(const FieldProblem& problem, const ExecutionContext& context, const ElementNames& names)
{
  Internals& of = *this->Internal;
  const DiscretisationOptions field =
    problem.Singularities ? WithSingularitiesAtVertices(problem.Options.Field) : problem.Options.Field;
  of.SetDiscretisation(field);
  FollowedConstraints followed =
    of.ConstraintsOfSurface.Follow(problem, *of.Discretisation, PartOfContext(context, 0.0, 0.0), names);
  const PartOfContext most(context, 0.0, 0.9);
  auto solution = problem.Singularities
    ? of.Singular.Solve({ *problem.Singularities, field.N, problem.Stop, problem.Options.Solver }, of.Discretisation,
        followed.Constraints, most, names)
    : of.Solve(problem, followed.Constraints, most, names);
  of.FindDirections(std::move(solution), problem, std::move(followed), PartOfContext(context, 0.9, 1.0));
  of.FindBasis(problem, PartOfContext(context, 1.0, 1.0));
  return of.Last;
}

Points FieldSolver::Directions(int k) const
{
  return this->Internal->Last.DirectionsOnFaces(this->Surface(), k);
}

LinearSystem FieldSolver::Equations(const ExecutionContext& context) const
{
  return this->Internal->Equations(context);
}

StageCounts FieldSolver::Counts() const
{
  return this->Internal->Counts + this->Internal->Singular.Counts();
}

long long FieldSolver::Bytes() const
{
  return this->Internal->Last.Report.Bytes;
}

}
