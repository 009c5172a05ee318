#ifndef dmgSmoothedProlongation_h
#define dmgSmoothedProlongation_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// Takes energy from the coarse functions of a prolongation, in place: steps of damped Jacobi on A P = 0, as in
/// smoothed aggregation (Vanek, Mandel and Brezina 1996), but with the fill taken back.
///
/// Each step is P <- (I - 2/3 D^{-1} A) P, D the diagonal of A. Then, in every row, entries below a
/// twentieth of the row's absolute sum are dropped, and the others grow in proportion to make up for
/// them. Where a coefficient of A jumps, as between triangles of uneven size, an interpolation that
/// knows only geometry has far too much energy; two steps repair that and leave rows that are shorter
/// than those of a barycentric interpolation.
///
/// \param A N x N, symmetric or Hermitian, positive semi-definite.
/// \param P N x n; its former entries are freed after the first step.
/// Cost per step: one product A P.
template <class Scalar>
void SmoothProlongation(
  const SparseMatrix<Scalar>& A, SparseMatrix<Scalar>& P, int steps, const ExecutionContext& context);

}

#endif
