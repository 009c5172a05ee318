#include "Pieces/Solvers/PetscMultigrid.h"

#include "Pieces/Solvers/PetscCycle.h"
#include "Support/Errors.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{

namespace
{

/// A penalty below this part of the stiffness leaves the prolongation as it is.
constexpr double WeakPenalty = 1e-3;

/// The matrix of a linear triangle over its diagonal has the trace 3 and no negative eigenvalue.
constexpr double LargestEigenvalueOfElements = 3.0;

/// The test of convergence with a look at who was asked to stop.
struct Monitor
{
  const Ranks* All;
  const ExecutionContext* Context;
  double Tolerance;
  int MaximumIterations;
  Stopwatch Watch;
  std::vector<IterationReport> Iterations;
  double First = 0.0;
};

PetscErrorCode HasConverged(KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* data)
{
  Monitor& monitor = *static_cast<Monitor*>(data);
  if (iteration == 0)
  {
    monitor.First = norm;
  }
  const double relative = monitor.First > 0.0 ? norm / monitor.First : 0.0;
  IterationReport report;
  report.Iteration = static_cast<int>(iteration);
  report.Seconds = monitor.Watch.Seconds();
  report.RelativeResidual = relative;
  monitor.Iterations.push_back(report);
  const bool isStopped = monitor.All->Any(monitor.Context->IsCancelled());
  *reason = isStopped                                                 ? KSP_DIVERGED_BREAKDOWN
    : !std::isfinite(norm)                                            ? KSP_DIVERGED_NANORINF
    : relative <= monitor.Tolerance && (iteration > 0 || norm == 0.0) ? KSP_CONVERGED_RTOL
    : iteration >= monitor.MaximumIterations                          ? KSP_DIVERGED_ITS
                                                                      : KSP_CONVERGED_ITERATING;
  return static_cast<PetscErrorCode>(0);
}

}

PetscMultigrid::PetscMultigrid(
  const Ranks& ranks, RowsOfRank<Complex> laplacian, std::vector<RowsOfRank<Complex>> prolongations, int cyclesInARow)
  : All(ranks)
  , Cycle(std::make_unique<PetscCycle>(ranks, std::move(laplacian), std::move(prolongations), cyclesInARow))
{
  const int owned = this->Cycle->Matrix.NumberOfRows();
  this->StiffnessOfOwned.setZero(owned);
  for (int i = 0; i < owned; ++i)
  {
    this->Cycle->Matrix.VisitRow(i,
      [this, i](const Complex& value, bool isDiagonal)
      { this->StiffnessOfOwned[i] += isDiagonal ? value.real() : 0.0; });
  }
}

PetscMultigrid::~PetscMultigrid() = default;

void PetscMultigrid::SetDiagonal(const Vector<double>& diagonal)
{
  for (int i = 0; i < diagonal.size(); ++i)
  {
    this->Cycle->Matrix.VisitRow(i,
      [&](Complex& value, bool isDiagonal)
      {
        if (isDiagonal)
        {
          value = diagonal[i];
        }
      });
  }
}

/// A bound of the eigenvalues of L + D over its diagonal: by elements, or by the sums of its rows.
double PetscMultigrid::LargestEigenvalue(const std::vector<char>& isHeld) const
{
  double largest = 1.0;
  for (int i = 0; i < this->Diagonal.size(); ++i)
  {
    double sum = 0.0;
    this->Cycle->Matrix.VisitRow(i, [&sum](const Complex& value, bool) { sum += std::abs(value); });
    largest = isHeld[i] ? largest : std::max(largest, sum / this->Diagonal[i]);
  }
  return std::min(this->All.Max(largest), LargestEigenvalueOfElements);
}

void PetscMultigrid::WeakenRows(const Vector<double>& shares)
{
  if (this->Cycle->Prolongations.empty())
  {
    return;
  }
  PetscRows& prolongation = this->Cycle->Prolongations[0];
  for (int i = 0; i < shares.size(); ++i)
  {
    if (shares[i] < 1.0)
    {
      this->WeakenedRows.push_back(i);
      prolongation.VisitRow(i,
        [&](Complex& value, bool)
        {
          this->EntriesOfWeakened.push_back(value);
          value *= shares[i];
        });
    }
  }
}

