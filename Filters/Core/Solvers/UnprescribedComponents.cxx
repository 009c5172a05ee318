#include "Solvers/UnprescribedComponents.h"

#include "Solvers/Krylov/LowestEigenvectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

StoppingCriteria StopOfSmoothest(int maximumIterations)
{
  // At 1e-6 the eigenvalue has twelve digits. Vectors of eigenvalues that are closer to each other are not told apart. At 1e-4
  // the next eigenvectors may still turn the field by many degrees where it is small.
  constexpr double Tolerance = 1e-6;
  // Eigenvectors part slowly where many eigenvalues are close together, as on spheres.
  constexpr int Patience = 3;
  const bool isLarge = maximumIterations > std::numeric_limits<int>::max() / Patience;
  return { Tolerance, isLarge ? maximumIterations : Patience * maximumIterations };
}

double ShiftOfSmoothest(double sumOfMassOverStiffness)
{
  return sumOfMassOverStiffness > 0.0 ? 1.0 / sumOfMassOverStiffness : 1.0; // a triangle alone has no smoothness energy
}

UnprescribedComponents::UnprescribedComponents(
  const MultigridSetup& setup, const std::vector<int>& unknowns, const ExecutionContext& context)
  : Setup(&setup)
  , ByComponent(SortByKey(
      unknowns, setup.Hierarchy->NumberOfComponents(), [&setup](int i) { return setup.Hierarchy->ComponentOf(i); },
      context))
  , Shifts(setup.Hierarchy->NumberOfComponents(), 0.0)
{
  for (std::size_t component = 0; component < this->Shifts.size(); ++component)
  {
    double area = 0.0;
    for (int item = this->ByComponent.Begins[component]; item < this->ByComponent.Begins[component + 1]; ++item)
    {
      const int unknown = this->ByComponent.Items[item];
      const double stiffness = setup.Hierarchy->DiagonalOf(unknown);
      area += stiffness > 0.0 ? setup.MassOf(unknown) / stiffness : 0.0;
    }
    this->Shifts[component] = ShiftOfSmoothest(area);
  }
}

void UnprescribedComponents::SetDiagonal(Vector<double>& D) const
{
  for (const int i : this->Unknowns())
  {
    D[i] = this->Shifts[this->Setup->Hierarchy->ComponentOf(i)] * this->Setup->MassOf(i);
  }
}

double UnprescribedComponents::ShareOf(std::size_t component) const
{
  double mass = 0.0;
  for (int item = this->ByComponent.Begins[component]; item < this->ByComponent.Begins[component + 1]; ++item)
  {
    mass += this->Setup->MassOf(this->ByComponent.Items[item]);
  }
  const Eigen::Index unknownsPerMass = this->Setup->Hierarchy->NumberOfUnknowns() / this->Setup->Mass.size();
  return mass / (this->Setup->Mass.sum() * static_cast<double>(unknownsPerMass));
}

std::vector<IterationReport> UnprescribedComponents::FindSmoothest(const LinearOperator<double>& A,
  Preconditioner<double>& inverse, Vector<double> start, int maximumIterations, Vector<double>& x, SolveReport& report,
  const ExecutionContext& context) const
{
  const MultigridSetup& setup = *this->Setup;
  if (start.size() == 0)
  {
    // Nothing is smoother than a harmonic field.
    start = setup.Kernel.cols() > 0 ? Vector<double>(setup.Kernel.rowwise().sum()) : Vector<double>::Zero(x.size());
  }
  const StoppingCriteria stop = StopOfSmoothest(maximumIterations);
  SolveReport found;
  const std::vector<double> theta =
    FindLowestEigenvectors({ A, inverse, setup.Mass, this->ByComponent }, stop, start, found, context);
  for (std::size_t component = 0; component < theta.size(); ++component)
  {
    const int begin = this->ByComponent.Begins[component];
    const int end = this->ByComponent.Begins[component + 1];
    if (begin < end)
    {
      const double length = std::sqrt(this->ShareOf(component) * setup.SquaredNormOfUnit);
      std::for_each(this->ByComponent.Items.begin() + begin, this->ByComponent.Items.begin() + end,
        [&](int i) { x[i] = length * start[i]; });
      report.Eigenvalues.push_back(
        std::max(theta[component] - this->Shifts[component], 0.0) * setup.SquaredNormOfUnit / setup.Area);
    }
  }
  report.SolveSeconds += found.SolveSeconds;
  report.Converged &= found.Converged;
  report.Warnings.insert(report.Warnings.end(), found.Warnings.begin(), found.Warnings.end());
  return found.Iterations;
}

}
