#ifndef dmgWavefrontPaths_h
#define dmgWavefrontPaths_h

#include "Drawing/UnfoldedSurface.h"
#include "Geodesics/EdgePath.h"
#include "Geodesics/IntrinsicTriangulation.h"
#include "Geodesics/ShortestPaths.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/VertexConnection.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The way of the wavefront to a vertex, along edges beside it.
/// \pre a path leads there.
EdgePath EdgesBeside(const std::vector<ShortestPath>& paths, int target, const IntrinsicTriangulation& surface);

/// A vertex that a flipped triangulation has more than its surface.
struct VertexOfPath
{
  Vector3 Position;
  SurfacePoint At{ -1, 0.0 }; ///< in whose frame its directions are; no face where it is on an edge of the surface
};

/// The places where a path along edges of a flipped triangulation crosses the edges of its surface, from end to end.
/// \param added vertices of the triangulation, after those of the surface.
/// \param target where a path without edges stands.
/// Cost: O(#F).
std::vector<Vector3> TracePath(const EdgePath& path, int target, const IntrinsicTriangulation& flipped,
  const FramedMesh& surface, const VertexConnection& connection, const std::vector<VertexOfPath>& added);

}

#endif
