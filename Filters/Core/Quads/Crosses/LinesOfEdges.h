#ifndef dmgLinesOfEdges_h
#define dmgLinesOfEdges_h

#include "Mesh/TriangleMesh.h"
#include "Places/SurfacePlace.h"

#include <utility>
#include <vector>

namespace dmg
{

/// Lines of edges of a surface, along which vertices of quads may move.
class LinesOfEdges
{
public:
  /// \param mesh is borrowed.
  /// \param isOnLine by edge.
  LinesOfEdges(const TriangleMesh& mesh, std::vector<char> isOnLine);

  bool Has(int edge) const { return this->IsOnLine[edge]; }
  bool Has(const SurfacePlace& place) const { return this->EdgeOf(place) >= 0; }
  /// Whether lines end, branch or bend at a vertex.
  bool IsCorner(int vertex) const;
  /// The place where walking along a line, from one of its places, comes no nearer to a position. A place stays if it is on no line, or if
  /// the walk comes to a corner or ends at a vertex, where other places might end, too.
  SurfacePlace From(const SurfacePlace& place, const Vector3& position) const;
  /// The edges of lines at a vertex, with their other ends.
  std::vector<std::pair<int, int>> EdgesAt(int vertex) const;

private:
  /// An edge on which a place is, -1 where there is none.
  int EdgeOf(const SurfacePlace& place) const;
  /// The part of the way along an edge, from one of its ends, where it is nearest to a position.
  double NearestPart(int edge, int from, const Vector3& position) const;

  const TriangleMesh& Mesh;
  const std::vector<char> IsOnLine;
};

}

#endif
