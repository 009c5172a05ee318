#ifndef dmgWeightsOfFaces_h
#define dmgWeightsOfFaces_h

#include "Mesh/SurfaceSizes.h"
#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

namespace dmg
{

/// Integrals over a surface, or along lines on it, as weights of its faces. They are relative to the size
/// L of the surface, the root of its area, so that what follows an integral means the same at any size and resolution; see
/// FeatureOptions. A discretisation multiplies the weight of a face by its area over the mean one.
class WeightsOfFaces
{
public:
  /// \param sizes of the surface that the mesh is, or is a part of.
  /// Cost: linear.
  WeightsOfFaces(const TriangleMesh& mesh, const SurfaceSizes& sizes);

  /// The integral of (30 / L)^2 over a face.
  double OfFace() const;
  /// The integral of 30 / L along a line on the face, if that is no sliver.
  double OfLine(int face, double length) const;
  bool IsFlat(int face) const { return this->Areas[face] == 0.0; }

private:
  const Vector<double> Areas;
  const double Mean;
  const double Length; ///< L / 30
};

}

#endif
