#ifndef dmgPetscMultigrid_h
#define dmgPetscMultigrid_h

#include "Pieces/PieceLevels.h"
#include "Pieces/Ranks.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <vector>

namespace dmg
{

/// Equations A x = b over all ranks, solved by PETSc's conjugate gradients, preconditioned by one V-cycle of its multigrid with
/// Galerkin products, two below the finest level.
///
/// The smoothers are Chebyshev polynomials with Jacobi, which do not depend on how rows are spread over the ranks: degree 6 on the
/// finest level, with a given bound of the eigenvalues of A over its diagonal, and degree 3 with estimated ones below. The coarsest
/// system is factored by every rank.
///
/// \pre PETSc is initialised (PetscSession) as long as the object lives. All functions are collective.
class PetscMultigrid
{
public:
  /// \param matrix A, Hermitian and positive definite, of owned rows.
  /// \param prolongations finest first, of owned rows.
  /// \param largestEigenvalue a bound of those of A over its diagonal.
  /// \param cyclesInARow per iteration, >= 1.
  /// \throw SolverFailure
  /// \throw Cancelled
  PetscMultigrid(const Ranks& ranks, const RowsOfRank<Complex>& matrix,
    const std::vector<RowsOfRank<Complex>>& prolongations, double largestEigenvalue, int cyclesInARow,
    const ExecutionContext& context);
  ~PetscMultigrid();

  /// x from zero.
  /// \param b, and the result, of owned rows.
  /// \throw Cancelled on all ranks, where one was asked to stop.
  Vector<Complex> Solve(
    const Vector<Complex>& b, const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context);

  /// A x.
  Vector<Complex> Multiply(const Vector<Complex>& x);
  /// What one V-cycle from zero makes of a right-hand side.
  Vector<Complex> Precondition(const Vector<Complex>& r);

  /// Unknowns and entries of all ranks, finest first.
  std::vector<LevelReport> Levels() const;

private:
  struct Objects;
  std::unique_ptr<Objects> Of;
  const Ranks& All;
};

}

#endif
