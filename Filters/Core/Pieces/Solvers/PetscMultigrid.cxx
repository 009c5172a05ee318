#include "Pieces/Solvers/PetscMultigrid.h"

#include "Pieces/Solvers/PetscObjects.h"
#include "Pieces/Solvers/PetscSession.h"
#include "Support/Errors.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace dmg
{

namespace
{

constexpr int FinestDegree = 6;
constexpr int CoarseDegree = 3;
/// The smoother reduces what belongs to eigenvalues above this part of the largest.
constexpr double SmoothedPart = 0.1;

/// A penalty below this part of the stiffness leaves the prolongation as it is.
constexpr double WeakPenalty = 1e-3;

/// The matrix of a linear triangle over its diagonal has the trace 3 and no negative eigenvalue.
constexpr double LargestEigenvalueOfElements = 3.0;

/// A coarse unknown that only touches held ones has nothing to say, and would make the matrix singular: its diagonal becomes 1.
void FillZeroDiagonal(Mat matrix)
{
  Owned<Vec> diagonal;
  CheckPetsc(MatCreateVecs(matrix, diagonal.Place(), nullptr));
  CheckPetsc(MatGetDiagonal(matrix, diagonal));
  PetscInt size;
  PetscScalar* values;
  CheckPetsc(VecGetLocalSize(diagonal, &size));
  CheckPetsc(VecGetArray(diagonal, &values));
  for (PetscInt i = 0; i < size; ++i)
  {
    const bool isZero = values[i] == 0.0;
    values[i] = isZero ? 1.0 : 0.0;
  }
  CheckPetsc(VecRestoreArray(diagonal, &values));
  PetscReal largest;
  CheckPetsc(VecNorm(diagonal, NORM_INFINITY, &largest));
  if (largest > 0.0)
  {
    CheckPetsc(MatDiagonalSet(matrix, diagonal, ADD_VALUES));
  }
}

LevelReport ReportOf(Mat matrix)
{
  PetscInt rows;
  MatInfo information;
  CheckPetsc(MatGetSize(matrix, &rows, nullptr));
  CheckPetsc(MatGetInfo(matrix, MAT_GLOBAL_SUM, &information));
  return { rows, static_cast<long long>(information.nz_used) };
}

KSP SetChebyshev(KSP smoother, int degree)
{
  CheckPetsc(KSPSetType(smoother, KSPCHEBYSHEV));
  CheckPetsc(KSPSetNormType(smoother, KSP_NORM_NONE));
  CheckPetsc(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, degree));
  return smoother;
}

PC PreconditionerOf(KSP solver)
{
  PC preconditioner;
  CheckPetsc(KSPGetPC(solver, &preconditioner));
  return preconditioner;
}

/// Jacobi with zeros where unknowns are held.
PetscErrorCode ApplyJacobi(PC preconditioner, Vec from, Vec to)
{
  void* inverse = nullptr;
  const PetscErrorCode code = PCShellGetContext(preconditioner, &inverse);
  return code ? code : VecPointwiseMult(to, from, static_cast<Vec>(inverse));
}

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

struct PetscMultigrid::Objects
{
  Objects(const Ranks& ranks, RowsOfRank<Complex> laplacian, std::vector<RowsOfRank<Complex>> prolongations)
    : Laplacian(ranks, std::move(laplacian))
  {
    for (RowsOfRank<Complex>& prolongation : prolongations)
    {
      this->Prolongations.emplace_back(ranks, std::move(prolongation));
    }
  }

  PetscRows Laplacian; ///< with the diagonal of L + D
  std::deque<PetscRows> Prolongations;
  std::vector<Owned<Mat>> Restrictions; ///< they have no memory of their own
  Owned<Vec> InverseDiagonal;           ///< zero where unknowns are held
  Owned<Mat> Single;                    ///< L + D without what is held, where there are no coarse levels
  std::vector<Owned<Mat>> CoarseMatrices;
  Owned<KSP> Solver;
  /// Rows of the first prolongation before they were weakened.
  std::vector<int> WeakenedRows;
  std::vector<Complex> EntriesOfWeakened;

  Mat Finest() const { return this->Single ? Mat(this->Single) : Mat(this->Laplacian); }
  Mat Level(std::size_t level) const { return level == 0 ? this->Finest() : Mat(this->CoarseMatrices[level - 1]); }

  Owned<Vec> NewVector() const
  {
    Owned<Vec> vector;
    CheckPetsc(MatCreateVecs(this->Laplacian, nullptr, vector.Place()));
    return vector;
  }

  template <class Numbers>
  static void Copy(const Numbers& from, Vec to)
  {
    PetscScalar* values;
    CheckPetsc(VecGetArray(to, &values));
    std::copy(from.data(), from.data() + from.size(), values);
    CheckPetsc(VecRestoreArray(to, &values));
  }

  /// function(from, to) on vectors of PETSc's.
  template <class Function>
  Vector<Complex> Apply(const Vector<Complex>& x, const Function& function) const
  {
    const Owned<Vec> from = this->NewVector();
    const Owned<Vec> to = this->NewVector();
    Copy(x, from);
    function(Vec(from), Vec(to));
    Vector<Complex> y(x.size());
    const PetscScalar* results;
    CheckPetsc(VecGetArrayRead(to, &results));
    std::copy(results, results + y.size(), y.data());
    CheckPetsc(VecRestoreArrayRead(to, &results));
    return y;
  }

  void SetMultigrid(double largestEigenvalue, int cyclesInARow) const
  {
    const int levels = 1 + static_cast<int>(this->CoarseMatrices.size());
    if (levels == 1)
    {
      Factor(this->Solver);
      return;
    }
    const PC cycle = PreconditionerOf(this->Solver);
    CheckPetsc(PCSetType(cycle, PCMG));
    CheckPetsc(PCMGSetLevels(cycle, levels, nullptr));
    CheckPetsc(PCMGSetType(cycle, PC_MG_MULTIPLICATIVE));
    CheckPetsc(PCMGMultiplicativeSetCycles(cycle, cyclesInARow));
    CheckPetsc(PCMGSetGalerkin(cycle, PC_MG_GALERKIN_NONE));
    for (int level = 0; level + 1 < levels; ++level)
    {
      const int above = levels - 1 - level; // PETSc's level 0 is the coarsest
      CheckPetsc(PCMGSetInterpolation(cycle, above, this->Prolongations[level]));
      CheckPetsc(PCMGSetRestriction(cycle, above, this->Restrictions[level]));
      KSP smoother;
      CheckPetsc(PCMGGetSmoother(cycle, above, &smoother));
      CheckPetsc(KSPSetOperators(smoother, this->Level(level), this->Level(level)));
      if (level == 0)
      {
        this->SetFinestSmoother(smoother, largestEigenvalue);
      }
      else
      {
        CheckPetsc(PCSetType(PreconditionerOf(SetChebyshev(smoother, CoarseDegree)), PCJACOBI));
        CheckPetsc(KSPChebyshevEstEigSet(smoother, 0.0, SmoothedPart, 0.0, 1.1));
        CheckPetsc(PCMGSetCycleTypeOnLevel(cycle, above, PC_MG_CYCLE_W));
      }
    }
    KSP coarsest;
    CheckPetsc(PCMGGetCoarseSolve(cycle, &coarsest));
    CheckPetsc(KSPSetOperators(coarsest, this->Level(levels - 1), this->Level(levels - 1)));
    CheckPetsc(KSPSetType(coarsest, KSPPREONLY));
    Factor(coarsest);
  }

private:
  void SetFinestSmoother(KSP smoother, double largestEigenvalue) const
  {
    const PC jacobi = PreconditionerOf(SetChebyshev(smoother, FinestDegree));
    CheckPetsc(PCSetType(jacobi, PCSHELL));
    CheckPetsc(PCShellSetContext(jacobi, static_cast<Vec>(this->InverseDiagonal)));
    CheckPetsc(PCShellSetApply(jacobi, ApplyJacobi));
    CheckPetsc(KSPChebyshevSetEigenvalues(smoother, largestEigenvalue, SmoothedPart * largestEigenvalue));
  }

  /// Every rank factors the whole matrix.
  static void Factor(KSP solver)
  {
    const PC redundant = PreconditionerOf(solver);
    CheckPetsc(PCSetType(redundant, PCREDUNDANT));
    KSP inner;
    CheckPetsc(PCRedundantGetKSP(redundant, &inner));
    CheckPetsc(KSPSetType(inner, KSPPREONLY));
    CheckPetsc(PCSetType(PreconditionerOf(inner), PCLU));
  }
};

PetscMultigrid::PetscMultigrid(
  const Ranks& ranks, RowsOfRank<Complex> laplacian, std::vector<RowsOfRank<Complex>> prolongations, int cyclesInARow)
  : All(ranks)
  , CyclesInARow(cyclesInARow)
  , Of(std::make_unique<Objects>(ranks, std::move(laplacian), std::move(prolongations)))
{
  for (const PetscRows& prolongation : this->Of->Prolongations)
  {
    CheckPetsc(MatCreateHermitianTranspose(prolongation, this->Of->Restrictions.emplace_back().Place()));
  }
  const int owned = this->Of->Laplacian.NumberOfRows();
  this->StiffnessOfOwned.setZero(owned);
  for (int i = 0; i < owned; ++i)
  {
    this->Of->Laplacian.VisitRow(i,
      [this, i](const Complex& value, bool isDiagonal)
      { this->StiffnessOfOwned[i] += isDiagonal ? value.real() : 0.0; });
  }
}

PetscMultigrid::~PetscMultigrid() = default;

void PetscMultigrid::SetDiagonal(const Vector<double>& diagonal)
{
  for (int i = 0; i < diagonal.size(); ++i)
  {
    this->Of->Laplacian.VisitRow(i,
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
    this->Of->Laplacian.VisitRow(i, [&sum](const Complex& value, bool) { sum += std::abs(value); });
    largest = isHeld[i] ? largest : std::max(largest, sum / this->Diagonal[i]);
  }
  return std::min(this->All.Max(largest), LargestEigenvalueOfElements);
}

void PetscMultigrid::WeakenRows(const Vector<double>& shares)
{
  if (this->Of->Prolongations.empty())
  {
    return;
  }
  PetscRows& prolongation = this->Of->Prolongations[0];
  for (int i = 0; i < shares.size(); ++i)
  {
    if (shares[i] < 1.0)
    {
      this->Of->WeakenedRows.push_back(i);
      prolongation.VisitRow(i,
        [&](Complex& value, bool)
        {
          this->Of->EntriesOfWeakened.push_back(value);
          value *= shares[i];
        });
    }
  }
}

void PetscMultigrid::RestoreRows()
{
  auto entry = this->Of->EntriesOfWeakened.begin();
  for (const int row : this->Of->WeakenedRows)
  {
    this->Of->Prolongations[0].VisitRow(row, [&entry](Complex& value, bool) { value = *entry++; });
  }
  this->Of->WeakenedRows.clear();
  this->Of->EntriesOfWeakened.clear();
}

void PetscMultigrid::SetPenalties(
  const Vector<double>& D, const std::vector<char>& isHeld, const ExecutionContext& context)
{
  Objects& of = *this->Of;
  of.Solver = {};
  of.CoarseMatrices.clear();
  of.Single = {};
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
  of.InverseDiagonal = of.NewVector();
  Objects::Copy(inverse, of.InverseDiagonal);
  this->MakeCoarseMatrices(context);
  if (of.Prolongations.empty())
  {
    this->TakeHeldOut(isHeld);
  }
  CheckPetsc(KSPCreate(this->All.Communicator(), of.Solver.Place()));
  CheckPetsc(KSPSetOperators(of.Solver, of.Finest(), of.Finest()));
  CheckPetsc(KSPSetType(of.Solver, KSPCG));
  CheckPetsc(KSPCGSetType(of.Solver, KSP_CG_HERMITIAN));
  CheckPetsc(KSPSetNormType(of.Solver, KSP_NORM_NATURAL));
  of.SetMultigrid(this->LargestEigenvalue(isHeld), this->CyclesInARow);
  CheckPetsc(KSPSetUp(of.Solver));
  this->All.Checkpoint(context, 1.0);
}

/// A matrix that is to be factored has the row and the column of the identity where an unknown is held.
void PetscMultigrid::TakeHeldOut(const std::vector<char>& isHeld)
{
  Objects& of = *this->Of;
  CheckPetsc(MatDuplicate(of.Laplacian, MAT_COPY_VALUES, of.Single.Place()));
  PetscInt first = 0;
  CheckPetsc(MatGetOwnershipRange(of.Single, &first, nullptr));
  std::vector<PetscInt> held;
  for (std::size_t i = 0; i < isHeld.size(); ++i)
  {
    if (isHeld[i])
    {
      held.push_back(first + static_cast<PetscInt>(i));
    }
  }
  CheckPetsc(MatZeroRowsColumns(of.Single, static_cast<PetscInt>(held.size()), held.data(), 1.0, nullptr, nullptr));
}

void PetscMultigrid::MakeCoarseMatrices(const ExecutionContext& context)
{
  const std::deque<PetscRows>& prolongations = this->Of->Prolongations;
  for (std::size_t level = 0; level < prolongations.size(); ++level)
  {
    this->All.Checkpoint(context, static_cast<double>(level) / static_cast<double>(prolongations.size()));
    const Mat P = prolongations[level];
    Owned<Mat> R, AP, coarse;
    CheckPetsc(MatMatMult(this->Of->Level(level), P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, AP.Place()));
    CheckPetsc(MatProductClear(AP)); // of what only a second product would need
    CheckPetsc(MatHermitianTranspose(P, MAT_INITIAL_MATRIX, R.Place()));
    CheckPetsc(MatMatMult(R, AP, MAT_INITIAL_MATRIX, PETSC_DEFAULT, coarse.Place()));
    CheckPetsc(MatProductClear(coarse));
    FillZeroDiagonal(coarse);
    this->Of->CoarseMatrices.push_back(std::move(coarse));
  }
}

std::vector<LevelReport> PetscMultigrid::Levels() const
{
  std::vector<LevelReport> levels;
  for (std::size_t level = 0; level <= this->Of->CoarseMatrices.size(); ++level)
  {
    levels.push_back(ReportOf(this->Of->Level(level)));
  }
  return levels;
}

Vector<Complex> PetscMultigrid::MultiplyOffDiagonal(const Vector<Complex>& x)
{
  this->SetDiagonal(Vector<double>::Zero(this->Diagonal.size()));
  Vector<Complex> product =
    this->Of->Apply(x, [this](Vec from, Vec to) { CheckPetsc(MatMult(this->Of->Laplacian, from, to)); });
  this->SetDiagonal(this->Diagonal);
  return product;
}

Vector<Complex> PetscMultigrid::Multiply(const Vector<Complex>& x)
{
  return this->Of->Apply(x, [this](Vec from, Vec to) { CheckPetsc(MatMult(this->Of->Laplacian, from, to)); });
}

Vector<Complex> PetscMultigrid::Precondition(const Vector<Complex>& r)
{
  const PC cycle = PreconditionerOf(this->Of->Solver);
  return this->Of->Apply(r, [cycle](Vec from, Vec to) { CheckPetsc(PCApply(cycle, from, to)); });
}

Vector<Complex> PetscMultigrid::Solve(
  const Vector<Complex>& b, const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context)
{
  Monitor monitor{ &this->All, &context, stop.RelativeTolerance, stop.MaximumIterations, {}, {} };
  CheckPetsc(
    KSPSetTolerances(this->Of->Solver, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, stop.MaximumIterations + 1));
  CheckPetsc(KSPSetConvergenceTest(this->Of->Solver, HasConverged, &monitor, nullptr));
  Vector<Complex> x =
    this->Of->Apply(b, [this](Vec right, Vec left) { CheckPetsc(KSPSolve(this->Of->Solver, right, left)); });
  KSPConvergedReason reason;
  CheckPetsc(KSPGetConvergedReason(this->Of->Solver, &reason));
  this->All.Checkpoint(context, 1.0);
  report.Iterations = monitor.Iterations;
  report.Returned = static_cast<int>(report.Iterations.size()) - 1;
  report.Converged = reason > 0;
  report.SolveSeconds = monitor.Watch.Seconds();
  if (reason == KSP_DIVERGED_NANORINF || reason == KSP_DIVERGED_PC_FAILED)
  {
    throw SolverFailure("the cycle of the surface in pieces has failed, as its coarsest matrix "
                        "is singular or the surface has "
                        "extremely thin triangles; gather the surface on one rank");
  }
  return x;
}

}
