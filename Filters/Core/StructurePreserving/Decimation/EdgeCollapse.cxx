#include "StructurePreserving/Decimation/EdgeCollapse.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

// Triangles below this quality may be made only where worse ones stood.
constexpr double ThinQuality = 0.1;

/// A triangle by its positions: twice its area vector, and 1 for equilateral to 0 for flat.
struct TriangleShape
{
  Vector3 AreaVector;
  double Quality;
};

TriangleShape ShapeOf(const std::vector<Vector3>& positions, const std::array<int, 3>& corners)
{
  const Vector3 a = positions[corners[1]] - positions[corners[0]];
  const Vector3 b = positions[corners[2]] - positions[corners[0]];
  const Vector3 areaVector = a.cross(b);
  const double sides = a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm();
  const double quality = sides > 0.0 ? 2.0 * std::sqrt(3.0) * areaVector.norm() / sides : 0.0;
  return { areaVector, quality };
}

}

std::optional<CollapsibleMesh::Afterwork> EdgeCollapse::Try(int halfedge, const CollapseLimits& limits)
{
  if (!GatherOneRing(this->Mesh, halfedge, this->LastRing) || this->LastRing.LoopSize() > limits.MaximumValence ||
    this->MakesAPoint() || !this->KeepsShape(limits))
  {
    return std::nullopt;
  }
  if (!this->Flattening.Flatten(this->LastRing, JointFlattening::Method::Conformal) &&
    !(limits.MayFlattenIntoCircle && this->Flattening.Flatten(this->LastRing, JointFlattening::Method::ConvexPolygon)))
  {
    return std::nullopt;
  }
  this->Tracking.Move(this->LastRing, this->Flattening.Plane(), *this->Worker);
  return this->Mesh.Collapse(this->LastRing);
}

// A collapse onto a boundary can bring a third corner to two that share their place, as where a
// boundary was drawn together into a point. No mesh may have such a face.
bool EdgeCollapse::MakesAPoint() const
{
  for (int k = 0; k < this->LastRing.NumberOfSectors(); ++k)
  {
    const std::array<int, 3> corners = this->LastRing.SectorAfter(k);
    const Vector3& hub = this->LastRing.Positions[corners[0]];
    if (this->LastRing.Positions[corners[1]] == hub && this->LastRing.Positions[corners[2]] == hub)
    {
      return true;
    }
  }
  return false;
}

bool EdgeCollapse::KeepsShape(const CollapseLimits& limits) const
{
  double worstBefore = 1.0;
  double worstAfter = 1.0;
  for (int k = 0; k < this->LastRing.NumberOfSectors(); ++k)
  {
    const TriangleShape before = ShapeOf(this->LastRing.Positions, this->LastRing.SectorBefore(k));
    const TriangleShape after = ShapeOf(this->LastRing.Positions, this->LastRing.SectorAfter(k));
    const double lengths = before.AreaVector.norm() * after.AreaVector.norm();
    // A face of zero area has no normal to keep.
    if (before.Quality > 0.0 && before.AreaVector.dot(after.AreaVector) < limits.LeastNormalCosine * lengths)
    {
      return false;
    }
    worstBefore = std::min(worstBefore, before.Quality);
    worstAfter = std::min(worstAfter, after.Quality);
  }
  return !limits.KeepShape || worstAfter >= std::min(ThinQuality, worstBefore);
}

}
