#ifndef dmgPathsAlongEdges_h
#define dmgPathsAlongEdges_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <unordered_map>
#include <vector>

namespace dmg
{

/// Shortest paths along edges from one vertex, by Dijkstra's algorithm, to all vertices that are not far. They touch the boundary with
/// their ends alone.
class PathsAlongEdges
{
public:
  /// Cost: n log n, n the number of vertices within the distance.
  PathsAlongEdges(const TriangleMesh& mesh, int from, double distance);

  /// The vertices that were reached, from near to far.
  const std::vector<int>& Reached() const { return this->Vertices; }
  /// The ones among them that are no nearer than the distance.
  const std::vector<int>& Shell() const { return this->Farthest; }
  /// The halfedges of the path to a vertex, in any order; each leads away from the start.
  std::vector<int> To(int vertex) const;

private:
  const TriangleMesh& Mesh;
  std::vector<int> Vertices;
  std::vector<int> Farthest;
  std::unordered_map<int, int> Arrivals; ///< by vertex, the last halfedge of its path
};

/// Marks the faces all of whose corners are within a distance of a marked face, along edges.
/// \param distances by face: how far marks go from it.
void GrowMarks(const TriangleMesh& mesh, const Vector<double>& distances, std::vector<char>& isMarked);

}

#endif
