#include "Setup/PoissonSolver.h"

#include "Discretisations/ScalarFunction.h"
#include "Setup/SetupCache.h"
#include "Solvers/SolveInUnits.h"
#include "Support/Errors.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// Other options have no meaning for functions with sources.
SolverOptions OptionsOfFunctions(const SolverOptions& asked)
{
  SolverOptions options;
  options.Kind = MethodOf(asked.Kind).IsApproximation() ? SolverKind::Automatic : asked.Kind;
  options.ExpectedSolves = asked.ExpectedSolves;
  options.Sweeps = asked.Sweeps;
  return options;
}

void CheckFixed(const std::vector<int>& fixed, int numberOfVertices)
{
  for (std::size_t k = 0; k < fixed.size(); ++k)
  {
    const bool isInRange = fixed[k] >= 0 && fixed[k] < numberOfVertices;
    if (!isInRange || (k > 0 && fixed[k] <= fixed[k - 1]))
    {
      throw InvalidInput("the fixed vertex " + std::to_string(fixed[k]) +
        (isInRange ? " does not follow a smaller one; sort fixed vertices, and name each once"
                   : " is not one of the " + std::to_string(numberOfVertices) + " vertices"));
    }
  }
}

/// \throw InvalidInput numbers, which may be left out, are not as many as expected or not finite.
void CheckNumbers(const Vector<double>& numbers, Eigen::Index expected, const std::string& name)
{
  if (numbers.size() != 0 && numbers.size() != expected)
  {
    throw InvalidInput("the " + name + " has " + std::to_string(numbers.size()) + " numbers in place of " +
      std::to_string(expected) + "; give one for each, or none for zero");
  }
  for (Eigen::Index k = 0; k < numbers.size(); ++k)
  {
    if (!std::isfinite(numbers[k]))
    {
      throw InvalidInput("number " + std::to_string(k) + " of the " + name + " is not finite; repair it");
    }
  }
}

}

class PoissonSolver::Internals
{
public:
  Internals(SetupCache& setups, std::vector<int> fixed, const SolverOptions& asked, const ExecutionContext& context);

  /// The constraints of a solve, on fixed vertices and on those that have to be pinned.
  FieldConstraints Prescribe(const Vector<double>& values, const Vector<double>& source, NetSource net) const;

  const FramedMesh& Surface;
  const std::vector<int> Fixed;
  const ScalarFunction Functions;
  PlannedSetup Setup;
  std::optional<HarmonicProblem> Problem; ///< none where all vertices are fixed
  SolveReport Report;
};

PoissonSolver::Internals::Internals(
  SetupCache& setups, std::vector<int> fixed, const SolverOptions& asked, const ExecutionContext& context)
  : Surface(setups.Surface)
  , Fixed(std::move(fixed))
  , Functions(setups.Surface, DiscretisationOptions().Areas)
{
  CheckFixed(this->Fixed, this->Surface.Mesh.NumberOfVertices());
  FieldOptions options;
  options.Field = DiscretisationOptions::OfFunctions();
  options.Constraints = ConstraintKind::Hard;
  options.Solver = OptionsOfFunctions(asked);
  this->Setup = setups.Take(this->Functions, options, nullptr, PartOfContext(context, 0.0, 0.7));
  const FieldConstraints constraints = this->Prescribe({}, {}, NetSource::Refuse);
  if (static_cast<int>(constraints.Elements.size()) == this->Functions.NumberOfUnknowns())
  {
    this->Report.Solver = "none, as all values are given";
    this->Report.Converged = true;
    return;
  }
  const Penalties penalties = this->Functions.PenaltiesOf(constraints, options.Weights(), context);
  this->Problem.emplace(this->Setup.Levels, penalties, options.Smoothness, options.Solver, this->Setup.Choice,
    PartOfContext(context, 0.7, 1.0));
  this->Report = this->Problem->Report();
}

FieldConstraints PoissonSolver::Internals::Prescribe(
  const Vector<double>& values, const Vector<double>& source, NetSource net) const
{
  FieldConstraints constraints;
  constraints.Elements = this->Fixed;
  constraints.Weights.assign(this->Fixed.size(), 1.0);
  constraints.Values = values.size() > 0 ? values : Vector<double>::Zero(static_cast<Eigen::Index>(this->Fixed.size()));
  constraints.Source = source;
  this->Functions.PinFree(net, constraints);
  return constraints;
}

PoissonSolver::PoissonSolver(
  const FramedMesh& surface, std::vector<int> fixed, const SolverOptions& options, const ExecutionContext& context)
  : PoissonSolver(*std::make_unique<SetupCache>(surface), std::move(fixed), options, context)
{
}

PoissonSolver::PoissonSolver(
  SetupCache& setups, std::vector<int> fixed, const SolverOptions& options, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(setups, std::move(fixed), options, context))
{
}

PoissonSolver::~PoissonSolver() = default;

PoissonSolver::PoissonSolver(PoissonSolver&&) noexcept = default;

Vector<double> PoissonSolver::Solve(const Vector<double>& source, const Vector<double>& values,
  const StoppingCriteria& stop, const ExecutionContext& context, NetSource net, const Vector<double>& start)
{
  Internals& of = *this->Internal;
  CheckNumbers(source, of.Functions.NumberOfUnknowns(), "source");
  CheckNumbers(values, static_cast<Eigen::Index>(of.Fixed.size()), "list of fixed values");
  CheckNumbers(start, of.Functions.NumberOfUnknowns(), "first guess");
  const FieldConstraints constraints = of.Prescribe(values, source, net);
  if (!of.Problem)
  {
    return constraints.Values;
  }
  Vector<double> shifted = start;
  if (start.size() > 0)
  {
    of.Functions.VanishAtPinned(constraints, shifted);
  }
  auto [u, report] = SolveInUnits(*of.Problem, constraints.Values, shifted, stop, context, constraints.Source);
  of.Report = std::move(report);
  of.Functions.CentreFree(constraints, u);
  return std::move(u);
}

const SolveReport& PoissonSolver::Report() const
{
  return this->Internal->Report;
}

bool PoissonSolver::HasNewSetup() const
{
  return this->Internal->Setup.IsNew;
}

const std::vector<int>& PoissonSolver::Fixed() const
{
  return this->Internal->Fixed;
}

}
