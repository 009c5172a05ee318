#ifndef dmgTestLinesAlongEdges_h
#define dmgTestLinesAlongEdges_h

#include "Mesh/TriangleMesh.h"

#include <array>
#include <vector>

namespace dmg::test
{

/// The share of the length of lines on a surface beside which a mesh of quads has an edge that runs along. It is measured at places no
/// farther from each other than a quarter of an edge of a quad: an edge is there if it is nearer than 0.15 of its length,
/// and runs along if it is within 30 degrees.
/// \param isOnLine by edge of the surface.
/// \return 1 where there are no lines.
double ShareAlongEdges(const TriangleMesh& surface, const std::vector<char>& isOnLine,
  const std::vector<std::array<int, 4>>& quads, const Points& positions);

}

#endif
