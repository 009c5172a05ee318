#ifndef dmgDeflatedPreconditioner_h
#define dmgDeflatedPreconditioner_h

#include "Solvers/Krylov/KernelProjection.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"

#include <utility>

namespace dmg
{

/// A preconditioner B with an exact solve on a small space, given by the columns of H:
///
///   Q + (1 - Q A) B (1 - A Q) ,   Q = H (H^T A H)^+ H^T ,
///
/// that is, correct in H, apply B to what is left, correct in H again. For the vectors that A makes
/// smallest, as harmonic fields do, and that coarse spaces hold only nearly. Vectors of H that A maps to
/// zero are the kernel of a singular system: they are taken out of what comes in and goes out, and the
/// solution has no part in them. Symmetric, and positive definite if B is and there are no such vectors.
class DeflatedPreconditioner : public Preconditioner<double>
{
public:
  /// \param B is borrowed.
  /// \param H n x k, columns of length 1 and orthogonal, but for what they lose where A holds or penalises unknowns.
  /// \param largest a bound of the terms that h^T A h sums up, whose rounding errors are that much times
  ///   epsilon: below, an energy counts as none.
  /// Cost: k products with A; 4 k n multiplications per application.
  DeflatedPreconditioner(Preconditioner<double>& B, const LinearOperator<double>& A, Eigen::MatrixXd H, double largest,
    const ExecutionContext& context);

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override;

  /// Held by this object, without B.
  long long Bytes() const;

  /// The kernel of A in H. Right-hand sides must have no part in it.
  const KernelProjection& Kernel() const { return this->OfA; }

private:
  Preconditioner<double>& B;
  Eigen::MatrixXd H;
  Eigen::MatrixXd AH;
  Eigen::MatrixXd Inverse; ///< (H^T A H)^+
  KernelProjection OfA;
  Vector<double> Remainder;
};

}

#endif
