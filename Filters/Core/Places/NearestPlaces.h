#ifndef dmgNearestPlaces_h
#define dmgNearestPlaces_h

#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceSizes.h"
#include "Support/Types.h"

#include <functional>
#include <limits>
#include <memory>

namespace dmg
{

/// The place of a surface that is nearest to a point in space.
struct NearestPlace
{
  int Face = -1; ///< -1 where the square of the distance is too large for a number
  Vector3 Position = Vector3::Zero();
  double Distance = std::numeric_limits<double>::infinity();
};

/// The place of a face, also of one without area, that is nearest to a point.
NearestPlace ClosestOnFace(const TriangleMesh& mesh, int face, const Vector3& position);

/// Finds the nearest places of a surface, by a tree of bounding boxes. Several threads may ask at a time.
class NearestPlaces
{
public:
  /// \param surface is borrowed.
  /// Cost: n log n.
  explicit NearestPlaces(const FramedMesh& surface);
  /// \param sizes of the surface that this one is a part of.
  NearestPlaces(const FramedMesh& surface, const SurfaceSizes& sizes);
  ~NearestPlaces();

  /// \param near a face that is not far, which saves time, or -1.
  /// \return of places that are as near as each other, that of the face with the smallest number.
  /// \pre position is finite.
  /// Cost: logarithmic near the surface; elsewhere it grows with the number of faces in a ball around the point.
  NearestPlace operator()(const Vector3& position, int near = -1) const;

  /// The place where walking over the surface, from a face, comes no nearer. Cost: a few triangles for each step.
  /// \param last a face where such a walk ended, which saves its last step, or -1.
  NearestPlace From(int face, const Vector3& position, int last = -1) const;

  /// Calls visit(face) for all faces whose bounding boxes have a place within a distance of a position.
  void VisitNear(const Vector3& position, double distance, const std::function<void(int face)>& visit) const;

  const FramedMesh& Surface;
  const SurfaceSizes Sizes;

private:
  class Tree;
  const std::unique_ptr<const Tree> Boxes;
};

}

#endif
