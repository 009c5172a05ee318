#ifndef dmgStationaryIteration_h
#define dmgStationaryIteration_h

#include "Solvers/Krylov/ConvergenceMeasure.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// Solves A x = b by x += B (b - A x): plain multigrid, if B is a V-cycle. Converges if the
/// eigenvalues of B A lie between 0 and 2.
///
/// Parameters, report and errors as for ConjugateGradient; B need not be symmetric. Stops short, with
/// a warning, at the limit or after ten cycles that do not improve on the best residual.
/// Cost per iteration: one application of B and one product with A.
template <class Scalar>
void StationaryIteration(const LinearOperator<Scalar>& A, Preconditioner<Scalar>& B, const Vector<Scalar>& b,
  const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
  const ConvergenceMeasure<Scalar>* measure = nullptr);

}

#endif
