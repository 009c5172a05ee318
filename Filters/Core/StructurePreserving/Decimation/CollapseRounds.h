#ifndef dmgCollapseRounds_h
#define dmgCollapseRounds_h

#include "StructurePreserving/Decimation/CollapseRecord.h"
#include "StructurePreserving/Decimation/CollapsibleMesh.h"
#include "StructurePreserving/Decimation/SurfaceTracking.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// Decimates in rounds: the cheapest edges whose one-rings share no face are collapsed at the same
/// time, then costs are looked at anew. Waiting for the next round has the effect of the thesis's
/// penalty on neighbours of a collapse (section 5.1): rings overlap rarely, operators stay sparse.
///
/// Stops at \p targetFaces, or before where nothing more can be collapsed without changing the
/// topology. Cost: O(#F), about ten rounds for a factor four.
/// \param records receives the collapses, oldest first; null: they are not recorded.
/// Checkpoints: several in each round. Same result for any number of threads.
void CollapseInRounds(CollapsibleMesh& mesh, SurfaceTracking& tracking, int targetFaces,
  std::vector<CollapseRecord>* records, const ExecutionContext& context);

}

#endif
