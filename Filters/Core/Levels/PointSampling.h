#ifndef dmgPointSampling_h
#define dmgPointSampling_h

#include "Levels/TangentGraph.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"
#include "Support/Unfilled.h"

#include <vector>

namespace dmg
{

/// Some points of a graph, and where all others lie around them.
struct PointSampling
{
  /// The points chosen, ascending.
  std::vector<int> Samples;
  /// Per point the sample that it belongs to, as an index into Samples: the nearest one, nearly.
  Unfilled<int> Owners;
  /// Per point its place in the tangent plane of its owner: the discrete exponential map (Schmidt,
  /// Grimm and Wyvill 2006), zero for the owner itself.
  Unfilled<Complex> Places;
  /// Carries directions from the frame of the point into the frame of its owner; unit.
  Unfilled<Complex> Turns;
};

/// Chooses points at a distance of each other that follows the spacing of the points around them,
/// and so dense that none could be added: two samples are farther apart than \p radius times the
/// smaller of their spacings. The spacing of a point is the harmonic mean of its three shortest
/// steps: where points lie densely in one direction only, as across the long sides of thin faces,
/// samples thin them out in that direction, and do not pass over what couples tightly there.
/// Distances are those in the tangent planes of the samples. Where the surface is curved samples are
/// denser: what fields turn by from one side of a sample's region to the other cannot be interpolated.
/// \param radius > 0.
/// \param largestCurvature a sample covers no points that hold more, in radians; the curvature of each
///   point counts without its sign. Itself it covers always.
/// Cost: linear for bounded radius and valence. Wiersma et al. 2023 sample the same way, with one
/// radius for all points and without regard to curvature.
PointSampling SamplePoints(
  const TangentGraph& graph, double radius, double largestCurvature, const ExecutionContext& context);

/// The samples with those whose points touch. Steps and turns are means over all links between the
/// points of two samples, so that the curvature between them is spread rather than drawn at random. The
/// curvature of a sample is the sum over its points.
/// Cost: O(links).
TangentGraph GraphOfSamples(const TangentGraph& graph, const PointSampling& sampling, const ExecutionContext& context);

}

#endif
