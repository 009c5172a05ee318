#ifndef dmgFaceProjection_h
#define dmgFaceProjection_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"

namespace dmg
{

/// P_t of one face: row k is its k-th side in its frame, so that P_t x are the integrals of the
/// vector x along its three halfedges. They sum to zero. Thesis, section 3.3.
using FaceProjection = Eigen::Matrix<double, 3, 2>;
FaceProjection ProjectionOntoSides(const TriangleMesh& mesh, const TangentFrames& faceFrames, int face);

/// The pseudo-inverse P_t^+: the vector whose integrals along the sides are nearest to three given numbers; P_t^+ P_t = 1. It
/// filters out their mean, which no vector has (Q_I of the thesis, section 4.3). It is computed as the Whitney form of the three
/// numbers at the barycentre, whose rounding error grows with the slimness of the face rather than with its square.
///
/// A degenerate face, with an area below 1e-10 times the square of its longest side, has no second
/// direction: there P_t^+ is that of the sides' parts along the longest one, and stays finite.
Eigen::Matrix<double, 2, 3> PseudoInverse(const FaceProjection& P);

/// Whether the area is below 1e-10 times the square of the longest side.
bool IsDegenerate(const FaceProjection& P);

/// A quarter turn, counter-clockwise.
inline Vector2 QuarterTurn(const Vector2& v)
{
  return Vector2(-v[1], v[0]);
}

}

#endif
