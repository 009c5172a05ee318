#include "Mesh/FaceProjection.h"

namespace dmg
{

namespace
{

/// The limit of the frames: below it, the second direction of a face is rounding noise.
constexpr double DegenerateArea = 1e-10;

double Area(const FaceProjection& P)
{
  return 0.5 * (P(0, 0) * P(1, 1) - P(0, 1) * P(1, 0));
}

}

FaceProjection ProjectionOntoSides(const TriangleMesh& mesh, const TangentFrames& faceFrames, int face)
{
  FaceProjection P;
  for (int k = 0; k < 3; ++k)
  {
    const int h = 3 * face + k;
    const Vector3 side = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    const Complex inFrame = faceFrames.ToComplex(face, side);
    P.row(k) << inFrame.real(), inFrame.imag();
  }
  return P;
}

bool IsDegenerate(const FaceProjection& P)
{
  return !(Area(P) > DegenerateArea * P.rowwise().squaredNorm().maxCoeff());
}

Eigen::Matrix<double, 2, 3> PseudoInverse(const FaceProjection& P)
{
  if (!IsDegenerate(P))
  {
    Eigen::Matrix<double, 2, 3> inverse;
    for (int k = 0; k < 3; ++k)
    {
      const Vector2 difference = (P.row((k + 2) % 3) - P.row((k + 1) % 3)).transpose();
      inverse.col(k) = QuarterTurn(difference) / (6.0 * Area(P));
    }
    return inverse;
  }
  int longest;
  P.rowwise().squaredNorm().maxCoeff(&longest);
  const Vector2 direction = P.row(longest).transpose().normalized();
  const Vector3 lengths = P * direction;
  return direction * lengths.transpose() / lengths.squaredNorm();
}

}
