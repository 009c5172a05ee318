#ifndef dmgSignFlips_h
#define dmgSignFlips_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

namespace dmg
{

/// Whether directions flip from neighbour to neighbour as only those without a sign do, such as eigenvectors: nearly opposite
/// ones are more than 5 % of all pairs, and at least twice as many as those that turn by 45 to 135 degrees.
/// \param directions one per face, or per vertex, in \p frames; zero where there is none.
/// \param areAtVertices whether there is one per vertex. Neighbours share an edge.
/// Cost: O(#E).
bool FlipsLikeAxes(
  const TriangleMesh& mesh, const TangentFrames& frames, const Vector<Complex>& directions, bool areAtVertices);

}

#endif
