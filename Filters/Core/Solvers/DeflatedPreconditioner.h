#ifndef dmgDeflatedPreconditioner_h
#define dmgDeflatedPreconditioner_h

#include "Solvers/LinearOperator.h"
#include "Solvers/Preconditioner.h"

namespace dmg
{

/// A preconditioner B with an exact solve on a small space, given by the columns of H:
///
///   Q + (1 - Q A) B (1 - A Q) ,   Q = H (H^T A H)^+ H^T ,
///
/// that is, correct in H, apply B to what is left, correct in H again. For the vectors that A makes
/// smallest, as harmonic fields do, and that coarse spaces hold only nearly. Symmetric positive
/// definite if B is.
class DeflatedPreconditioner : public Preconditioner<double>
{
public:
  /// \param B is borrowed.
  /// \param H n x k, columns of length 1 and orthogonal.
  /// \param largest about the largest eigenvalue of A, whose rounding errors are that much times
  ///   epsilon.
  /// Cost: k products with A; 4 k n multiplications per application.
  DeflatedPreconditioner(Preconditioner<double>& B, const LinearOperator<double>& A,
    Eigen::MatrixXd H, double largest, const ExecutionContext& context);

  void Apply(
    const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override;

  /// Held by this object, without B.
  long long Bytes() const;

private:
  Preconditioner<double>& B;
  Eigen::MatrixXd H;
  Eigen::MatrixXd AH;
  Eigen::MatrixXd Inverse; ///< (H^T A H)^+
  Vector<double> Remainder;
};

}

#endif
