#ifndef dmgDeflatedPreconditioner_h
#define dmgDeflatedPreconditioner_h

#include "Solvers/Preconditioner.h"

#include <memory>

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
  /// \param H n x k, columns of length 1 and orthogonal.
  /// Cost: k products with A; 4 k n multiplications per application.
  DeflatedPreconditioner(std::unique_ptr<Preconditioner<double>> B, const SparseMatrix<double>& A,
    Eigen::MatrixXd H);

  void Apply(
    const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override;

  /// Held by this object, without B.
  long long Bytes() const;

private:
  std::unique_ptr<Preconditioner<double>> B;
  Eigen::MatrixXd H;
  Eigen::MatrixXd AH;
  Eigen::MatrixXd Inverse; ///< (H^T A H)^+
  Vector<double> Remainder;
};

}

#endif
