#ifndef dmgSampledProlongation_h
#define dmgSampledProlongation_h

#include "Levels/PointSampling.h"
#include "Levels/TangentGraph.h"
#include "Levels/TransportOperator.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// Prolongation of directions from the samples of a graph to its points: linear in the tangent
/// plane of the sample that owns the point. The neighbours of the sample divide that plane into
/// triangles with it; the point takes the barycentric weights of the one it lies in, or, beyond its
/// far side or beyond a boundary, those of the nearest place on its sides. Where the surface is
/// flat, linear functions and parallel directions are reproduced. \param samples GraphOfSamples of
/// the sampling. \return #points x #samples, in their frames; at most 3 entries per row. Cost:
/// O(points).
TransportOperator SampledProlongation(
  const PointSampling& sampling, const TangentGraph& samples, const ExecutionContext& context);

/// The same with other rows.
/// \param points [i] is the point of row i; some or all of the points, in any order.
TransportOperator SampledProlongation(const PointSampling& sampling, const TangentGraph& samples,
  const std::vector<int>& points, const ExecutionContext& context);

}

#endif
