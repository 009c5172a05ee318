#ifndef dmgOneFormProlongation_h
#define dmgOneFormProlongation_h

#include "StructurePreserving/Transfers/FineEdgePaths.h"

namespace dmg
{

/// Prolongation of 1-forms, S1: the value on a fine edge is the integral of the coarse Whitney
/// interpolant along the path of that edge on the coarse mesh. A piece of it from p to q
/// (barycentric) on a coarse triangle gives p_i q_j - p_j q_i to the side ij.
///
/// Paths have the ends that S0 gives to the fine vertices, and are never pulled over a handle:
/// d0 S0 = S1 d0, closed forms stay closed, and the curl of a fine face is the coarse curl over its
/// image, so that the total is kept where the boundary is. The first two hold for every path, the
/// total for every path inside, so a coarse edge that no path sees gets one: a fine edge nearby
/// makes a detour around half of a face beside it. No column is without an entry of some size, so
/// no coarse diagonal is zero (thesis, table 7.9).
/// \return #E_l x #E_{l+1}, in the orientations of the edges of both; five to six entries per row.
/// Cost: O(#E_l). Thesis, section 4.2.
SparseMatrix<double> OneFormProlongation(const FineEdgePaths& paths, const ExecutionContext& context);

}

#endif
