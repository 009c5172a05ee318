#ifndef dmgShapeOfSingularity_h
#define dmgShapeOfSingularity_h

#include "Mesh/FramedMesh.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// A singular vertex or face of a field of N directions.
struct SingularElement
{
  int Element;
  bool IsFace;
  double Index; ///< s, a multiple of 1 / N, not 0
};

/// The way a field stands around a singularity. In the tangent plane there, directions at the polar angle phi have the angle
/// s phi + theta, s the index.
struct ShapeOfSingularity
{
  /// The directions from the singularity, unit vectors, in which one of the field is radial: |N (1 - s)| of them, evenly spaced. A defect of
  /// +1/2 of a nematic has one, the tail of the comet (along the divergence of Q), and one of -1/2 has three.
  std::vector<Vector3> Axes;
  /// The angle from the radius to the field where the index is 1, in (-pi / N, pi / N], counter-clockwise: 0 an aster, pi / 2 a vortex, others
  /// spirals. NaN of other indices, and where no face around has a direction.
  double SpiralAngle;
};

/// The angle theta is the mean, as N-th powers, over the faces of two rings around the singularity, seen in its tangent plane.
/// \param first direction 0 of each face in its frame; 0 where there is none.
/// \return no axes where no face around has a direction.
ShapeOfSingularity ShapeAt(
  const FramedMesh& surface, const Vector<Complex>& first, int N, const SingularElement& singularity);

}

#endif
