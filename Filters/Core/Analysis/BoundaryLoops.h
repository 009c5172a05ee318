#ifndef dmgBoundaryLoops_h
#define dmgBoundaryLoops_h

#include "Mesh/TriangleMesh.h"

#include <vector>

namespace dmg
{

/// A closed line of boundary edges.
struct BoundaryLoop
{
  std::vector<int> Vertices; ///< with the surface to the left of the way from each to the next
  int Component = 0;         ///< of the surface, as FaceComponents numbers them
  double Length = 0.0;
};

/// All boundary loops, by component, the longest of a component first. Cost: O(#F).
std::vector<BoundaryLoop> FindBoundaryLoops(const TriangleMesh& mesh);

/// All vertices on the boundary, ascending. Cost: O(#V).
std::vector<int> BoundaryVertices(const TriangleMesh& mesh);

}

#endif
