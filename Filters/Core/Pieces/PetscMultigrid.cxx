#include "Pieces/PetscMultigrid.h"

#include "Pieces/PetscSession.h"
#include "Support/Errors.h"
#include "Support/Stopwatch.h"

#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#ifndef PETSC_USE_COMPLEX
#error "PETSc has to be one for complex numbers"
#endif

namespace dmg
{

namespace
{

constexpr int FinestDegree = 6;
constexpr int CoarseDegree = 3;
/// The smoother reduces what belongs to eigenvalues above this part of the largest.
constexpr double SmoothedPart = 0.1;

void Destroy(Mat& matrix)
{
  CheckDestroyed(MatDestroy(&matrix));
}
void Destroy(Vec& vector)
{
  CheckDestroyed(VecDestroy(&vector));
}
void Destroy(KSP& solver)
{
  CheckDestroyed(KSPDestroy(&solver));
}

/// An object of PETSc's, which it counts references to.
template <class Object>
class Owned
{
public:
  Owned() = default;
  ~Owned()
  {
    if (IsPetscInitialised())
    {
      Destroy(this->Held);
    }
  }
  Owned(Owned&& other) noexcept
    : Held(std::exchange(other.Held, nullptr))
  {
  }
  Owned& operator=(Owned&& other) noexcept
  {
    std::swap(this->Held, other.Held);
    return *this;
  }
  operator Object() const { return this->Held; }
  /// For functions that make one.
  Object* Place() { return &this->Held; }

private:
  Object Held = nullptr;
};

PetscInt Narrow(long long number)
{
  if (number > std::numeric_limits<PetscInt>::max())
  {
    throw InvalidInput("the surface has too many vertices for this PETSc, whose indices have 32 bits; build "
                       "DirectionalMultigrid with one of 64-bit indices");
  }
  return static_cast<PetscInt>(number);
}

/// PETSc copies the rows.
Owned<Mat> MatrixOfRows(const Ranks& ranks, const RowsOfRank<Complex>& matrix)
{
  const SparseMatrix<Complex>& rows = matrix.Rows;
  std::vector<PetscInt> offsets, columns;
  std::vector<PetscScalar> values;
  ranks.Together(
    [&]
    {
      offsets.assign(rows.outerIndexPtr(), rows.outerIndexPtr() + rows.rows() + 1);
      columns.reserve(rows.nonZeros());
      values.reserve(rows.nonZeros());
      std::vector<std::pair<PetscInt, PetscScalar>> row;
      for (int i = 0; i < rows.rows(); ++i)
      {
        row.clear();
        for (SparseMatrix<Complex>::InnerIterator entry(rows, i); entry; ++entry)
        {
          row.emplace_back(Narrow(matrix.GlobalColumns[entry.col()]), entry.value());
        }
        std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [column, value] : row)
        {
          columns.push_back(column);
          values.push_back(value);
        }
      }
    });
  Owned<Mat> result;
  CheckPetsc(MatCreateMPIAIJWithArrays(ranks.Communicator(), static_cast<PetscInt>(rows.rows()), matrix.OwnedColumns,
    PETSC_DETERMINE, PETSC_DETERMINE, offsets.data(), columns.data(), values.data(), result.Place()));
  return result;
}

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

void SetChebyshev(KSP smoother, int degree)
{
  CheckPetsc(KSPSetType(smoother, KSPCHEBYSHEV));
  CheckPetsc(KSPSetNormType(smoother, KSP_NORM_NONE));
  CheckPetsc(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, degree));
  PC jacobi;
  CheckPetsc(KSPGetPC(smoother, &jacobi));
  CheckPetsc(PCSetType(jacobi, PCJACOBI));
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
  std::vector<Owned<Mat>> Matrices; // finest first
  std::vector<Owned<Mat>> Prolongations;
  std::vector<Owned<Mat>> Restrictions;
  Owned<KSP> Solver;

  /// function(from, to) on vectors of PETSc's.
  template <class Function>
  Vector<Complex> Apply(const Vector<Complex>& x, const Function& function)
  {
    Owned<Vec> from, to;
    CheckPetsc(MatCreateVecs(this->Matrices[0], to.Place(), from.Place()));
    PetscScalar* values;
    CheckPetsc(VecGetArray(from, &values));
    std::copy(x.data(), x.data() + x.size(), values);
    CheckPetsc(VecRestoreArray(from, &values));
    function(Vec(from), Vec(to));
    Vector<Complex> y(x.size());
    const PetscScalar* results;
    CheckPetsc(VecGetArrayRead(to, &results));
    std::copy(results, results + y.size(), y.data());
    CheckPetsc(VecRestoreArrayRead(to, &results));
    return y;
  }

