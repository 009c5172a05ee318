#ifndef dmgCollapseQueue_h
#define dmgCollapseQueue_h

#include "StructurePreserving/Decimation/CollapseRecord.h"
#include "StructurePreserving/Decimation/CollapsibleMesh.h"
#include "StructurePreserving/Decimation/SurfaceTracking.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// Decimates as the thesis does (section 5.1): always the cheapest edge; after each collapse, the
/// edges around the new vertex pay the largest initial cost on top of their own, so that they come
/// last. Sequential; O(#F log #F). Otherwise as CollapseInRounds.
void CollapseByQueue(CollapsibleMesh& mesh, SurfaceTracking& tracking, int targetFaces,
  std::vector<CollapseRecord>* records, const ExecutionContext& context);

}

#endif
