#ifndef dmgConjugateGradient_h
#define dmgConjugateGradient_h

#include "Solvers/Krylov/ConvergenceMeasure.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// Solves A x = b by preconditioned conjugate gradients in double precision.
///
/// \param A symmetric or Hermitian, positive definite on the part of space that b lies in.
/// \param B symmetric or Hermitian positive definite.
/// \param x start, or empty for zero; on exit the solution. If the iteration does not converge, the
///   vector with the smallest residual that it met.
/// \param report gets Iterations, SolveSeconds and Converged anew, and a warning if the iteration
///   stops short: at the limit, where rounding errors forbid progress, or because A or B is not
///   positive definite. Residuals are measured as IterationMonitor says; they are those of the recurrence, that of
///   the returned x is b - A x.
/// \param measure for the columns Energy, MassResidual and Error of the history; may be null.
/// \throw InvalidInput b or the start is not finite, or sizes differ.
/// \throw Cancelled
/// Checkpoints: every iteration.
/// A zero right-hand side has the solution zero, whatever the start.
/// Cost per iteration: one application of B, one product with A and about ten passes over a vector; in the end, one application
/// more, unless \p stop lets an estimate do.
template <class Scalar>
void ConjugateGradient(const LinearOperator<Scalar>& A, Preconditioner<Scalar>& B, const Vector<Scalar>& b,
  const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
  const ConvergenceMeasure<Scalar>* measure = nullptr);

}

#endif
