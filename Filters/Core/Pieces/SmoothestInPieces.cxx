#include "Pieces/SmoothestInPieces.h"

#include "Solvers/Krylov/LowestEigenvectors.h"
#include "Solvers/UnprescribedComponents.h"
#include "Support/ComplexPairs.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

class MatrixOfSystem : public LinearOperator<double>
{
public:
  MatrixOfSystem(PetscMultigrid& system, int owned)
    : System(system)
    , Owned(owned)
  {
  }

  int Size() const override { return 2 * this->Owned; }
  /// \return zero, since no iteration here asks for the energy.
  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext&) const override
  {
    y = AsPairs(this->System.Multiply(AsComplex(x)));
    return 0.0;
  }

private:
  PetscMultigrid& System;
  const int Owned;
};

class CycleOfSystem : public Preconditioner<double>
{
public:
  explicit CycleOfSystem(PetscMultigrid& system)
    : System(system)
  {
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
  {
    z = AsPairs(this->System.Precondition(AsComplex(r)));
  }

private:
  PetscMultigrid& System;
};

/// All ranks stop as soon as one of them was asked to.
class ContextOfRanks : public PartOfContext
{
public:
  ContextOfRanks(const Ranks& ranks, const ExecutionContext& context)
    : PartOfContext(context, 0.0, 1.0)
    , All(ranks)
  {
  }
  bool IsCancelled() const override { return this->All.Any(this->PartOfContext::IsCancelled()); }

private:
  const Ranks& All;
};

}

SmoothestInPieces::SmoothestInPieces(const Ranks& ranks, const std::vector<int>& components, int number,
  const Vector<double>& stiffness, const Vector<double>& mass)
  : All(&ranks)
  , Mass(mass)
  , Shifts(number, 0.0)
  , Masses(number, 0.0)
{
  std::vector<int> unknowns;
  for (std::size_t i = 0; i < components.size(); ++i)
  {
    if (components[i] >= 0)
    {
      const int unknown = 2 * static_cast<int>(i);
      unknowns.insert(unknowns.end(), { unknown, unknown + 1 });
      this->Shifts[components[i]] += stiffness[i] > 0.0 ? 2.0 * mass[i] / stiffness[i] : 0.0;
      this->Masses[components[i]] += mass[i];
    }
  }
  this->ByComponent = SortByKey(
    unknowns, number, [&components](int unknown) { return components[unknown / 2]; }, SerialContext());
  ranks.Sum(this->Shifts);
  ranks.Sum(this->Masses);
  std::transform(this->Shifts.begin(), this->Shifts.end(), this->Shifts.begin(), ShiftOfSmoothest);
}

void SmoothestInPieces::AddShifts(Vector<double>& D) const
{
  for (std::size_t component = 0; component < this->Shifts.size(); ++component)
  {
    for (int item = this->ByComponent.Begins[component]; item < this->ByComponent.Begins[component + 1]; item += 2)
    {
      const int vertex = this->ByComponent.Items[item] / 2;
      D[vertex] += this->Shifts[component] * this->Mass[vertex];
    }
  }
}

std::vector<IterationReport> SmoothestInPieces::Find(PetscMultigrid& system, double meanMass, int maximumIterations,
  Vector<Complex>& former, Vector<Complex>& x, SolveReport& report, const ExecutionContext& context) const
{
  Vector<double> pairs = AsPairs(former);
  former.setZero(x.size());
  const MatrixOfSystem matrix(system, static_cast<int>(x.size()));
  CycleOfSystem cycle(system);
  SolveReport found;
  const std::vector<double> theta =
    FindLowestEigenvectors({ matrix, cycle, this->Mass, this->ByComponent,
                             [this](double* numbers, int size) { this->All->Sum(numbers, size); } },
      StopOfSmoothest(maximumIterations), pairs, found, ContextOfRanks(*this->All, context));
  for (std::size_t component = 0; component < theta.size(); ++component)
  {
    const double length = std::sqrt(this->Masses[component]);
    for (int item = this->ByComponent.Begins[component]; item < this->ByComponent.Begins[component + 1]; item += 2)
    {
      const int unknown = this->ByComponent.Items[item];
      x[unknown / 2] = former[unknown / 2] = length * Complex(pairs[unknown], pairs[unknown + 1]);
    }
    report.Eigenvalues.push_back(std::max(theta[component] - this->Shifts[component], 0.0) / meanMass);
  }
  report.SolveSeconds += found.SolveSeconds;
  report.Converged &= found.Converged;
  report.Warnings.insert(report.Warnings.end(), found.Warnings.begin(), found.Warnings.end());
  return found.Iterations;
}

}
