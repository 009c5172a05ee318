#ifndef dmgPlanarProlongation_h
#define dmgPlanarProlongation_h

#include "Support/ExecutionContext.h"
#include "Support/SparseRows.h"
#include "Support/Types.h"

#include <complex>
#include <vector>

/// Prolongations of plane vectors, one per coarse unknown, to real numbers. Their matrices are complex:
/// row i takes the vectors z to
///   x_i = Re sum_j conj(p_ij) z_j ,
/// the sum of the products of the vectors p_ij with the vectors z_j.
namespace dmg
{

using PlanarProlongation = SparseMatrix<Complex>;

/// The adjoint of a prolongation whose coarse functions have little energy: of
/// (I - c_1 A) ... (I - c_k A) P for A = B^T B. The c are the inverse roots of the polynomial p that minimises the largest energy
/// that is left, max over (0, 1] of t p(t)^2; this is 1 / (2 k + 1)^2 (Chebyshev; Brezina and Vanek 1999). One coarse function is
/// smoothed after the other, in single precision.
///
/// The smoothing is needed because the energy counts divergence and curl, not the whole derivative. By the Weitzenboeck identity
/// the Hodge energy is the Dirichlet energy plus the integral of K |X|^2. Where the Gaussian curvature K is negative it is much
/// smaller, and linear interpolation does not reproduce such near-kernel fields.
///
/// \param B so that no eigenvalue of A is above 1. \param Bt its transpose.
/// \param dropped drop tolerance after each step, relative to the largest entry of a row of P.
/// \param P comes back empty, as soon as it is not needed any more.
/// Cost: k products of A with all coarse functions, where they are not zero.
RowBands<Complex32> SmoothedRestriction(const SparseMatrix<double>& B, const SparseMatrix<double>& Bt,
  PlanarProlongation&& P, int degree, double dropped, const ExecutionContext& context);

/// The lower triangle of P^T B^T B P on pairs of components: 2 m x 2 m for P of m columns.
/// \param adjoint of P as a complex matrix.
/// \param held rows of P that count as zero, ascending. The pattern does not depend on them.
SparseMatrix<double> CoarseStiffness(const SparseMatrix<double>& B, const SparseMatrix<double>& Bt,
  const SparseMatrix<Complex32>& P, const SparseMatrix<Complex32>& adjoint, const std::vector<int>& held,
  const ExecutionContext& context);

/// Q^T Q on pairs of components.
SparseMatrix<double> GramOfPlanar(const SparseMatrix<Complex32>& Q, const ExecutionContext& context);

}

#endif
