#ifndef dmgPetscCycle_h
#define dmgPetscCycle_h

#include "Pieces/Solvers/PetscObjects.h"
#include "Pieces/Solvers/PieceLevels.h"
#include "Pieces/Surface/Ranks.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

namespace dmg
{

/// PETSc's conjugate gradients over all ranks, preconditioned by one V-cycle of its multigrid with Galerkin products, two below the
/// finest level.
///
/// The smoothers are Chebyshev polynomials with Jacobi, which do not depend on how rows are spread over the ranks: degree 6 on the
/// finest level, with a given bound of the eigenvalues, and degree 3 with estimated ones below. The coarsest system is factored by
/// every rank.
///
/// \pre PETSc is initialised (PetscSession) as long as the object lives. All functions are collective.
class PetscCycle
{
public:
  /// \param matrix Hermitian and positive semi-definite, of owned rows; PETSc works on its memory.
  /// \param prolongations finest first, of owned rows; taken, too.
  /// \param cyclesInARow per iteration, >= 1.
  PetscCycle(
    const Ranks& ranks, RowsOfRank<Complex> matrix, std::vector<RowsOfRank<Complex>> prolongations, int cyclesInARow);

  /// The matrix and the prolongations, whose entries may change between Clear and SetUp.
  PetscRows Matrix;
  std::deque<PetscRows> Prolongations;

  /// Frees what SetUp has made.
  void Clear();

  /// Makes the coarse levels and the solver.
  /// \param inverseDiagonal of the matrix; zero where unknowns are held, which the smoother then leaves as they are.
  /// \param isHeld unknowns that are zero.
  /// \param largestEigenvalue a bound of those of the matrix over its diagonal.
  /// \throw SolverFailure
  /// \throw Cancelled
  void SetUp(const Vector<double>& inverseDiagonal, const std::vector<char>& isHeld, double largestEigenvalue,
    const ExecutionContext& context);

  KSP Solver() const { return this->OfEquations; }
  /// One V-cycle.
  PC Preconditioner() const;

  /// Calls function(from, to) with vectors of PETSc's, the first one equal to x. \return the second one.
  template <class Function>
  Vector<Complex> Apply(const Vector<Complex>& x, const Function& function) const;

  /// Unknowns and entries of all ranks, finest first.
  std::vector<LevelReport> Levels() const;

private:
  Mat Finest() const { return this->Single ? Mat(this->Single) : Mat(this->Matrix); }
  Mat Level(std::size_t level) const { return level == 0 ? this->Finest() : Mat(this->CoarseMatrices[level - 1]); }
  Owned<Vec> NewVector() const;
  void MakeCoarseMatrices(const ExecutionContext& context);
  void TakeHeldOut(const std::vector<char>& isHeld);
  void SetMultigrid(double largestEigenvalue) const;
  void SetFinestSmoother(KSP smoother, double largestEigenvalue) const;

  const Ranks& All;
  const int CyclesInARow;
  std::vector<Owned<Mat>> Restrictions; ///< they have no memory of their own
  Owned<Vec> InverseDiagonal;
  Owned<Mat> Single; ///< the matrix without what is held, where there are no coarse levels
  std::vector<Owned<Mat>> CoarseMatrices;
  Owned<KSP> OfEquations;
};

template <class Numbers>
void CopyToPetsc(const Numbers& from, Vec to)
{
  PetscScalar* values;
  CheckPetsc(VecGetArray(to, &values));
  std::copy(from.data(), from.data() + from.size(), values);
  CheckPetsc(VecRestoreArray(to, &values));
}

template <class Function>
Vector<Complex> PetscCycle::Apply(const Vector<Complex>& x, const Function& function) const
{
  const Owned<Vec> from = this->NewVector();
  const Owned<Vec> to = this->NewVector();
  CopyToPetsc(x, from);
  function(Vec(from), Vec(to));
  Vector<Complex> y(x.size());
  const PetscScalar* results;
  CheckPetsc(VecGetArrayRead(to, &results));
  std::copy(results, results + y.size(), y.data());
  CheckPetsc(VecRestoreArrayRead(to, &results));
  return y;
}

}

#endif
