#include "Mesh/PositiveSide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace dmg
{
namespace
{

/// Whether a range is zero up to rounding in coordinates of single precision.
constexpr double Rounding = 1e-6;

/// The measures of a component by which its side is found.
struct Component
{
  Vector3 Smallest = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 Largest = -Smallest;
  double SmallestRadius = std::numeric_limits<double>::infinity(); ///< distance from the origin
  double LargestRadius = 0.0;
  bool IsClosed = true;
  Vector3 Origin = Vector3::Zero();     ///< one of its points, from which volumes count
  double Volume = 0.0;                  ///< six times that inside, positive if cells are counter-clockwise from outside
  double Upwards = 0.0;                 ///< twice the area, projected along z
  double Outwards = 0.0;                ///< the same, along the directions from the origin
  double Area = 0.0;                    ///< twice the area
  Vector3 AreaVector = Vector3::Zero(); ///< the sum of those of its faces
  Vector3 Moment =
    Vector3::Zero(); ///< the sum of the places of its faces from the origin above, times twice their areas

  void Add(const Vector3& point)
  {
    this->Smallest = this->Smallest.cwiseMin(point);
    this->Largest = this->Largest.cwiseMax(point);
    this->SmallestRadius = std::min(this->SmallestRadius, point.norm());
    this->LargestRadius = std::max(this->LargestRadius, point.norm());
  }

  double Diagonal() const { return (this->Largest - this->Smallest).norm(); }

  bool HasConstantZ() const
  {
    return this->Largest.z() - this->Smallest.z() <= Rounding * (this->Diagonal() + std::abs(this->Largest.z()));
  }

  /// A plane that is seen from the origin differs in its distances by an eighth of the squared diagonal over the radius.
  bool IsOnGlobe() const
  {
    constexpr double LargestDifference = 0.01;
    const double radius = this->LargestRadius;
    const double bulge = this->Diagonal() * this->Diagonal() / std::max(radius, std::numeric_limits<double>::min());
    return this->LargestRadius - this->SmallestRadius <= LargestDifference * std::min(radius, bulge);
  }

  /// Six times the volume between the component and its centre of mass.
  double VolumeFromCentre() const
  {
    return this->Volume - this->AreaVector.dot(this->Moment) / std::max(this->Area, std::numeric_limits<double>::min());
  }

  /// \return the kind of its side, and whether cells are counter-clockwise, seen from it.
  std::pair<PositiveSide, bool> Side(bool isGlobe) const
  {
    constexpr double SmallestShare = 1e-9;
    const double size = this->Diagonal();
    if (this->IsClosed && std::abs(this->Volume) > SmallestShare * this->Area * size)
    {
      return { PositiveSide::Outside, this->Volume > 0.0 };
    }
    if (this->HasConstantZ() && std::abs(this->Upwards) > SmallestShare * this->Area)
    {
      return { PositiveSide::Up, this->Upwards > 0.0 };
    }
    if ((isGlobe || this->IsOnGlobe()) && std::abs(this->Outwards) > SmallestShare * this->Area)
    {
      return { PositiveSide::AwayFromOrigin, this->Outwards > 0.0 };
    }
    constexpr double SmallestBulge = 0.05; // a tube of 20 times its radius has as much
    if (const double volume = this->VolumeFromCentre(); std::abs(volume) > SmallestBulge * this->Area * size)
    {
      return { PositiveSide::Convex, volume > 0.0 };
    }
    return { PositiveSide::OfCells, true };
  }
};

std::vector<Component> Measure(const TriangleMesh& mesh, const std::vector<int>& componentOf)
{
  const int number = componentOf.empty() ? 0 : 1 + *std::max_element(componentOf.begin(), componentOf.end());
  std::vector<Component> components(number);
  for (int face = mesh.NumberOfFaces() - 1; face >= 0; --face)
  {
    components[componentOf[face]].Origin = mesh.Position(mesh.Tail(3 * face));
  }
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    Component& of = components[componentOf[face]];
    Vector3 centre = Vector3::Zero();
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      of.Add(mesh.Position(mesh.Tail(h)));
      of.IsClosed = of.IsClosed && mesh.Twin(h) >= 0;
      centre += mesh.Position(mesh.Tail(h)) / 3.0;
    }
    const Vector3 area = mesh.FaceAreaVector(face);
    of.Volume += area.dot(centre - of.Origin);
    of.Upwards += area.z();
    of.Outwards += area.dot(centre.stableNormalized());
    of.Area += area.norm();
    of.AreaVector += area;
    of.Moment += area.norm() * (centre - of.Origin);
  }
  return components;
}

