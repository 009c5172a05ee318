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

/// A maximal set of points, two of which are farther apart than \p radius times the smaller of their spacings. The spacing of a
/// point is the harmonic mean of its three shortest steps. So points that lie densely in one direction only, as across the long
/// sides of thin faces, are thinned out in that direction. Distances are those in the tangent planes of the samples. Curved
/// regions have more samples, since the rotation of a field within the region of a sample cannot be interpolated.
/// \param radius > 0.
/// \param largestCurvature the integral of the absolute curvature over the points that a sample covers is at most this, in radians.
///   A sample always covers itself.
/// Cost: linear for bounded radius and valence. Wiersma et al. 2023 sample the same way, with one
/// radius for all points and without regard to curvature.
PointSampling SamplePoints(
  const TangentGraph& graph, double radius, double largestCurvature, const ExecutionContext& context);

}

#endif
