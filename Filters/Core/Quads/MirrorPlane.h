#ifndef dmgMirrorPlane_h
#define dmgMirrorPlane_h

#include "Mesh/FramedMesh.h"
#include "Places/NearestPlaces.h"
#include "Support/Types.h"

namespace dmg
{

/// A plane that a surface may be its own mirror image about.
struct MirrorPlane
{
  Vector3 Origin = Vector3::Zero();
  Vector3 Normal = Vector3::UnitX(); ///< of length 1; quads are made of the half that it points to

  double DistanceOf(const Vector3& position) const { return this->Normal.dot(position - this->Origin); }
  Vector3 Mirrored(const Vector3& position) const { return position - 2.0 * this->DistanceOf(position) * this->Normal; }
};

/// A surface that is off its mirror image by a larger part of the diagonal of its box is not symmetric.
constexpr double LargestAsymmetry = 0.02;

/// The largest distance of the mirrored vertices from the surface, relative to the diagonal of the box around it.
/// \param places of the surface. Cost: a search for each of at most 5,000 vertices, which are spread over their numbers.
double AsymmetryOf(const NearestPlaces& places, const MirrorPlane& plane);

/// The plane about which a surface is closest to its mirror image. Planes through its centroid that are normal to a principal axis
/// or a coordinate axis are improved by closest points, as long as that helps. A normal that is a coordinate axis but for rounding is made one.
MirrorPlane FindMirrorPlane(const NearestPlaces& places);

}

#endif
