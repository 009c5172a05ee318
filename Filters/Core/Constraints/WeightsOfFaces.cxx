#include "Constraints/WeightsOfFaces.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// At weight 1, features are followed to within this part of the surface's size.
constexpr double RelativeLength = 1.0 / 30.0;

}

WeightsOfFaces::WeightsOfFaces(const TriangleMesh& mesh, const SurfaceSizes& sizes)
  : Areas(mesh.FaceAreas())
  , Mean(sizes.MeanFaceArea)
  , Length(RelativeLength * std::sqrt(sizes.Area))
{
}

double WeightsOfFaces::OfFace() const
{
  return 2.0 * this->Mean / (this->Length * this->Length);
}

double WeightsOfFaces::OfLine(int face, double length) const
{
  return 2.0 * length / this->Length * this->Mean / std::max(this->Areas[face], 1e-4 * this->Mean);
}

}
