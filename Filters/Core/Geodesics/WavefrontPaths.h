#ifndef dmgWavefrontPaths_h
#define dmgWavefrontPaths_h

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

/// The places where a path along edges of a flipped triangulation crosses the edges of its surface, from end to end.
/// \param target where a path without edges stands.
/// Cost: O(#F).
std::vector<Vector3> TracePath(const EdgePath& path, int target, const IntrinsicTriangulation& flipped,
  const FramedMesh& surface, const VertexConnection& connection);

}

#endif
