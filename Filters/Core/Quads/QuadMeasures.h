#ifndef dmgQuadMeasures_h
#define dmgQuadMeasures_h

#include "Quads/QuadMesh.h"
#include "Quads/QuadRounds.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// Fills in the part of the report of a quad mesh that its quads tell.
/// \param rounds that it is of. \param topology of the quads.
void MeasureQuads(
  const QuadRounds& rounds, const QuadTopology& topology, QuadMesh& mesh, const ExecutionContext& context);

}

#endif
