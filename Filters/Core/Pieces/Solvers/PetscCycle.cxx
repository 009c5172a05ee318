#include "Pieces/Solvers/PetscCycle.h"

#include <utility>

namespace dmg
{

namespace
{

constexpr int FinestDegree = 6;
constexpr int CoarseDegree = 3;
/// The smoother reduces what belongs to eigenvalues above this part of the largest.
constexpr double SmoothedPart = 0.1;

/// A coarse unknown that only touches held ones has a zero row, which would make the matrix singular: its diagonal becomes 1.
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

PC PreconditionerOf(KSP solver)
{
  PC preconditioner;
  CheckPetsc(KSPGetPC(solver, &preconditioner));
  return preconditioner;
}

KSP SetChebyshev(KSP smoother, int degree)
{
  CheckPetsc(KSPSetType(smoother, KSPCHEBYSHEV));
  CheckPetsc(KSPSetNormType(smoother, KSP_NORM_NONE));
  CheckPetsc(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, degree));
  return smoother;
}

void SetCoarseSmoother(KSP smoother)
{
  CheckPetsc(PCSetType(PreconditionerOf(SetChebyshev(smoother, CoarseDegree)), PCJACOBI));
  CheckPetsc(KSPChebyshevEstEigSet(smoother, 0.0, SmoothedPart, 0.0, 1.1));
}

/// Jacobi with zeros where unknowns are held.
PetscErrorCode ApplyJacobi(PC preconditioner, Vec from, Vec to)
{
  void* inverse = nullptr;
  const PetscErrorCode code = PCShellGetContext(preconditioner, &inverse);
  return code ? code : VecPointwiseMult(to, from, static_cast<Vec>(inverse));
}

/// Every rank factors the whole matrix.
void SetFactor(KSP solver)
{
  const PC redundant = PreconditionerOf(solver);
  CheckPetsc(PCSetType(redundant, PCREDUNDANT));
  KSP inner;
  CheckPetsc(PCRedundantGetKSP(redundant, &inner));
  CheckPetsc(KSPSetType(inner, KSPPREONLY));
  CheckPetsc(PCSetType(PreconditionerOf(inner), PCLU));
}

}

PetscCycle::PetscCycle(
  const Ranks& ranks, RowsOfRank<Complex> matrix, std::vector<RowsOfRank<Complex>> prolongations, int cyclesInARow)
  : Matrix(ranks, std::move(matrix))
  , All(ranks)
  , CyclesInARow(cyclesInARow)
{
  for (RowsOfRank<Complex>& prolongation : prolongations)
  {
    this->Prolongations.emplace_back(ranks, std::move(prolongation));
  }
  for (const PetscRows& prolongation : this->Prolongations)
  {
    CheckPetsc(MatCreateHermitianTranspose(prolongation, this->Restrictions.emplace_back().Place()));
  }
}

void PetscCycle::Clear()
{
  this->OfEquations = {};
  this->CoarseMatrices.clear();
  this->Single = {};
}

Owned<Vec> PetscCycle::NewVector() const
{
  Owned<Vec> vector;
  CheckPetsc(MatCreateVecs(this->Matrix, nullptr, vector.Place()));
  return vector;
}

void PetscCycle::SetUp(const Vector<double>& inverseDiagonal, const std::vector<char>& isHeld, double largestEigenvalue,
  const ExecutionContext& context)
{
  this->InverseDiagonal = this->NewVector();
  CopyToPetsc(inverseDiagonal, this->InverseDiagonal);
  this->MakeCoarseMatrices(context);
  if (this->Prolongations.empty())
  {
    this->TakeHeldOut(isHeld);
  }
  CheckPetsc(KSPCreate(this->All.Communicator(), this->OfEquations.Place()));
  CheckPetsc(KSPSetOperators(this->OfEquations, this->Finest(), this->Finest()));
  CheckPetsc(KSPSetType(this->OfEquations, KSPCG));
  CheckPetsc(KSPCGSetType(this->OfEquations, KSP_CG_HERMITIAN));
  CheckPetsc(KSPSetNormType(this->OfEquations, KSP_NORM_NATURAL));
  this->SetMultigrid(largestEigenvalue);
  CheckPetsc(KSPSetUp(this->OfEquations));
  this->All.Checkpoint(context, 1.0);
}

