#include "Setup/PoissonSolver.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Operators/ExteriorCalculus.h"
#include "Setup/SetupCache.h"
#include "Solvers/HarmonicProblem.h"
#include "Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// The part of a solver that depends on the surface alone.
struct SetupOfSurface
{
  SetupOfSurface(SetupCache& setups, const SolverOptions& asked, const ExecutionContext& context);

  const FramedMesh& Surface;
  SolverOptions Options;
  std::vector<int> Components; ///< by vertex
  Vector<double> Areas;        ///< Star0
  PlannedSetup Planned;
};

/// Other options have no meaning for functions with sources.
SolverOptions OptionsOfFunctions(const SolverOptions& asked)
{
  SolverOptions options;
  options.Kind = MethodOf(asked.Kind).IsApproximation() ? SolverKind::Automatic : asked.Kind;
  options.ExpectedSolves = asked.ExpectedSolves;
  options.Sweeps = asked.Sweeps;
  return options;
}

SetupOfSurface::SetupOfSurface(SetupCache& setups, const SolverOptions& asked, const ExecutionContext& context)
  : Surface(setups.Surface)
  , Options(OptionsOfFunctions(asked))
  , Components(VertexComponents(setups.Surface.Mesh))
  , Areas(Star0(setups.Surface.Mesh))
{
  FieldOptions options;
  options.Field = DiscretisationOptions::OfFunctions();
  options.Constraints = ConstraintKind::Hard;
  options.Solver = this->Options;
  const auto functions = MakeDiscretisation(options.Field, this->Surface);
  this->Planned = setups.Take(*functions, options, nullptr, context);
}

void CheckHeld(const std::vector<int>& held, int numberOfVertices)
{
  for (std::size_t k = 0; k < held.size(); ++k)
  {
    const bool isInRange = held[k] >= 0 && held[k] < numberOfVertices;
    if (!isInRange || (k > 0 && held[k] <= held[k - 1]))
    {
      throw InvalidInput("the held vertex " + std::to_string(held[k]) +
        (isInRange ? " does not follow a smaller one; sort held vertices, and name each once"
                   : " is not one of the " + std::to_string(numberOfVertices) + " vertices"));
    }
  }
}

/// The size of numbers that may be left out.
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
  Internals(std::shared_ptr<const SetupOfSurface> setup, std::vector<int> held, const ExecutionContext& context);

  Vector<double> ValuesOfGrounded(const Vector<double>& values) const;

  const std::shared_ptr<const SetupOfSurface> Setup;
  const std::vector<int> Held;
  const FreeComponents Free;
  std::vector<int> Grounded;              ///< held, and a vertex of each component without, ascending
  std::optional<HarmonicProblem> Problem; ///< none where all vertices are held
  SolveReport ReportOfHeld;
};

PoissonSolver::Internals::Internals(
  std::shared_ptr<const SetupOfSurface> setup, std::vector<int> held, const ExecutionContext& context)
  : Setup(std::move(setup))
  , Held(std::move(held))
  , Free(Setup->Components, Held)
{
  const std::vector<int> firsts = this->Free.FirstVertices();
  std::merge(this->Held.begin(), this->Held.end(), firsts.begin(), firsts.end(), std::back_inserter(this->Grounded));
  this->ReportOfHeld.Solver = "none, as all values are given";
  this->ReportOfHeld.Converged = true;
  if (this->Grounded.size() < this->Setup->Components.size())
  {
    this->Problem.emplace(this->Setup->Planned.Levels, Penalties{ ConstraintKind::Hard, this->Grounded, {} }, 1.0,
      this->Setup->Options, this->Setup->Planned.Choice, context);
  }
}

Vector<double> PoissonSolver::Internals::ValuesOfGrounded(const Vector<double>& values) const
{
  Vector<double> all = Vector<double>::Zero(static_cast<Eigen::Index>(this->Grounded.size()));
  std::size_t k = 0;
  for (Eigen::Index held = 0; held < values.size(); ++held)
  {
    while (this->Grounded[k] != this->Held[held])
    {
      ++k;
    }
    all[static_cast<Eigen::Index>(k)] = values[held];
  }
  return all;
}

PoissonSolver::PoissonSolver(
  const FramedMesh& surface, std::vector<int> held, const SolverOptions& options, const ExecutionContext& context)
  : PoissonSolver(*std::make_unique<SetupCache>(surface), std::move(held), options, context)
{
}

PoissonSolver::PoissonSolver(
  SetupCache& setups, std::vector<int> held, const SolverOptions& options, const ExecutionContext& context)
{
  CheckHeld(held, setups.Surface.Mesh.NumberOfVertices());
  auto setup = std::make_shared<const SetupOfSurface>(setups, options, PartOfContext(context, 0.0, 0.7));
  this->Internal = std::make_unique<Internals>(std::move(setup), std::move(held), PartOfContext(context, 0.7, 1.0));
}

PoissonSolver::PoissonSolver(const PoissonSolver& other, std::vector<int> held, const ExecutionContext& context)
{
  CheckHeld(held, other.Internal->Setup->Surface.Mesh.NumberOfVertices());
  this->Internal = std::make_unique<Internals>(other.Internal->Setup, std::move(held), context);
}

PoissonSolver::~PoissonSolver() = default;

PoissonSolver::PoissonSolver(PoissonSolver&&) noexcept = default;

Vector<double> PoissonSolver::Solve(const Vector<double>& asked, const Vector<double>& values,
  const StoppingCriteria& stop, const ExecutionContext& context, NetSource net, const Vector<double>& start)
{
  Internals& of = *this->Internal;
  CheckNumbers(asked, static_cast<Eigen::Index>(of.Setup->Components.size()), "source");
  CheckNumbers(values, static_cast<Eigen::Index>(of.Held.size()), "list of held values");
  CheckNumbers(start, static_cast<Eigen::Index>(of.Setup->Components.size()), "first guess");
  Vector<double> source = asked;
  if (source.size() > 0)
  {
    of.Free.Balance(source, of.Setup->Areas, net);
  }
  Vector<double> u = of.ValuesOfGrounded(values); // of all vertices, where all are grounded
  if (of.Problem)
  {
    Vector<double> shifted = start; // to where the solver has it
    if (start.size() > 0)
    {
      of.Free.MakeZeroAt(of.Grounded, shifted);
    }
    u = of.Problem->Solve(u, shifted, {}, stop, context, source);
  }
  of.Free.Centre(u, of.Setup->Areas);
  return u;
}

const SolveReport& PoissonSolver::Report() const
{
  return this->Internal->Problem ? this->Internal->Problem->Report() : this->Internal->ReportOfHeld;
}

int PoissonSolver::NumberOfSetups() const
{
  return this->Internal->Setup->Planned.IsNew ? 1 : 0;
}

const std::vector<int>& PoissonSolver::Held() const
{
  return this->Internal->Held;
}

}
