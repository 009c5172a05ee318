#ifndef dmgAssembledHierarchy_h
#define dmgAssembledHierarchy_h

#include "Solvers/Multigrid/StiffnessHierarchy.h"
#include "Support/Types.h"

#include <memory>
#include <vector>

namespace dmg
{

/// A stiffness matrix R, and prolongations for the Galerkin products of R + D, which are computed anew for every D. It serves
/// methods that need a matrix: Cholesky factorisation, coarse spaces of any kind, full multigrid.
///
/// Unknowns stand in the caller's order. Those of a complex matrix are pairs: 2 k and 2 k + 1 are the parts of
/// complex unknown k, and D has the same value for both.
template <class Scalar>
class AssembledHierarchy : public StiffnessHierarchy
{
public:
  /// \param R n x n, symmetric or Hermitian, positive semi-definite, compressed.
  /// \param prolongations [l] is N_l x N_{l+1}, finest first. None: R + D is factored.
  /// \param B real, with R = B^T B, or empty: products are then B^T (B x), whose rounding errors are epsilon |B|^T |B x|
  ///   instead of epsilon |R| |x|. The smoothest fields, whose B x is far below |B| |x|, then have several digits
  ///   more on surfaces with thin triangles.
  AssembledHierarchy(
    SparseMatrix<Scalar>& R, std::vector<SparseMatrix<Scalar>> prolongations, SparseMatrix<double> B = {});

  double DiagonalOf(int unknown) const override;
  SparseMatrix<double> RealMatrix(const ExecutionContext& context) const override;
  std::unique_ptr<StiffnessOperator> Operator() const override;
  /// Unknowns where D is infinite are taken out of the matrix. A factor is a ShiftedFactor.
  /// \throw SolverFailure R + D could not be factored.
  std::unique_ptr<StiffnessCycle> Cycle(
    const Vector<double>& D, const StiffnessCycleOptions& options, const ExecutionContext& context) const override;
  std::unique_ptr<Preconditioner<double>> Factor(
    const Vector<double>& D, const ExecutionContext& context) const override;
  std::unique_ptr<StiffnessNestedIteration> NestedIterations(const Vector<double>& D,
    const StiffnessCycleOptions& options, bool maySweep, const ExecutionContext& context) const override;
  long long Bytes() const override;

  const SparseMatrix<Scalar>& Matrix() const { return this->R; }
  const std::vector<SparseMatrix<Scalar>>& Prolongations() const { return this->P; }

private:
  SparseMatrix<Scalar> R;
  SparseMatrix<double> B;
  Vector<double> Diagonal; ///< of R
  std::vector<SparseMatrix<Scalar>> P;
};

}

#endif
