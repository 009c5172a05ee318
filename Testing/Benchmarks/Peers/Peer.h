#ifndef dmgBenchmarksPeer_h
#define dmgBenchmarksPeer_h

#include "Solvers/Krylov/SolveReport.h"
#include "Support/Types.h"

#include <string>

namespace dmg::peers
{

/// A solver that ours are measured against: what a user would take today, done well. One
/// thread, but for the BLAS of a factorisation.
template <class Scalar>
class Peer
{
public:
  virtual ~Peer() = default;

  virtual std::string Name() const = 0;

  /// Orders, and factors or builds a preconditioner.
  /// \param A symmetric or Hermitian positive definite; borrowed until the last Solve.
  /// \throw SolverFailure
  virtual void Prepare(const SparseMatrix<Scalar>& A) = 0;

  /// x = A^-1 b, up to |b - A x| <= tolerance |b| for iterative peers.
  /// \return the number of iterations; 0 for direct peers.
  /// \throw SolverFailure the tolerance was not reached.
  virtual int Solve(const Vector<Scalar>& b, double tolerance, Vector<Scalar>& x) = 0;

  /// Held after Prepare, beside A; 0 where the library does not tell.
  virtual long long Bytes() const = 0;
};

}

#endif
