#ifndef dmgPetscMultigrid_h
#define dmgPetscMultigrid_h

#include "Pieces/Solvers/PieceLevels.h"
#include "Pieces/Surface/Ranks.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <vector>

namespace dmg
{

class PetscCycle;

/// Equations (L + D) x = b over all ranks, solved by PETSc's conjugate gradients and multigrid (PetscCycle).
///
/// L and the prolongations are there once; D changes the diagonal of L and some rows of the first prolongation. Fixed unknowns are zero:
/// smoother and prolongation have zero rows there. All vectors are of owned rows.
///
/// \pre PETSc is initialised (PetscSession) as long as the object lives. All functions are collective, but for Stiffness.
class PetscMultigrid
{
public:
  /// \param laplacian L, Hermitian and positive semi-definite, of owned rows; PETSc works on its memory.
  /// \param prolongations finest first, of owned rows; taken, too.
  /// \param cyclesInARow per iteration, >= 1.
  PetscMultigrid(const Ranks& ranks, RowsOfRank<Complex> laplacian, std::vector<RowsOfRank<Complex>> prolongations,
    int cyclesInARow);
  ~PetscMultigrid();

  /// The diagonal of L.
  const Vector<double>& Stiffness() const { return this->StiffnessOfOwned; }

  /// Takes other penalties, before the first solve and after that for as many as follow. After an error it has to be called again.
  /// \param D >= 0. \param isHeld unknowns that are zero.
  /// \throw SolverFailure
  /// \throw Cancelled
  /// Cost: Galerkin products.
  void SetPenalties(const Vector<double>& D, const std::vector<char>& isHeld, const ExecutionContext& context);

  /// (L - its diagonal) x.
  Vector<Complex> MultiplyOffDiagonal(const Vector<Complex>& x);
  /// (L + D) x. \pre x is zero where unknowns are held; there the product means nothing.
  Vector<Complex> Multiply(const Vector<Complex>& x);
  /// One V-cycle from zero for a right-hand side.
  Vector<Complex> Precondition(const Vector<Complex>& r);

  /// x from zero.
  /// \param b zero where unknowns are held.
  /// \throw Cancelled on all ranks, where one was asked to stop.
  Vector<Complex> Solve(
    const Vector<Complex>& b, const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context);

  /// Unknowns and entries of all ranks, finest first.
  std::vector<LevelReport> Levels() const;

private:
  void SetDiagonal(const Vector<double>& diagonal);
  double LargestEigenvalue(const std::vector<char>& isHeld) const;
  void WeakenRows(const Vector<double>& shares);
  void RestoreRows();

  const Ranks& All;
  Vector<double> StiffnessOfOwned;
  Vector<double> Diagonal; ///< of L + D
  std::unique_ptr<PetscCycle> Cycle;
  std::vector<int> WeakenedRows;          ///< of the first prolongation
  std::vector<Complex> EntriesOfWeakened; ///< before they were weakened
};

}

#endif
