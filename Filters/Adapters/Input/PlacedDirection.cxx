#include "Adapters/Input/PlacedDirection.h"

#include "Geodesics/VertexInFront.h"
#include "Support/Errors.h"

#include <cmath>

namespace dmg
{

namespace
{

/// The first of several.
int NearestVertex(const TriangleMesh& mesh, const Vector3& place)
{
  if (!place.allFinite())
  {
    throw InvalidInput("Point is not finite; give three numbers");
  }
  int nearest = 0;
  (mesh.VertexPositions().rowwise() - place.transpose()).rowwise().stableNorm().minCoeff(&nearest);
  return nearest;
}

}

PlacedDirection PlaceDirection(const FramedMesh& surface, const std::optional<Vector3>& place, const Vector3& direction)
{
  const double length = direction.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length))
  {
    throw InvalidInput("Direction is zero or not finite; give a vector along the surface");
  }
  constexpr double SmallestTangentialPart = 1e-6;
  const TriangleMesh& mesh = surface.Mesh;
  const int vertex = place ? NearestVertex(mesh, *place) : VertexInFront(mesh);
  PlacedDirection placed{ vertex, mesh.VertexPositions().row(vertex), direction, true };
  const TangentFrames& frames = surface.Vertices;
  if (std::abs(frames.ToComplex(placed.Vertex, direction)) <= SmallestTangentialPart * length)
  {
    placed.Direction = length * frames.X.row(placed.Vertex).transpose();
    placed.IsGiven = false;
  }
  return placed;
}

}
