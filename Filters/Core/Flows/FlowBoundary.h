#ifndef dmgFlowBoundary_h
#define dmgFlowBoundary_h

#include "Analysis/BoundaryLoops.h"
#include "Mesh/TriangleMesh.h"

#include <vector>

namespace dmg
{

/// The meaning of a boundary for a flow.
enum class FlowBoundary
{
  /// A coast: nothing flows through it. The stream function is constant on each coast, and zero on the longest of each component;
  /// differences between coasts are transports between them.
  Closed,
  /// The edge of a region: the potential is zero there.
  Open,
};

/// A part of the boundary that is closed or open all along: a loop, or where a loop is partly open, an arc of it. The vertices of an arc
/// begin and end with those that it shares with its neighbours.
struct BoundaryPart : BoundaryLoop
{
  bool IsOpen = false;
  bool IsLoop = true;

  /// The vertices without those that another part has, too: the ends of arcs.
  std::vector<int> OwnVertices() const;
};

/// Whether each boundary edge is open; the same for all. #E.
std::vector<char> OpenEdges(const TriangleMesh& mesh, FlowBoundary boundary);

/// The parts of the boundary, by component, the longest of a component first.
/// \param isOpen by edge; inner edges do not count.
/// Cost: O(#F).
std::vector<BoundaryPart> PartsOfBoundary(const TriangleMesh& mesh, const std::vector<char>& isOpen);

/// All vertices of the parts that are open, or of those that are closed, ascending.
std::vector<int> VerticesOfParts(const std::vector<BoundaryPart>& parts, bool areOpen);

}

#endif
