#include "Flows/PeriodicSurfaces.h"

#include "Mesh/PositiveSide.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{
namespace
{

constexpr double Rounding = 1e-5; // of angles and relative lengths, in single precision

/// Longitudes about an axis.
class Longitudes
{
public:
  explicit Longitudes(const Vector3& axis)
    : Axis(axis.normalized())
    , First(axis.unitOrthogonal())
    , Second(Axis.cross(First))
  {
  }

  double Of(const Vector3& point) const { return std::atan2(this->Second.dot(point), this->First.dot(point)); }
  bool AreAtPole(const Vector3& point) const { return this->Axis.cross(point).norm() <= Rounding * point.norm(); }

private:
  const Vector3 Axis, First, Second;
};

double Between(double a, double b)
{
  return std::abs(std::remainder(a - b, 2.0 * Pi));
}

}

std::string WarningOfSlit(const TriangleMesh& mesh, const Vector3& axis)
{
  const Longitudes longitudes(axis);
  std::vector<double> meridians; // of the boundary
  double width = 0.0;            // of the cells there
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const Vector3 tail = mesh.Position(mesh.Tail(h)), head = mesh.Position(mesh.Head(h));
    const Vector3 opposite = mesh.Position(mesh.Tail(TriangleMesh::Previous(h)));
    if (mesh.Twin(h) >= 0 || longitudes.AreAtPole(tail) || longitudes.AreAtPole(head) ||
      Between(longitudes.Of(tail), longitudes.Of(head)) > Rounding)
    {
      continue;
    }
    const double here = longitudes.Of(tail);
    width = longitudes.AreAtPole(opposite) ? width : std::max(width, Between(here, longitudes.Of(opposite)));
    if (std::none_of(
          meridians.begin(), meridians.end(), [here](double each) { return Between(here, each) <= Rounding; }))
    {
      meridians.push_back(here);
    }
    if (meridians.size() > 2)
    {
      return "";
    }
  }
  constexpr double Widest = 1.5; // cells
  return meridians.size() == 2 && Between(meridians[0], meridians[1]) <= Widest * width
    ? "The grid ends one step short of a full circle, and the slit bars the flow; repeat the first meridian as the "
      "last one."
    : "";
}

std::string WarningOfFoldedBox(const TriangleMesh& mesh)
{
  constexpr double Long = 0.7, Short = 0.1; // of the box
  const Points& points = mesh.VertexPositions();
  if (!HaveConstantZ(points))
  {
    return "";
  }
  const Vector3 box = (points.colwise().maxCoeff() - points.colwise().minCoeff()).transpose();
  const auto isLong = [&](int face)
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const Vector3 side = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).cwiseAbs();
      for (const int axis : { 0, 1 })
      {
        if (side[axis] > Long * box[axis] && side[1 - axis] < Short * box[1 - axis] && box[axis] > 0.0)
        {
          return true;
        }
      }
    }
    return false;
  };
  int number = 0;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    number += isLong(face) ? 1 : 0;
  }
  const bool isFolded = number > 0 && number < Long * mesh.NumberOfFaces() && mesh.EulerCharacteristic() <= 0;
  return isFolded ? std::to_string(number) +
      " triangles are as long as the surface, as where a periodic box is folded; the flow is not periodic. Take them "
      "away."
                  : "";
}

}
