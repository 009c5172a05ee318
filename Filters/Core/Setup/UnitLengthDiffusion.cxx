#include "Setup/UnitLengthDiffusion.h"

#include "Setup/UnitLengthEnergy.h"
#include "Solvers/SolveInUnits.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

// Lengths of diffusion over the root of the area.
constexpr double LongestLength = 0.32;
constexpr double ShortestLength = 0.02;
/// The shortest length of diffusion, in edges.
constexpr double FewestEdges = 1.5;
/// Over fewer edges a singularity moves less easily, so that it should stand where it belongs before.
constexpr double ManyEdges = 6.0;

/// The energy stands still when it has fallen by less than a share of itself over a number of steps.
constexpr std::size_t StepsOfTest = 5;
constexpr double FallOfLongLengths = 1e-4;  ///< where the next length goes on
constexpr double FallOfShortLengths = 1e-6; ///< of the last one, and of those of few edges
constexpr int MostSteps = 300;
/// The largest relative tolerance of a step's solve, whose start is near.
constexpr double ToleranceOfSteps = 1e-5;

std::vector<double> LengthsOfDiffusion(int numberOfVertices)
{
  const double shortest = std::min(LongestLength, std::max(ShortestLength, FewestEdges / std::sqrt(numberOfVertices)));
  std::vector<double> lengths;
  for (double length = LongestLength; length > std::sqrt(2.0) * shortest; length /= 2.0)
  {
    lengths.push_back(length);
  }
  lengths.push_back(shortest);
  return lengths;
}

/// Minimises the energy of one length by nonlinear conjugate gradients, preconditioned by steps of diffusion.
class Descent
{
public:
  Descent(const UnitLengthEnergy& energy, HarmonicProblem& problem, FieldOnLine field, const StoppingCriteria& stop)
    : Energy(energy)
    , Problem(problem)
    , Stop(stop)
    , Field(std::move(field))
  {
    this->Energies.push_back(energy.Value(this->Field));
  }

  /// \return whether the energy has fallen.
  bool Step(FieldSolution& solution, const ExecutionContext& context)
  {
    const Vector<double> downhill = this->StepOfDiffusion(solution, context);
    const Vector<double> gradient = this->Energy.HalfGradient(this->Field);
    const double slope = downhill.dot(gradient);
    if (!(slope < 0.0))
    {
      return false;
    }
    const bool isFirst = this->FormerSlope == 0.0;
    const double beta = isFirst ? 0.0 : std::max(0.0, (slope - downhill.dot(this->FormerGradient)) / this->FormerSlope);
    Vector<double> direction = isFirst ? downhill : Vector<double>(downhill + beta * this->Direction);
    bool hasFallen = direction.dot(gradient) < 0.0 && this->MoveAlong(direction, false, context);
    if (!hasFallen)
    {
      direction = downhill;
      hasFallen = this->MoveAlong(direction, true, context);
    }
    this->Direction = std::move(direction);
    this->FormerGradient = gradient;
    this->FormerSlope = slope;
    return hasFallen;
  }

  /// \param scale an energy that is small.
  bool StandsStill(double fall, double scale) const
  {
    const std::size_t size = this->Energies.size();
    return size > StepsOfTest &&
      this->Energies[size - 1 - StepsOfTest] - this->Energies.back() <= fall * (this->Energies.back() + scale);
  }

  const UnitLengthEnergy& Energy;
  HarmonicProblem& Problem;
  const StoppingCriteria Stop;
  FieldOnLine Field;
  std::vector<double> Energies;

private:
  Vector<double> StepOfDiffusion(FieldSolution& solution, const ExecutionContext& context)
  {
    const Vector<double>& x = this->Field.Unknowns;
    auto [unknowns, report] = SolveInUnits(this->Problem, this->Energy.ValuesOfStep(x), x, this->Stop, context);
    solution.Report.SolveSeconds += report.SolveSeconds;
    if (!report.Converged && solution.Report.Converged)
    {
      solution.Report.Converged = false;
      std::vector<std::string>& warnings = solution.Report.Warnings;
      warnings.insert(warnings.end(), report.Warnings.begin(), report.Warnings.end());
    }
    return unknowns - x;
  }

