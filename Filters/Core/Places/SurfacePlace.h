#ifndef dmgSurfacePlace_h
#define dmgSurfacePlace_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

namespace dmg
{

/// A place on a surface: a face and barycentric coordinates of its three corners, which are not negative and sum to 1.
struct SurfacePlace
{
  int Face = -1; ///< -1: none
  Vector3 Weights = Vector3::Zero();
};

inline Vector3 PositionOf(const TriangleMesh& mesh, const SurfacePlace& place)
{
  Vector3 position = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    position += place.Weights[k] * mesh.Position(mesh.Tail(3 * place.Face + k));
  }
  return position;
}

/// The tail of a halfedge.
inline SurfacePlace AtTail(int halfedge)
{
  return { TriangleMesh::FaceOf(halfedge), Vector3::Unit(halfedge % 3) };
}

/// The place at parameter t of a halfedge: its tail at t = 0, its head at t = 1.
inline SurfacePlace OnHalfedge(int halfedge, double t)
{
  return { TriangleMesh::FaceOf(halfedge),
    (1.0 - t) * Vector3::Unit(halfedge % 3) + t * Vector3::Unit((halfedge + 1) % 3) };
}

}

#endif
