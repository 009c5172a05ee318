#ifndef dmgFormOnPolygons_h
#define dmgFormOnPolygons_h

#include "Mesh/SurfaceRelation.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Completes a 1-form that is known on the edges of polygons: the diagonals that cut a polygon into triangles get the values
/// for which its curl is spread evenly over its area. So closed forms stay closed, and integrals of linear vector fields in a
/// plane stay such.
/// \param form one number per edge, from its smaller to its larger vertex.
/// \param isKnown by edge; 1 for the diagonals in the end.
/// \return the first edge that is still unknown, as it belongs to a boundary or to two polygons; -1 if there is none.
/// Cost: linear.
int FillDiagonals(
  const TriangleMesh& mesh, const SurfaceRelation& surface, Vector<double>& form, std::vector<char>& isKnown);

}

#endif
