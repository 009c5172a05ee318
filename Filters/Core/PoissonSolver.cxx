#include "PoissonSolver.h"

#include "Discretisations/MakeDiscretisation.h"
#include "FieldSetup.h"
#include "Operators/ExteriorCalculus.h"
#include "Solvers/HarmonicProblem.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

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

/// A sum that is smaller, relative to the sum of magnitudes, is rounding.
constexpr double RoundingOfSums = 1e-9;

/// The part of a solver that depends on the surface alone.
struct SetupOfSurface
{
  SetupOfSurface(const FramedMesh& surface, const SolverOptions& asked, const ExecutionContext& context);

  const FramedMesh& Surface;
  SolverOptions Options;
  std::vector<int> Components; ///< by vertex
  Vector<double> Areas;        ///< Star0
  SolverPlan Plan;
  std::shared_ptr<const MultigridSetup> Levels; ///< or the matrix to factor
  int NumberOfSetups = 0;
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

std::vector<int> ComponentsOfVertices(const TriangleMesh& mesh)
{
  const std::vector<int> ofFaces = FaceComponents(mesh);
  std::vector<int> components(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    components[vertex] = ofFaces[TriangleMesh::FaceOf(mesh.OutgoingHalfedge(vertex))];
  }
  return components;
}

SetupOfSurface::SetupOfSurface(const FramedMesh& surface, const SolverOptions& asked, const ExecutionContext& context)
  : Surface(surface)
  , Options(OptionsOfFunctions(asked))
  , Components(ComponentsOfVertices(surface.Mesh))
  , Areas(Star0(surface.Mesh))
{
  FieldOptions options;
  options.Field.Kind = DiscretisationKind::ScalarFunction;
  options.Constraints = ConstraintKind::Hard;
  options.Solver = this->Options;
  const auto functions = MakeDiscretisation(options.Field, surface);
  constexpr bool HasHarmonicFields = false; // functions have none
  this->Plan = PlanSolver(*functions, options, nullptr, ObstaclesOf(surface.Mesh, HasHarmonicFields, context));
  this->Levels = MakeSetup(surface, *functions, nullptr, this->Plan, CoarseSpaceKind::LinearInterpolation, context);
  ++this->NumberOfSetups;
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

  /// Makes the source of each component without held vertices sum to zero.
  void Balance(Vector<double>& source, NetSource net) const;
  /// Makes the mean of u zero there.
  void Centre(Vector<double>& u) const;
  /// Shifts a centred function to where the solver has it.
  Vector<double> ZeroAtGrounded(const Vector<double>& start) const;
  Vector<double> ValuesOfGrounded(const Vector<double>& values) const;

  const std::shared_ptr<const SetupOfSurface> Setup;
  const std::vector<int> Held;
  std::vector<int> Grounded;              ///< held, and a vertex of each component without, ascending
  std::vector<char> AreFree;              ///< by component: no vertex is held
  std::optional<HarmonicProblem> Problem; ///< none where all vertices are held
  SolveReport ReportOfHeld;

private:
  /// Sums by component where no vertex is held; zero elsewhere.
  Vector<double> SumsOfFree(const Vector<double>& numbers) const;
  void AddToFree(const Vector<double>& byComponent, Vector<double>& numbers) const;
};

PoissonSolver::Internals::Internals(
  std::shared_ptr<const SetupOfSurface> setup, std::vector<int> held, const ExecutionContext& context)
  : Setup(std::move(setup))
  , Held(std::move(held))
{
  const std::vector<int>& components = this->Setup->Components;
  const int vertices = static_cast<int>(components.size());
  this->AreFree.assign(*std::max_element(components.begin(), components.end()) + 1, 1);
  for (const int vertex : this->Held)
  {
    this->AreFree[components[vertex]] = 0;
  }
  std::vector<int> firsts;
  std::vector<char> isGrounded(this->AreFree.size(), 0);
  for (int vertex = 0; vertex < vertices; ++vertex)
  {
    if (this->AreFree[components[vertex]] && !isGrounded[components[vertex]])
    {
      isGrounded[components[vertex]] = 1;
      firsts.push_back(vertex);
    }
  }
  std::merge(this->Held.begin(), this->Held.end(), firsts.begin(), firsts.end(), std::back_inserter(this->Grounded));
  this->ReportOfHeld.Solver = "none, as all values are given";
  this->ReportOfHeld.Converged = true;
  if (static_cast<int>(this->Grounded.size()) < vertices)
  {
    this->Problem.emplace(this->Setup->Levels, Penalties{ ConstraintKind::Hard, this->Grounded, {} }, 1.0,
      this->Setup->Options, this->Setup->Plan.ChoiceOn(*this->Setup->Levels), context);
  }
}

Vector<double> PoissonSolver::Internals::SumsOfFree(const Vector<double>& numbers) const
{
  Vector<double> sums = Vector<double>::Zero(static_cast<Eigen::Index>(this->AreFree.size()));
  for (Eigen::Index vertex = 0; vertex < numbers.size(); ++vertex)
  {
    const int component = this->Setup->Components[vertex];
    sums[component] += this->AreFree[component] ? numbers[vertex] : 0.0;
  }
  return sums;
}

void PoissonSolver::Internals::AddToFree(const Vector<double>& byComponent, Vector<double>& numbers) const
{
  for (Eigen::Index vertex = 0; vertex < numbers.size(); ++vertex)
  {
    const int component = this->Setup->Components[vertex];
    if (this->AreFree[component])
    {
      numbers[vertex] += byComponent[component];
    }
  }
}

void PoissonSolver::Internals::Balance(Vector<double>& source, NetSource net) const
{
  const Vector<double> sums = this->SumsOfFree(source);
  const Vector<double> magnitudes = this->SumsOfFree(source.cwiseAbs());
  const Vector<double> areas = this->SumsOfFree(this->Setup->Areas);
  for (Eigen::Index component = 0; component < sums.size() && net == NetSource::Refuse; ++component)
  {
    if (std::abs(sums[component]) > RoundingOfSums * magnitudes[component])
    {
      throw InvalidInput("the source sums to " + ShortText(sums[component]) +
        (sums.size() > 1 ? " on component " + std::to_string(component) : std::string()) +
        ", where no value is held and nothing leaves; hold a value there, or take its mean out (NetSource::TakeOut)");
    }
  }
  if (net == NetSource::TakeOut)
  {
    for (Eigen::Index vertex = 0; vertex < source.size(); ++vertex)
    {
      const int component = this->Setup->Components[vertex];
      source[vertex] -=
        this->AreFree[component] ? this->Setup->Areas[vertex] * (sums[component] / areas[component]) : 0.0;
    }
  }
}

void PoissonSolver::Internals::Centre(Vector<double>& u) const
{
  if (std::find(this->AreFree.begin(), this->AreFree.end(), 1) == this->AreFree.end())
  {
    return;
  }
  Vector<double> shifts = this->SumsOfFree(this->Setup->Areas.cwiseProduct(u));
  const Vector<double> areas = this->SumsOfFree(this->Setup->Areas);
  for (Eigen::Index component = 0; component < shifts.size(); ++component)
  {
    shifts[component] = this->AreFree[component] ? -shifts[component] / areas[component] : 0.0;
  }
  this->AddToFree(shifts, u);
}

Vector<double> PoissonSolver::Internals::ZeroAtGrounded(const Vector<double>& start) const
{
  Vector<double> shifts = Vector<double>::Zero(static_cast<Eigen::Index>(this->AreFree.size()));
  for (const int vertex : this->Grounded)
  {
    shifts[this->Setup->Components[vertex]] = -start[vertex];
  }
  Vector<double> shifted = start;
  this->AddToFree(shifts, shifted);
  return shifted;
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
{
  CheckHeld(held, surface.Mesh.NumberOfVertices());
  auto setup = std::make_shared<const SetupOfSurface>(surface, options, PartOfContext(context, 0.0, 0.7));
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
  of.Balance(source, net);
  Vector<double> u = of.ValuesOfGrounded(values); // of all vertices, where all are grounded
  if (of.Problem)
  {
    const Vector<double> shifted = start.size() > 0 ? of.ZeroAtGrounded(start) : start;
    u = of.Problem->Solve(u, shifted, {}, stop, context, source);
  }
  of.Centre(u);
  return u;
}

const SolveReport& PoissonSolver::Report() const
{
  return this->Internal->Problem ? this->Internal->Problem->Report() : this->Internal->ReportOfHeld;
}

int PoissonSolver::NumberOfSetups() const
{
  return this->Internal->Setup->NumberOfSetups;
}

const std::vector<int>& PoissonSolver::Held() const
{
  return this->Internal->Held;
}

}
