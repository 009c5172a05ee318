#ifndef dmgSplitTriangles_h
#define dmgSplitTriangles_h

#include "Quads/Isolines/CellPlaces.h"
#include "Quads/Isolines/IndexedQuads.h"

#include <vector>

namespace dmg
{

/// Replaces the quads of some components of the surface by three for each triangle, and each of these by four as long as they are too few.
/// Such quads follow no field, but have the Euler number of any surface.
/// \param components of the faces of the surface.
/// \param wanted by component: the number of quads; 0 where its quads stay, -1 where it has none in the end.
/// \return the number of triangles.
int SplitTriangles(const TriangleMesh& mesh, const std::vector<int>& components, const std::vector<double>& wanted,
  IndexedQuads& quads, CellPlaces& places);

}

#endif
