#ifndef dmgGridCoordinates_h
#define dmgGridCoordinates_h

#include "Quads/Isolines/IndexedQuads.h"

#include <array>
#include <vector>

namespace dmg
{

/// The integers u and v at the four corners of a quad, in their order.
using CornersInGrid = std::array<std::array<int, 2>, 4>;

/// Lays quads out on the integer grid: each one is a unit square, counter-clockwise, and goes on in the squares beside it but across cuts.
/// The grid is that of the seamless map up to quarter turns and shifts, where the map is not folded. Squares of a component may lie on each other, as
/// sheets of one surface above the plane; a texture that repeats sees none of that.
/// Quads are laid out from the first one of each component, nearest ones first, so that cuts end at irregular vertices and are far from that quad.
/// Cost: linear.
std::vector<CornersInGrid> LayOutOnGrid(const QuadTopology& topology);

}

#endif
