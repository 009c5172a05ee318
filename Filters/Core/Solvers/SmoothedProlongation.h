#ifndef dmgSmoothedProlongation_h
#define dmgSmoothedProlongation_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// A prolongation whose coarse functions have less energy: steps of damped Jacobi on A P = 0, as in
/// smoothed aggregation (Vanek, Mandel and Brezina 1996), but with the fill taken back.
///
/// Each step is P <- (I - 2/3 D^{-1} A) P, D the diagonal of A. Then, in every row, entries below a
/// twentieth of the row's absolute sum are dropped, and the others grow in proportion to make up for
/// them. Where a coefficient of A jumps, as between triangles of uneven size, an interpolation that
/// knows only geometry has far too much energy; two steps repair that and leave rows that are shorter
/// than those of a barycentric interpolation.
///
/// \param A N x N, symmetric or Hermitian, positive semi-definite.
/// \param P N x n.
/// Cost per step: one product A P.
template <class Scalar>
SparseMatrix<Scalar> SmoothedProlongation(const SparseMatrix<Scalar>& A,
  const SparseMatrix<Scalar>& P, int steps, const ExecutionContext& context);

}

#endif
