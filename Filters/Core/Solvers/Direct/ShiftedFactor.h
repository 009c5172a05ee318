#ifndef dmgShiftedFactor_h
#define dmgShiftedFactor_h

#include "Solvers/Direct/CholeskySolver.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>

namespace dmg
{

/// The inverse of A + shift diag(A) by a sparse Cholesky factorisation, as a preconditioner for conjugate
/// gradients on A itself: a direct solver that does not break down where A is Hermitian positive semi-definite,
/// or definite but for rounding errors.
///
/// Cholesky needs pivots above zero. Those of a sum of squares A = B^T B + D are, in exact arithmetic, but A has
/// the squared condition of B: where triangles are thin, or a kernel is held by weak prescriptions alone, the smallest
/// eigenvalues lie below the rounding errors of A, and pivots come out negative. The backward error of the
/// factorisation is bounded entry by entry, |dA_ij| <= c epsilon sqrt(A_ii A_jj) (Higham 2002, theorem 10.3), so a
/// share of the diagonal, whatever its scale, outweighs it. The shift changes eigenvalues of diag(A)^-1 A far above it by next
/// to nothing, and conjugate gradients undo what it does to the others: they take 1 iteration where A is well
/// conditioned and one or two more for each eigenvalue near the shift.
///
/// The kernel of A does not need to be known. For a right-hand side in the range of A, conjugate gradients from zero
/// stay diag(A)-orthogonal to the kernel: of all solutions they find the one that is least in the norm of diag(A), up
/// to rounding errors of epsilon / shift.
///
/// Nearly undetermined modes remain. They make x large, and the residual stays above epsilon |diag(A) x| / |b|, whatever the
/// shift. Deflate them first.
///
/// With a matrix that was assembled, the product A x has rounding errors of epsilon |A| |x|, as the pivots have. Where the
/// smallest eigenvalues count, conjugate gradients take B^T (B x) + D x instead (AssembledHierarchy).
template <class Scalar>
class ShiftedFactor : public Preconditioner<Scalar>
{
public:
  static constexpr double SmallestShift = 1e-13;
  /// The factor by which the shift grows after a breakdown.
  static constexpr double Growth = 100.0;
  static constexpr double LargestShift = 1e-7;

  /// Orders, analyses and factors. Where a diagonal entry is zero, and so its row of a semi-definite matrix, the
  /// factor has a one.
  /// \param A Hermitian positive semi-definite, square and compressed; its lower triangle is read. Used during the call
  ///   only.
  /// \throw SolverFailure A is not positive semi-definite, by more than LargestShift of its diagonal, or memory
  ///   ran out.
  /// Cost: that of CholeskySolver, once more for each breakdown.
  explicit ShiftedFactor(const SparseMatrix<Scalar>& A, double leastShift = SmallestShift);

  /// Factors other values in the same pattern; the ordering is kept.
  /// \throw as above; Apply must not be called after that.
  void Update(const SparseMatrix<Scalar>& A, double leastShift = SmallestShift);

  /// z = (A + shift diag(A))^-1 r.
  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) override;

  /// The share of the diagonal with which the factorisation succeeded.
  double Shift() const { return this->Share; }
  /// The entries of the factor.
  long long NonZeros() const { return this->Factor->NonZeros(); }
  /// Held by the factor.
  long long Bytes() const { return this->Factor->Bytes(); }

private:
  /// Calls factor(A + shift diag(A)) with a shift that grows until it succeeds.
  template <class FactorMatrix>
  void FactorFrom(double leastShift, const SparseMatrix<Scalar>& A, const FactorMatrix& factor);

  std::unique_ptr<CholeskySolver<Scalar>> Factor;
  double Share = SmallestShift;
};

extern template class ShiftedFactor<double>;
extern template class ShiftedFactor<Complex>;

}

#endif
