#ifndef dmgBenchmarksIterativePeer_h
#define dmgBenchmarksIterativePeer_h

#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Support/Errors.h"
#include "Support/MatrixOperator.h"

namespace dmg::peers
{

/// Where iterative peers give up.
constexpr int LargestNumberOfIterations = 5000;

/// Our conjugate gradients in one thread with the preconditioner of a peer.
/// \return the number of iterations.
/// \throw SolverFailure the tolerance was not reached.
template <class Scalar>
int SolveIteratively(const SparseMatrix<Scalar>& A, Preconditioner<Scalar>& B, const Vector<Scalar>& b,
  double tolerance, Vector<Scalar>& x)
{
  SolveReport report;
  x.resize(0);
  ConjugateGradient(
    test::MatrixOperator<Scalar>(A), B, b, { tolerance, LargestNumberOfIterations }, x, report, SerialContext());
  if (!report.Converged)
  {
    throw SolverFailure(report.Warnings.back());
  }
  return report.Iterations.back().Iteration;
}

}

#endif
