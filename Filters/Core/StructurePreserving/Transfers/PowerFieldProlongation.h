#ifndef dmgPowerFieldProlongation_h
#define dmgPowerFieldProlongation_h

#include "Levels/TransportOperator.h"
#include "Mesh/TangentFrames.h"
#include "StructurePreserving/Transfers/FineEdgePaths.h"

namespace dmg
{

/// Prolongation of power fields, SP, for all N at once.
///
/// The sides of a fine face are cut into pieces, each on one coarse face. A piece compares the two
/// frames: it has a direction on the fine face, that of its side, and one on the coarse face. All
/// pieces on one coarse face make one entry, whose angle is their mean rotation and whose weight is
/// their share of the length. (With the unnormalised edges of the thesis's pseudo-inverse, long
/// pieces would count by |e|^2N; unit directions weighted by length are sound for every N.)
/// \return #F_l x #F_{l+1}; about three entries per row; rows sum to 1 in weight.
/// Cost: O(#F_l). Thesis, section 4.4.
TransportOperator PowerFieldProlongation(const FineEdgePaths& paths, const TangentFrames& fineFrames,
  const TangentFrames& coarseFrames, const ExecutionContext& context);

}

#endif
