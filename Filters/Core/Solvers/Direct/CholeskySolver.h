#ifndef dmgCholeskySolver_h
#define dmgCholeskySolver_h

#include "Support/Errors.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>

namespace dmg
{

/// The permutation that keeps the factor sparse.
enum class FillOrdering
{
  AMD,   ///< approximate minimum degree: cheapest, best up to about a million unknowns
  METIS, ///< nested dissection: smaller factors, a more expensive ordering
  Best,  ///< AMD, and METIS too where AMD predicts high fill; the smaller factor is kept
};

/// A pivot is not positive: the matrix is not positive definite, or rounding errors hide that it is.
class NotPositiveDefinite : public UnexpectedFailure
{
public:
  using UnexpectedFailure::UnexpectedFailure;
};

/// Memory is not enough for a factor.
class FactorDoesNotFit : public SolverFailure
{
public:
  using SolverFailure::SolverFailure;
};

/// Supernodal sparse Cholesky factorisation A = L L^H of a symmetric (double) or Hermitian (Complex)
/// positive definite matrix, by CHOLMOD with its 64-bit indices. Built without GPL (DMG_GPL), it is simplicial.
///
/// For matrices of surface meshes, n unknowns: about n^1.5 operations and n log n memory to factor,
/// one pass over the factor to solve. The bits of a result may depend on the BLAS in use and on its
/// own threads.
template <class Scalar>
class CholeskySolver
{
public:
  /// Orders, analyses and factors \p A. Only its lower triangle is read.
  /// \pre A is square and compressed.
  /// \throw NotPositiveDefinite
  /// \param context is asked before the ordering and before the factor, and not inside of these, which CHOLMOD makes.
  /// \throw FactorDoesNotFit
  /// \throw Cancelled
  explicit CholeskySolver(const SparseMatrix<Scalar>& A, FillOrdering ordering = FillOrdering::AMD,
    const ExecutionContext& context = SerialContext());
  ~CholeskySolver();
  CholeskySolver(CholeskySolver&&) noexcept;
  CholeskySolver& operator=(CholeskySolver&&) noexcept;

  /// Factors other values in the same pattern; ordering and analysis are kept.
  /// \throw as above; Solve must not be called after that.
  void Update(const SparseMatrix<Scalar>& A);

  /// x = A^-1 b. Uses a workspace of the solver: one solve at a time. Its few vectors are made at the first solve.
  /// \throw SolverFailure memory ran out.
  void Solve(const Vector<Scalar>& b, Vector<Scalar>& x);

  /// The same for each column of b, in little more time than for one.
  using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  void Solve(const Columns& b, Columns& x);

  int NumberOfUnknowns() const;
  /// The entries of L, with the explicit zeros of its supernodes.
  long long NonZeros() const;
  /// Held by the factor.
  long long Bytes() const;
  /// A rough estimate of 1 / cond(A) from the diagonal of L.
  double ReciprocalCondition() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
