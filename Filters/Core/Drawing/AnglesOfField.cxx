#include "Drawing/AnglesOfField.h"

#include <complex>
#include <limits>

namespace dmg
{

Vector<double> AnglesOfField(const TangentFrames& faceFrames, const DirectionsOnFaces& field, const Points& references,
  const SidesOfSurface& sides, const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  constexpr double SmallestTangentialPart = 1e-9;
  Vector<double> angles(references.rows());
  context.ParallelFor(0, static_cast<int>(angles.size()), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const Vector3 reference = references.row(face).transpose();
        const Complex tangential = faceFrames.ToComplex(face, reference);
        const bool isDefined =
          field.HasDirection(face) && std::abs(tangential) > SmallestTangentialPart * reference.stableNorm();
        const Complex nearest = field.Direction(face, field.Nearest(face, tangential));
        angles[face] = isDefined ? sides.OfFaces[face] * std::arg(nearest * std::conj(tangential))
                                 : std::numeric_limits<double>::quiet_NaN();
      }
    });
  return angles;
}

}
