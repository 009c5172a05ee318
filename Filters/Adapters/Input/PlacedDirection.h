#ifndef dmgPlacedDirection_h
#define dmgPlacedDirection_h

#include "Mesh/FramedMesh.h"

#include <optional>

namespace dmg
{

/// A vertex with a direction in its tangent plane.
struct PlacedDirection
{
  int Vertex;
  Vector3 Position; ///< of the vertex
  Vector3 Direction;
  bool IsGiven; ///< rather than any direction in the place of one that is perpendicular to the surface
};

/// A direction at the vertex that is nearest to a place, the first of several; without a place, at VertexInFront.
/// \throw InvalidInput the place is not finite; the direction is zero or not finite.
PlacedDirection PlaceDirection(
  const FramedMesh& surface, const std::optional<Vector3>& place, const Vector3& direction);

}

#endif
