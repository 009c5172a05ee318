#ifndef dmgShortestPaths_h
#define dmgShortestPaths_h

#include "Geodesics/IntrinsicTriangulation.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// The shortest paths over a surface from one vertex.
struct ShortestPaths
{
  Vector<double> Lengths; ///< #V; infinite where no path leads
  /// The direction in which a path starts, in radians, as IntrinsicTriangulation::Direction at the vertex; any there and where no path leads.
  Vector<double> Directions;
};

/// Finds shortest paths as a wavefront that crosses one face after the other: the distances of two corners of a face place the source in
/// the plane of the face, and the third corner measures its distance from there (Novotni and Klein 2002). Exact where the surface is flat
/// and no hole or reentrant corner is on the way. A path that bends around one starts anew at a vertex, and distances count from there. On
/// curved surfaces and around holes errors are of the order of the edges; behind a sharp corner, times the logarithm of their number.
/// Paths from two sides that meet are told from one wavefront by their directions, which grow counter-clockwise along it.
/// Cost: O(#V log #V). Memory: some numbers per vertex.
/// \throw Cancelled
ShortestPaths FindShortestPaths(
  const IntrinsicTriangulation& surface, int from, const ExecutionContext& context = SerialContext());

}

#endif
