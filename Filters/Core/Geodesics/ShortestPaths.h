#ifndef dmgShortestPaths_h
#define dmgShortestPaths_h

#include "Geodesics/IntrinsicTriangulation.h"
#include "Support/ExecutionContext.h"

#include <array>
#include <limits>
#include <vector>

namespace dmg
{

/// The shortest path from the nearest source to a vertex. Directions are in radians, as IntrinsicTriangulation::Direction.
struct ShortestPath
{
  double Length = std::numeric_limits<double>::infinity(); ///< infinite where no path leads
  double Arrival = 0.0;                                    ///< the direction in which it arrives; any at a source
  /// The direction in which it starts, at the source; any there, and where the source is a line.
  double Outset = 0.0;
  double Bend = 0.0; ///< its length up to the last vertex through which it leads; straight from there
  int Source = -1;   ///< the number of the source, -1 where no path leads
  /// The ends of the side that it crosses last, the one that is nearer to it first; twice the same vertex where it comes along an edge;
  /// -1 at a source.
  std::array<int, 2> Parents = { -1, -1 };
  /// The turn of a vector that is carried along it, from the frame of the vertex where it starts into that of this one; in radians.
  double Turn = 0.0;

  bool IsAny() const { return this->Source >= 0; }
  bool IsAtSource() const { return this->IsAny() && this->Parents[0] < 0; }
};

/// A vertex at distance 0.
struct PathStart
{
  int Vertex;
  int Source = 0; ///< a number that tells sources apart; >= 0
};

/// Finds shortest paths from several vertices and lines to all vertices, as a wavefront that crosses one face after the other. At each
/// vertex it carries its distance and the direction in which it passes. Along a side of a face the squared distance is then a cubic
/// polynomial, by Hermite's formula, and the third corner takes the least of the distance on the side and the straight way from there.
/// ParallelTransport.md has the formulas.
///
/// Held edges whose ends are both starts are lines at distance 0. Exact in a plane, on folded sheets, cylinders and cones, for vertices and
/// for straight lines, where no hole or reentrant corner is on the way; of second order on smooth surfaces. A path that
/// bends around a vertex starts anew there, and distances count from there.
/// Cost: O(#V log #V), but for the few vertices that a shorter path reaches late. Memory: some numbers per vertex.
/// \param starts of several at one vertex, the first counts.
/// \param maximumDistance the wavefront goes no farther; vertices beyond it have a longer path than that, which need not be the shortest, or
///   none.
/// \return #V.
/// \throw Cancelled
std::vector<ShortestPath> FindShortestPaths(const IntrinsicTriangulation& surface, const std::vector<PathStart>& starts,
  double maximumDistance = std::numeric_limits<double>::infinity(), const ExecutionContext& context = SerialContext());

/// The shortest path to a vertex that a triangulation has more than when all others were found: over one of the faces around it.
/// \param paths of all other vertices.
/// Cost: O(#F).
ShortestPath FindPathTo(int vertex, const IntrinsicTriangulation& surface, std::vector<ShortestPath> paths);

}

#endif
