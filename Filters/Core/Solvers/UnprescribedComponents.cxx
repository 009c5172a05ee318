#include "Solvers/UnprescribedComponents.h"

#include "Solvers/Krylov/LowestEigenvectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{
namespace
{

/// The end of an iteration for the smoothest field. Vectors of eigenvalues that are closer to each other than its residual are not told
/// apart. At a residual of 1e-4 the next eigenvectors may still turn the field by many degrees where it is small, so that it has to be
/// smaller than the tolerance. Rounding errors bound it below.
StoppingCriteria StopOfSmoothest(const StoppingCriteria& stop)
{
  constexpr double Share = 1e-2;
  constexpr double Smallest = 1e-8;
  // Eigenvectors part slowly where many eigenvalues are close together, as on spheres.
  constexpr int Patience = 3;
  const bool isLarge = stop.MaximumIterations > std::numeric_limits<int>::max() / Patience;
  return { std::max(Smallest, Share * stop.RelativeTolerance),
    isLarge ? stop.MaximumIterations : Patience * stop.MaximumIterations };
}

/// The multiple of the mass that is about the lowest eigenvalue of a component. A surface of size L has eigenvalues from about
/// 1 / L^2 to 1 / h^2, where the diagonal is. The areas h^2 of its triangles sum to L^2. Triangles that are much smaller than
/// others, as on the rim of a thin plate, add little to the sum.
/// \param sumOfMassOverStiffness over the unknowns of the component, of the mass over the diagonal of R.
double ShiftOfSmoothest(double sumOfMassOverStiffness)
{
  return sumOfMassOverStiffness > 0.0 ? 1.0 / sumOfMassOverStiffness : 1.0; // a triangle alone has no smoothness energy
}

MeasureOfFields MeasureOf(const MultigridSetup& setup)
{
  const StiffnessHierarchy& hierarchy = *setup.Hierarchy;
  const int unknownsPerMass = hierarchy.NumberOfUnknowns() / std::max(1, static_cast<int>(setup.Mass.size()));
  return { setup.Mass, unknownsPerMass, [&hierarchy](int i) { return hierarchy.DiagonalOf(i); },
    [&hierarchy](int i) { return hierarchy.ComponentOf(i); }, hierarchy.NumberOfComponents(), setup.Mass.sum(),
    setup.SquaredNormOfUnit, setup.Area };
}

}

UnprescribedComponents::UnprescribedComponents(
  const MultigridSetup& setup, const std::vector<int>& unknowns, const ExecutionContext& context)
  : UnprescribedComponents(MeasureOf(setup), unknowns, context)
{
}

UnprescribedComponents::UnprescribedComponents(
  const MeasureOfFields& measure, const std::vector<int>& unknowns, const ExecutionContext& context)
  : Mass(&measure.Mass)
  , UnknownsPerMass(measure.UnknownsPerMass)
  , ByComponent(SortByKey(unknowns, measure.NumberOfComponents, measure.ComponentOf, context))
  , Shifts(measure.NumberOfComponents, 0.0)
  , Lengths(measure.NumberOfComponents, 0.0)
  , SquaredNormOfUnit(measure.SquaredNormOfUnit)
  , Area(measure.Area)
  , SumOverProcesses(measure.SumOverProcesses)
{
  for (std::size_t component = 0; component < this->Shifts.size(); ++component)
  {
    for (int item = this->ByComponent.Begins[component]; item < this->ByComponent.Begins[component + 1]; ++item)
    {
      const int unknown = this->ByComponent.Items[item];
      const double stiffness = measure.DiagonalOf(unknown);
      this->Shifts[component] += stiffness > 0.0 ? this->MassOf(unknown) / stiffness : 0.0; // an area
      this->Lengths[component] += this->MassOf(unknown);
    }
  }
  if (this->SumOverProcesses)
  {
    this->SumOverProcesses(this->Shifts.data(), measure.NumberOfComponents);
    this->SumOverProcesses(this->Lengths.data(), measure.NumberOfComponents);
  }
  const double massOfUnknowns = measure.TotalMass * this->UnknownsPerMass;
  for (std::size_t component = 0; component < this->Shifts.size(); ++component)
  {
    this->Shifts[component] = ShiftOfSmoothest(this->Shifts[component]);
    this->Lengths[component] = std::sqrt(this->Lengths[component] / massOfUnknowns * measure.SquaredNormOfUnit);
  }
}

bool UnprescribedComponents::AreAny() const
{
  return std::any_of(this->Lengths.begin(), this->Lengths.end(), [](double length) { return length > 0.0; });
}

void UnprescribedComponents::SetDiagonal(Vector<double>& D) const
{
  for (std::size_t component = 0; component < this->Shifts.size(); ++component)
  {
    for (int item = this->ByComponent.Begins[component]; item < this->ByComponent.Begins[component + 1]; ++item)
    {
      const int unknown = this->ByComponent.Items[item];
      D[unknown] = this->Shifts[component] * this->MassOf(unknown);
    }
  }
}

Vector<double> UnprescribedComponents::StartFrom(StiffnessCycle& cycle, const ExecutionContext& context) const
{
  const ShiftedParts parts{ *this->Mass, this->UnknownsPerMass, this->ByComponent, this->Shifts };
  Vector<double> start = cycle.CoarseEigenvectors(parts, context);
  return start.size() > 0 ? start : Vector<double>::Zero(this->Mass->size() * this->UnknownsPerMass);
}

std::vector<IterationReport> UnprescribedComponents::FindSmoothest(const LinearOperator<double>& A,
  Preconditioner<double>& inverse, Vector<double> start, const StoppingCriteria& stop, Vector<double>& x,
  SolveReport& report, const ExecutionContext& context) const
{
  SolveReport found;
  const std::vector<double> theta =
    FindLowestEigenvectors({ A, inverse, *this->Mass, this->ByComponent, this->SumOverProcesses },
      StopOfSmoothest(stop), start, found, context);
  for (std::size_t component = 0; component < theta.size(); ++component)
  {
    if (this->Lengths[component] > 0.0)
    {
      std::for_each(this->ByComponent.Items.begin() + this->ByComponent.Begins[component],
        this->ByComponent.Items.begin() + this->ByComponent.Begins[component + 1],
        [&](int i) { x[i] = this->Lengths[component] * start[i]; });
      report.Eigenvalues.push_back(
        std::max(theta[component] - this->Shifts[component], 0.0) * this->SquaredNormOfUnit / this->Area);
    }
  }
  report.SolveSeconds += found.SolveSeconds;
  report.Converged &= found.Converged;
  report.Warnings.insert(report.Warnings.end(), found.Warnings.begin(), found.Warnings.end());
  return found.Iterations;
}

}
