#ifndef dmgCrossField_h
#define dmgCrossField_h

#include "Directions/PowerFieldDirections.h"
#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The sides and corners of a surface, as all that follows a field across edges needs them.
struct SurfaceAngles
{
  Unfilled<Complex> Sides; ///< SideDirections
  Unfilled<Corner> Corners;

  SurfaceAngles(const FramedMesh& surface, const ExecutionContext& context);
};

/// Four directions on each face, a quarter turn apart, and how they go on across edges.
struct CrossField
{
  Vector<double> Angles;      ///< of direction 0 of each face in its frame
  PrincipalMatching Matching; ///< which direction goes on as which one
  /// Four times the index of the singularity at each vertex, 0 on the boundary. It is the sum of the rotations around the vertex: the
  /// matchings alone do not tell an index of 1 from that of a regular vertex.
  std::vector<int> Indices;
};

/// \param powers the fourth powers of the directions, one per face in its frame; their lengths do not matter. A face with a power of
///   0 takes its first axis as direction 0.
/// Cost: O(#F).
CrossField MatchCrosses(const FramedMesh& surface, const SurfaceAngles& angles, const Vector<Complex>& powers,
  const ExecutionContext& context);

/// Splits each singularity of an index of 1/2 or more into as many of 1/4 as that makes, which stand around it. Poles of surfaces of
/// revolution have an index of 1, and a map has no place for it: all four isolines of a vertex would go around the pole.
///
/// The matching changes by one along the edges of a path from the vertex to each new singularity. The least rotation that agrees with
/// the new matchings is then found near the vertex, as one angle per face.
/// \param distance from a vertex to its new singularities.
/// \return the number of vertices that were split. A vertex stays as it is where fewer regular vertices are near than it needs.
int SplitSingularities(const FramedMesh& surface, const SurfaceAngles& angles, double distance, CrossField& field);

}

#endif
