#ifndef dmgPartsWithoutArea_h
#define dmgPartsWithoutArea_h

#include "Support/Types.h"

#include <functional>
#include <vector>

namespace dmg
{

/// The corner at which the longest side of a triangle begins.
int LongestSide(const Points& positions, const Triangles& triangles, int triangle);

/// Finds the triangles that hang together only with triangles whose corners lie on a line, as two do that lie back to back on an edge.
/// \param opposite gives the side that goes on across a side, or -1; side 3 t + k of triangle t runs from its corner k to the next.
/// \return per triangle, whether it is in such a part; empty where none is.
/// Cost: linear; one pass where no triangle is flat.
std::vector<char> InPartsWithoutArea(
  const Points& positions, const Triangles& triangles, const std::function<int(int side)>& opposite);

}

#endif
