#ifndef dmgQuadSmoothing_h
#define dmgQuadSmoothing_h

#include "Constraints/NearestPlaces.h"
#include "Quads/Isolines/CellPlaces.h"
#include "Quads/Isolines/IndexedQuads.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// The scaled Jacobian of each quad: of its four corners, the least sine of the angle from the next side to the one before, where the
/// mean normal of the quad says which sines are positive. 1 for rectangles, not positive for quads that are folded or no longer convex.
Vector<double> ScaledJacobians(const std::vector<std::array<int, 4>>& quads, const Points& positions);

/// Moves free vertices towards the mean of their neighbours, and back to the nearest place of the surface near by.
void SmoothQuads(const NearestPlaces& surface, const IndexedQuads& quads, int steps, CellPlaces& places,
  const ExecutionContext& context);

/// Moves free vertices of quads that are folded or hardly convex to where the worst quad around them is best, of some places near by.
void Untangle(
  const NearestPlaces& surface, const IndexedQuads& quads, CellPlaces& places, const ExecutionContext& context);

}

#endif
