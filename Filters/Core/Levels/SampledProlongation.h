#ifndef dmgSampledProlongation_h
#define dmgSampledProlongation_h

#include "Levels/PointSampling.h"
#include "Levels/TangentGraph.h"
#include "Levels/TransportOperator.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// Prolongation of directions from the samples of a graph to its points: linear in the tangent plane of the sample that owns the
/// point. The neighbours of the sample divide that plane into triangles with it. The point takes the barycentric weights of the
/// triangle that it lies in. Beyond its far side or beyond a boundary, it takes those of the nearest place on its sides.
/// On a flat surface, linear functions and parallel directions are reproduced.
/// \param samples GraphOfSamples of the sampling.
/// \return a row per point and a column per sample, in their frames; at most 3 entries per row.
/// Cost: O(points).
TransportOperator SampledProlongation(
  const PointSampling& sampling, const TangentGraph& samples, const ExecutionContext& context);

/// Prolongation to some or all of the points.
/// \param points [i] is the point of row i; in any order.
TransportOperator SampledProlongation(const PointSampling& sampling, const TangentGraph& samples,
  const std::vector<int>& points, const ExecutionContext& context);

}

#endif