  /// \param isWhole whether the step has the length 1 rather than that of a line search.
  bool MoveAlong(const Vector<double>& direction, bool isWhole, const ExecutionContext& context)
  {
    const FieldOnLine line = this->Energy.WithProduct(direction, context);
    const double step = isWhole ? 1.0 : this->Energy.StepAlong(line, this->Field, 1.0);
    FieldOnLine moved = this->Field.Plus(step, line);
    const double energy = this->Energy.Value(moved);
    if (!(energy < this->Energies.back()))
    {
      return false;
    }
    this->Field = std::move(moved);
    this->Energies.push_back(energy);
    return true;
  }

  Vector<double> Direction;
  Vector<double> FormerGradient;
  double FormerSlope = 0.0;
};

void SetUnitLength(std::vector<Constraint>& constraints, const TangentFrames& frames)
{
  for (Constraint& constraint : constraints)
  {
    const bool isThere = constraint.Element >= 0 && constraint.Element < frames.X.rows(); // else a later check names it
    const double length = isThere ? std::abs(frames.ToComplex(constraint.Element, constraint.Direction)) : 0.0;
    if (length > 0.0 && std::isfinite(length))
    {
      constraint.Direction /= length;
    }
  }
}

}

bool HaveLengths(const Discretisation& discretisation)
{
  return discretisation.UnknownsPerElement() == 2;
}

Constraints AtUnitLength(Constraints constraints, const FramedMesh& surface)
{
  SetUnitLength(constraints.OnFaces, surface.Faces);
  SetUnitLength(constraints.AtVertices, surface.Vertices);
  return constraints;
}

DiffusedField DiffusedAtUnitLength(const FieldSolution& start, const PlannedSetup& setup, const FieldOptions& options,
  const TriangleMesh& surface, const StoppingCriteria& stop, const ExecutionContext& context)
{
  UnitLengthEnergy energy(start, options, *setup.Levels, context);
  StoppingCriteria stopOfSteps = stop;
  stopOfSteps.RelativeTolerance = std::min(stop.RelativeTolerance, ToleranceOfSteps);
  const double area = surface.FaceAreas().sum();
  const std::vector<double> lengths = LengthsOfDiffusion(surface.NumberOfVertices());
  DiffusedField diffused{ start, {} };
  FieldOnLine field = energy.Held(start.Unknowns, context);
  std::unique_ptr<HarmonicProblem> problem;
  for (std::size_t k = 0; k < lengths.size(); ++k)
  {
    const PartOfContext part(context, static_cast<double>(k) / lengths.size(), (k + 1.0) / lengths.size());
    energy.SetWeight(options.Smoothness / (lengths[k] * lengths[k] * area));
    if (problem)
    {
      problem->Update(energy.PenaltiesOfStep(), options.Smoothness, PartOfContext(part, 0.0, 0.2));
    }
    else
    {
      problem = std::make_unique<HarmonicProblem>(setup.Levels, energy.PenaltiesOfStep(), options.Smoothness,
        options.Solver, setup.Choice, PartOfContext(part, 0.0, 0.2));
    }
    const bool isShort = k + 1 == lengths.size() || lengths[k] * std::sqrt(surface.NumberOfVertices()) < ManyEdges;
    const double fall = isShort ? FallOfShortLengths : FallOfLongLengths;
    Descent descent(energy, *problem, std::move(field), stopOfSteps);
    bool isFalling = true;
    for (int step = 0; step < MostSteps && isFalling && !descent.StandsStill(fall, options.Smoothness); ++step)
    {
      const auto done = [](int steps)
      { return 0.2 + 0.8 * steps / (steps + 10.0); }; // nobody knows how many there will be
      isFalling = descent.Step(diffused.Solution, PartOfContext(part, done(step), done(step + 1)));
    }
    field = std::move(descent.Field);
    diffused.Energies.push_back(std::move(descent.Energies));
  }
  diffused.Solution.Unknowns = std::move(field.Unknowns);
  return diffused;
}

}
