#ifndef dmgHierarchicalOrder_h
#define dmgHierarchicalOrder_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// \throw InvalidInput the sizes do not chain, from N_0 on.
template <class Scalar>
void CheckChain(long long size, const std::vector<SparseMatrix<Scalar>>& prolongations);

/// Sorts the unknowns of all levels: the children of a coarse unknown follow each other, in the order of
/// their parents, down from the coarsest level. A child's parent is the one with the largest weight. Where columns come in
/// pairs (HasPairs), so do children.
/// \param prolongations [l] is N_l x N_{l+1}, compressed; on exit in the new order.
/// \param size N_0, for no prolongations at all.
/// \return [k] is the former index of unknown k of level 0.
/// \throw Cancelled
template <class Scalar>
std::vector<int> RenumberHierarchically(
  std::vector<SparseMatrix<Scalar>>& prolongations, int size, const ExecutionContext& context);

}

#endif