  void SetMultigrid(double largestEigenvalue, int cyclesInARow)
  {
    PC cycle;
    CheckPetsc(KSPGetPC(this->Solver, &cycle));
    const int levels = static_cast<int>(this->Matrices.size());
    if (levels == 1)
    {
      this->Factor(this->Solver);
      return;
    }
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
      CheckPetsc(KSPSetOperators(smoother, this->Matrices[level], this->Matrices[level]));
      SetChebyshev(smoother, level == 0 ? FinestDegree : CoarseDegree);
      if (level == 0)
      {
        CheckPetsc(KSPChebyshevSetEigenvalues(smoother, largestEigenvalue, SmoothedPart * largestEigenvalue));
      }
      else
      {
        CheckPetsc(KSPChebyshevEstEigSet(smoother, 0.0, SmoothedPart, 0.0, 1.1));
        CheckPetsc(PCMGSetCycleTypeOnLevel(cycle, above, PC_MG_CYCLE_W));
      }
    }
    KSP coarsest;
    CheckPetsc(PCMGGetCoarseSolve(cycle, &coarsest));
    CheckPetsc(KSPSetOperators(coarsest, this->Matrices.back(), this->Matrices.back()));
    CheckPetsc(KSPSetType(coarsest, KSPPREONLY));
    this->Factor(coarsest);
  }

private:
  /// Every rank factors the whole matrix.
  static void Factor(KSP solver)
  {
    PC redundant, factor;
    KSP inner;
    CheckPetsc(KSPGetPC(solver, &redundant));
    CheckPetsc(PCSetType(redundant, PCREDUNDANT));
    CheckPetsc(PCRedundantGetKSP(redundant, &inner));
    CheckPetsc(KSPSetType(inner, KSPPREONLY));
    CheckPetsc(KSPGetPC(inner, &factor));
    CheckPetsc(PCSetType(factor, PCLU));
  }
};

PetscMultigrid::PetscMultigrid(const Ranks& ranks, const RowsOfRank<Complex>& matrix,
  const std::vector<RowsOfRank<Complex>>& prolongations, double largestEigenvalue, int cyclesInARow,
  const ExecutionContext& context)
  : Of(std::make_unique<Objects>())
  , All(ranks)
{
  this->Of->Matrices.push_back(MatrixOfRows(ranks, matrix));
  for (std::size_t level = 0; level < prolongations.size(); ++level)
  {
    ranks.Checkpoint(context, static_cast<double>(level) / static_cast<double>(prolongations.size()));
    Owned<Mat> P = MatrixOfRows(ranks, prolongations[level]);
    Owned<Mat> R, AP, coarse;
    CheckPetsc(MatHermitianTranspose(P, MAT_INITIAL_MATRIX, R.Place()));
    CheckPetsc(MatMatMult(this->Of->Matrices.back(), P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, AP.Place()));
    CheckPetsc(MatMatMult(R, AP, MAT_INITIAL_MATRIX, PETSC_DEFAULT, coarse.Place()));
    FillZeroDiagonal(coarse);
    this->Of->Prolongations.push_back(std::move(P));
    this->Of->Restrictions.push_back(std::move(R));
    this->Of->Matrices.push_back(std::move(coarse));
  }
  KSP solver;
  CheckPetsc(KSPCreate(ranks.Communicator(), this->Of->Solver.Place()));
  solver = this->Of->Solver;
  CheckPetsc(KSPSetOperators(solver, this->Of->Matrices[0], this->Of->Matrices[0]));
  CheckPetsc(KSPSetType(solver, KSPCG));
  CheckPetsc(KSPCGSetType(solver, KSP_CG_HERMITIAN));
  CheckPetsc(KSPSetNormType(solver, KSP_NORM_NATURAL));
  this->Of->SetMultigrid(largestEigenvalue, cyclesInARow);
  CheckPetsc(KSPSetUp(solver));
  ranks.Checkpoint(context, 1.0);
}

PetscMultigrid::~PetscMultigrid() = default;

Vector<Complex> PetscMultigrid::Multiply(const Vector<Complex>& x)
{
  return this->Of->Apply(x, [this](Vec from, Vec to) { CheckPetsc(MatMult(this->Of->Matrices[0], from, to)); });
}

Vector<Complex> PetscMultigrid::Precondition(const Vector<Complex>& r)
{
  PC cycle;
  CheckPetsc(KSPGetPC(this->Of->Solver, &cycle));
  return this->Of->Apply(r, [&cycle](Vec from, Vec to) { CheckPetsc(PCApply(cycle, from, to)); });
}

std::vector<LevelReport> PetscMultigrid::Levels() const
{
  std::vector<LevelReport> levels;
  for (const Owned<Mat>& matrix : this->Of->Matrices)
  {
    levels.push_back(ReportOf(matrix));
  }
  return levels;
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
    throw SolverFailure(
      "the cycle of the surface in pieces has failed, as its coarsest matrix is singular or the surface has "
      "extremely thin triangles; gather the surface on one rank");
  }
  return x;
}

}