void PetscCycle::MakeCoarseMatrices(const ExecutionContext& context)
{
  for (std::size_t level = 0; level < this->Prolongations.size(); ++level)
  {
    this->All.Checkpoint(context, static_cast<double>(level) / static_cast<double>(this->Prolongations.size()));
    const Mat P = this->Prolongations[level];
    Owned<Mat> R, AP, coarse;
    CheckPetsc(MatMatMult(this->Level(level), P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, AP.Place()));
    CheckPetsc(MatProductClear(AP)); // of what only a second product would need
    CheckPetsc(MatHermitianTranspose(P, MAT_INITIAL_MATRIX, R.Place()));
    CheckPetsc(MatMatMult(R, AP, MAT_INITIAL_MATRIX, PETSC_DEFAULT, coarse.Place()));
    CheckPetsc(MatProductClear(coarse));
    FillZeroDiagonal(coarse);
    this->CoarseMatrices.push_back(std::move(coarse));
  }
}

/// A matrix that is to be factored has the row and the column of the identity where an unknown is held.
void PetscCycle::TakeHeldOut(const std::vector<char>& isHeld)
{
  CheckPetsc(MatDuplicate(this->Matrix, MAT_COPY_VALUES, this->Single.Place()));
  PetscInt first = 0;
  CheckPetsc(MatGetOwnershipRange(this->Single, &first, nullptr));
  std::vector<PetscInt> held;
  for (std::size_t i = 0; i < isHeld.size(); ++i)
  {
    if (isHeld[i])
    {
      held.push_back(first + static_cast<PetscInt>(i));
    }
  }
  CheckPetsc(MatZeroRowsColumns(this->Single, static_cast<PetscInt>(held.size()), held.data(), 1.0, nullptr, nullptr));
}

void PetscCycle::SetMultigrid(double largestEigenvalue) const
{
  const int levels = 1 + static_cast<int>(this->CoarseMatrices.size());
  if (levels == 1)
  {
    SetFactor(this->OfEquations);
    return;
  }
  const PC cycle = this->Preconditioner();
  CheckPetsc(PCSetType(cycle, PCMG));
  CheckPetsc(PCMGSetLevels(cycle, levels, nullptr));
  CheckPetsc(PCMGSetType(cycle, PC_MG_MULTIPLICATIVE));
  CheckPetsc(PCMGMultiplicativeSetCycles(cycle, this->CyclesInARow));
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
      SetCoarseSmoother(smoother);
      CheckPetsc(PCMGSetCycleTypeOnLevel(cycle, above, PC_MG_CYCLE_W));
    }
  }
  KSP coarsest;
  CheckPetsc(PCMGGetCoarseSolve(cycle, &coarsest));
  CheckPetsc(KSPSetOperators(coarsest, this->Level(levels - 1), this->Level(levels - 1)));
  CheckPetsc(KSPSetType(coarsest, KSPPREONLY));
  SetFactor(coarsest);
}

void PetscCycle::SetFinestSmoother(KSP smoother, double largestEigenvalue) const
{
  const PC jacobi = PreconditionerOf(SetChebyshev(smoother, FinestDegree));
  CheckPetsc(PCSetType(jacobi, PCSHELL));
  CheckPetsc(PCShellSetContext(jacobi, static_cast<Vec>(this->InverseDiagonal)));
  CheckPetsc(PCShellSetApply(jacobi, ApplyJacobi));
  CheckPetsc(KSPChebyshevSetEigenvalues(smoother, largestEigenvalue, SmoothedPart * largestEigenvalue));
}

PC PetscCycle::Preconditioner() const
{
  return PreconditionerOf(this->OfEquations);
}

std::vector<LevelReport> PetscCycle::Levels() const
{
  std::vector<LevelReport> levels;
  for (std::size_t level = 0; level <= this->CoarseMatrices.size(); ++level)
  {
    levels.push_back(ReportOf(this->Level(level)));
  }
  return levels;
}

}
