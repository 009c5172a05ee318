#ifndef dmgJoinedTriangles_h
#define dmgJoinedTriangles_h

#include "Pieces/Surface/ValuesOfOwners.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Triangles of several pieces as a mesh has them, with one fan around each vertex.
struct JoinedTriangles
{
  Points Positions;
  Triangles Corners;
  std::vector<PlaceOnRank>
    Labels; ///< of vertices, ascending; several of one label where some of its triangles are not here
};

/// \param labels of the corners of triangles, three each: the same where they are one vertex of the whole surface.
/// \param positions of these corners.
JoinedTriangles Join(
  const std::vector<PlaceOnRank>& labels, const std::vector<Vector3>& positions, const ExecutionContext& context);

}

#endif
