#ifndef dmgQuadSmoothing_h
#define dmgQuadSmoothing_h

#include "Places/NearestPlaces.h"
#include "Quads/Crosses/LinesOfEdges.h"
#include "Quads/Isolines/CellPlaces.h"
#include "Quads/Isolines/IndexedQuads.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// The mean normal of the surface around each quad: at its corners and within it.
/// \param faces by quad, one below it. \param places by vertex.
Points OutsidesOf(const FramedMesh& surface, const std::vector<std::array<int, 4>>& quads,
  const std::vector<int>& faces, const std::vector<SurfacePlace>& places);

/// The scaled Jacobian of each quad: of its four corners, the least sine of the angle from the next side to the one before, where the
/// mean normal of the quad, on the outside of the surface, says which sines are positive. 1 for rectangles, 0 where a corner is straight, less
/// for quads that are folded, no longer convex, or upside down.
/// \param outsides by quad (OutsidesOf).
Vector<double> ScaledJacobians(
  const std::vector<std::array<int, 4>>& quads, const Points& positions, const Points& outsides);

/// Moves vertices towards the corners of the squares that are nearest to the quads around them, and back to the nearest place of the surface,
/// or of their line, near by. A square is of any size, and turned as its quad is (shape matching; Bouaziz et al. 2012). Quads that are
/// folded unfold, as squares are counter-clockwise seen from outside.
void SmoothQuads(const NearestPlaces& surface, const LinesOfEdges& lines, const IndexedQuads& quads, int steps,
  CellPlaces& places, const ExecutionContext& context);

/// Moves vertices of quads that are folded or hardly convex to where the worst quad around them is best, of some places near by.
void Untangle(const NearestPlaces& surface, const LinesOfEdges& lines, const IndexedQuads& quads, CellPlaces& places,
  const ExecutionContext& context);

}

#endif
