#ifndef dmgSurfaceSamples_h
#define dmgSurfaceSamples_h

#include "Drawing/UnfoldedSurface.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// Points spread evenly over a surface: no two are nearer to each other than a distance, measured over the surface, and
/// hardly a place is farther than that from all of them (Poisson-disc samples by dart throwing, R. L. Cook, Stochastic
/// sampling in computer graphics, 1986). The darts are a low-discrepancy sequence over the area, so that the result is
/// the same every time; last, the centre of every face that is still uncovered is tried.
///
/// \param distance > 0, in the unit of the points.
/// \pre the faces have places in the sequence by their order, which should follow the surface (SpatialOrder).
/// Cost: O(#F + area / distance^2).
/// \throw Cancelled
std::vector<SurfacePoint> EvenlySpreadPoints(
  const UnfoldedSurface& surface, double distance, const ExecutionContext& context = SerialContext());

}

#endif