void PetscMultigrid::RestoreRows()
{
  auto entry = this->EntriesOfWeakened.begin();
  for (const int row : this->WeakenedRows)
  {
    this->Cycle->Prolongations[0].VisitRow(row, [&entry](Complex& value, bool) { value = *entry++; });
  }
  this->WeakenedRows.clear();
  this->EntriesOfWeakened.clear();
}

void PetscMultigrid::SetPenalties(
  const Vector<double>& D, const std::vector<char>& isHeld, const ExecutionContext& context)
{
  this->Cycle->Clear();
  this->RestoreRows();
  const auto owned = static_cast<Eigen::Index>(isHeld.size());
  this->Diagonal = this->StiffnessOfOwned + D;
  Vector<double> shares = Vector<double>::Ones(owned);
  Vector<double> inverse = Vector<double>::Zero(owned);
  for (Eigen::Index i = 0; i < owned; ++i)
  {
    const bool isFree = !isHeld[i] && this->Diagonal[i] > 0.0;
    const double stiffness = this->StiffnessOfOwned[i];
    shares[i] = !isFree ? 0.0 : D[i] < WeakPenalty * stiffness ? 1.0 : stiffness / this->Diagonal[i];
    this->Diagonal[i] = this->Diagonal[i] > 0.0 ? this->Diagonal[i] : 1.0;
    inverse[i] = isHeld[i] ? 0.0 : 1.0 / this->Diagonal[i];
  }
  this->SetDiagonal(this->Diagonal);
  this->WeakenRows(shares);
  this->Cycle->SetUp(inverse, isHeld, this->LargestEigenvalue(isHeld), context);
}

std::vector<LevelReport> PetscMultigrid::Levels() const
{
  return this->Cycle->Levels();
}

Vector<Complex> PetscMultigrid::MultiplyOffDiagonal(const Vector<Complex>& x)
{
  this->SetDiagonal(Vector<double>::Zero(this->Diagonal.size()));
  Vector<Complex> product = this->Multiply(x);
  this->SetDiagonal(this->Diagonal);
  return product;
}

Vector<Complex> PetscMultigrid::Multiply(const Vector<Complex>& x)
{
  return this->Cycle->Apply(x, [this](Vec from, Vec to) { CheckPetsc(MatMult(this->Cycle->Matrix, from, to)); });
}

Vector<Complex> PetscMultigrid::Precondition(const Vector<Complex>& r)
{
  const PC cycle = this->Cycle->Preconditioner();
  return this->Cycle->Apply(r, [cycle](Vec from, Vec to) { CheckPetsc(PCApply(cycle, from, to)); });
}

Vector<Complex> PetscMultigrid::Solve(
  const Vector<Complex>& b, const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context)
{
  Monitor monitor{ &this->All, &context, stop.RelativeTolerance, stop.MaximumIterations, {}, {} };
  const KSP solver = this->Cycle->Solver();
  CheckPetsc(KSPSetTolerances(solver, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, stop.MaximumIterations + 1));
  CheckPetsc(KSPSetConvergenceTest(solver, HasConverged, &monitor, nullptr));
  Vector<Complex> x =
    this->Cycle->Apply(b, [solver](Vec right, Vec left) { CheckPetsc(KSPSolve(solver, right, left)); });
  KSPConvergedReason reason;
  CheckPetsc(KSPGetConvergedReason(solver, &reason));
  this->All.Checkpoint(context, 1.0);
  report.Iterations = monitor.Iterations;
  report.Returned = static_cast<int>(report.Iterations.size()) - 1;
  report.Converged = reason > 0;
  report.SolveSeconds = monitor.Watch.Seconds();
  if (reason == KSP_DIVERGED_NANORINF || reason == KSP_DIVERGED_PC_FAILED)
  {
    throw SolverFailure("the cycle of the surface in pieces has failed, as its coarsest matrix is singular or the "
                        "surface has extremely thin triangles; gather the surface on one rank");
  }
  return x;
}

}