/// Whether a component lies in the box of one of others, which are larger.
bool IsInside(const Component& component, const std::vector<const Component*>& others)
{
  return std::any_of(others.begin(), others.end(),
    [&component](const Component* other)
    {
      return (other->Smallest.array() < component.Smallest.array()).all() &&
        (component.Largest.array() < other->Largest.array()).all();
    });
}

/// The sides of components. A closed one is a cavity where its volume has another sign than the sum of all, and it lies in the box of one that
/// has the sign of the sum: then the outside is that of the solid.
std::vector<std::pair<PositiveSide, bool>> SidesOf(const std::vector<Component>& components, bool isGlobe)
{
  double volume = 0.0;
  for (const Component& component : components)
  {
    volume += component.IsClosed ? component.Volume : 0.0;
  }
  std::vector<const Component*> solids;
  std::vector<std::pair<PositiveSide, bool>> sides;
  for (const Component& component : components)
  {
    sides.push_back(component.Side(isGlobe));
    if (sides.back() == std::make_pair(PositiveSide::Outside, volume > 0.0))
    {
      solids.push_back(&component);
    }
  }
  std::sort(solids.begin(), solids.end(),
    [](const Component* one, const Component* other) { return one->Diagonal() > other->Diagonal(); });
  for (std::size_t i = 0; i < components.size(); ++i)
  {
    auto& [kind, isCounterClockwise] = sides[i];
    if (kind == PositiveSide::Outside && isCounterClockwise != (volume > 0.0) && IsInside(components[i], solids))
    {
      isCounterClockwise = !isCounterClockwise;
    }
  }
  return sides;
}

}

std::string TextOf(const std::vector<PositiveSide>& kinds)
{
  constexpr std::array<const char*, 5> Texts{ "the outside", "the side away from the origin", "+z", "the convex side",
    "the side from which the corners of its cells are counter-clockwise" };
  std::string text;
  for (const PositiveSide side : kinds)
  {
    text += (text.empty() ? "" : ", ") + std::string(Texts[static_cast<int>(side)]);
  }
  return text;
}

bool HaveConstantZ(const Points& points)
{
  Component all;
  for (int point = 0; point < points.rows(); ++point)
  {
    all.Add(points.row(point).transpose());
  }
  return all.HasConstantZ();
}

SidesOfSurface FindSides(const TriangleMesh& mesh, bool isGlobe)
{
  const std::vector<int> componentOf = FaceComponents(mesh);
  std::vector<double> signs; // of components
  SidesOfSurface sides;
  for (const auto& [kind, isCounterClockwise] : SidesOf(Measure(mesh, componentOf), isGlobe))
  {
    sides.Kinds.push_back(kind);
    signs.push_back(isCounterClockwise ? 1.0 : -1.0);
  }
  std::sort(sides.Kinds.begin(), sides.Kinds.end());
  sides.Kinds.erase(std::unique(sides.Kinds.begin(), sides.Kinds.end()), sides.Kinds.end());
  sides.OfFaces.resize(mesh.NumberOfFaces());
  sides.OfVertices.setOnes(mesh.NumberOfVertices());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    sides.OfFaces[face] = signs[componentOf[face]];
    for (int corner = 0; corner < 3; ++corner)
    {
      sides.OfVertices[mesh.FaceCorners()(face, corner)] = sides.OfFaces[face];
    }
  }
  return sides;
}

}
