#ifndef dmgPathDetours_h
#define dmgPathDetours_h

#include "Support/ExecutionContext.h"

namespace dmg
{

class FineEdgePaths;

/// Bends paths through the coarse faces that they leave hidden.
///
/// A coarse face that no piece enters, or pieces in one direction only, would leave the fine level
/// blind for its field or for one component of it, and systems singular (the failures of the
/// thesis's table 7.9). Such faces are few; each gets a detour: a piece p -> q in a neighbour runs
/// p -> a -> b -> q instead, with a -> b along the side between the two, inside the face
/// (FineEdgePaths::Bend). The operators keep their structure along any path, and so along this one.
///
/// The edge's one value cannot show two faces: where the neighbour needed it, the neighbour gets a
/// detour from a third face, and so on until one can spare an edge. A face stays hidden where no
/// neighbour has a piece with a way along the side between them.
/// Cost: O(#F) to find such faces, in parallel; small for each of them.
void MakeDetours(FineEdgePaths& paths, const ExecutionContext& context);

}

#endif
