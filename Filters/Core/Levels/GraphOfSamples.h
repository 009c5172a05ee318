#ifndef dmgGraphOfSamples_h
#define dmgGraphOfSamples_h

#include "Levels/PointSampling.h"
#include "Levels/TangentGraph.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The graph of the samples: two are linked if points of theirs are. Steps and turns are means over all links between the points of
/// two samples. The curvature of a sample is the sum over its points.
/// Cost: O(links).
TangentGraph GraphOfSamples(const TangentGraph& graph, const PointSampling& sampling, const ExecutionContext& context);

}

#endif
