#ifndef dmgEdgeDistances_h
#define dmgEdgeDistances_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <limits>
#include <vector>

namespace dmg
{

/// The lengths of the shortest paths along edges, by Dijkstra's algorithm: upper bounds of the distances over the surface.
/// \param from vertices at distance 0, at least one.
/// \return #V, of each vertex the distance to the nearest of them; infinite beyond the maximum, and on components without one.
/// Cost: O(n log n), n the number of vertices within the maximum.
Vector<double> DistancesAlongEdges(
  const TriangleMesh& mesh, const std::vector<int>& from, double maximum = std::numeric_limits<double>::infinity());

/// The least of a start and the path from there, for each vertex: the largest function that is at most the starts and whose slope along edges is at most 1.
/// \param starts #V, infinite where no path starts.
Vector<double> DistancesAlongEdges(
  const TriangleMesh& mesh, Vector<double> starts, double maximum = std::numeric_limits<double>::infinity());

/// \param distances #V.
/// \param components #V, the number of the connected component of each vertex, from 0 on.
/// \return for each component, the vertex of the largest distance, the first of several.
std::vector<int> FarthestVertices(const Vector<double>& distances, const std::vector<int>& components);

/// The diameter of each component along edges: the distance between two vertices, of which each is the farthest from the one before.
/// It is at least half of the longest distance along edges.
/// \param components #V, the number of the connected component of each vertex, from 0 on.
/// Cost: O(#V log #V).
std::vector<double> ComponentDiameters(const TriangleMesh& mesh, const std::vector<int>& components);

}

#endif
