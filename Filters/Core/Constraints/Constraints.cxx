#include "Constraints/Constraints.h"

#include "Mesh/NormalParts.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace dmg
{

namespace
{

/// The sine of the angle to the normal below which a direction has no part in the plane.
constexpr double SmallestTangentialPart = 1e-6;

/// The length of a mean of directions, relative to them, below which it is rounding noise.
constexpr double SmallestMean = 1e-6;

/// A method that names elements.
using Naming = std::string (ElementNames::*)(int) const;

/// The largest of some numbers, and its element.
struct Largest
{
  double Number = 0.0;
  Naming Name = nullptr;
  int Element = -1;

  void Add(double number, Naming name, int element)
  {
    if (number > this->Number)
    {
      *this = { number, name, element };
    }
  }

  void Check(const std::string& what, double from, double to, const ElementNames& names) const
  {
    if (this->Number > to)
    {
      throw InvalidInput("the " + what + " prescribed on " + (names.*this->Name)(this->Element) + " is " +
        ShortText(this->Number) + ", too large to compute with; bring it to at most " + ShortText(to) + ", " +
        TextOf(Remedy::Rescale));
    }
    if (this->Number > 0.0 && this->Number < from)
    {
      throw InvalidInput("the largest " + what + " of all, on " + (names.*this->Name)(this->Element) + ", is " +
        ShortText(this->Number) + ", too small to compute with; multiply all of them, so that it is at least " +
        ShortText(from) + ", " + TextOf(Remedy::Rescale));
    }
  }
};

}

void CheckSizes(const Constraints& constraints, const ElementNames& names)
{
  Largest length, value, weight;
  for (const Constraint& on : constraints.OnFaces)
  {
    length.Add(on.Direction.stableNorm(), &ElementNames::Face, on.Element);
    weight.Add(on.Weight, &ElementNames::Face, on.Element);
  }
  for (const Constraint& at : constraints.AtVertices)
  {
    length.Add(at.Direction.stableNorm(), &ElementNames::Vertex, at.Element);
    weight.Add(at.Weight, &ElementNames::Vertex, at.Element);
  }
  for (const ValueConstraint& of : constraints.Values)
  {
    value.Add(std::abs(of.Value), &ElementNames::Vertex, of.Vertex);
    weight.Add(of.Weight, &ElementNames::Vertex, of.Vertex);
  }
  length.Check("length of the directions", SmallestPrescribed, LargestPrescribed, names);
  value.Check("value", SmallestPrescribed, LargestPrescribed, names);
  weight.Check("weight", SmallestWeight, LargestWeight, names);
}

void CheckElement(int element, int size, const std::string& kind)
{
  if (element < 0 || element >= size)
  {
    throw InvalidInput("a direction is prescribed on " + kind + " " + std::to_string(element) + ", but there are " +
      std::to_string(size) + "; leave it out");
  }
}

Complex TangentialPart(const TangentFrames& frames, int element, const Vector3& direction, double weight,
  const std::string& name, const std::string& kind)
{
  const std::string where = " prescribed on " + name;
  const std::string orLeaveOut = ", or leave the " + kind + " out, " + TextOf(Remedy::Mask);
  if (!direction.allFinite())
  {
    throw InvalidInput("the direction" + where + " is not finite; repair it" + orLeaveOut);
  }
  if (!(weight > 0.0) || !std::isfinite(weight))
  {
    throw InvalidInput("the weight of the direction" + where + " is " + ShortText(weight) +
      "; make it positive and finite" + orLeaveOut);
  }
  const Complex tangential = frames.ToComplex(element, direction);
  if (!(std::abs(tangential) > SmallestTangentialPart * direction.stableNorm()))
  {
    throw InvalidInput("the direction" + where +
      (!direction.isZero(0.0) ? " is perpendicular to the surface" : " is zero") +
      "; give it a part along the surface" + orLeaveOut);
  }
  return tangential;
}

namespace
{

/// Keeps the usable constraints of one list.
/// \param alongSurface (element, direction) the length of its part there.
template <class AlongSurface>
void KeepUsable(std::vector<Constraint>& constraints, const AlongSurface& alongSurface, UnusableDirections& unusable)
{
  const auto isUnusable = [&](const Constraint& constraint)
  {
    const Vector3& direction = constraint.Direction;
    if (!direction.allFinite())
    {
      ++unusable.NotFinite;
      return true;
    }
    if (direction.isZero(0.0))
    {
      ++unusable.Zero;
      return true;
    }
    const bool isPerpendicular =
      !(alongSurface(constraint.Element, direction) > SmallestTangentialPart * direction.stableNorm());
    unusable.Perpendicular += isPerpendicular ? 1 : 0;
    return isPerpendicular;
  };
  constraints.erase(std::remove_if(constraints.begin(), constraints.end(), isUnusable), constraints.end());
}

}

UnusableDirections LeaveOutUnusable(Constraints& constraints, const FramedMesh& surface)
{
  UnusableDirections unusable;
  const auto onFace = [&surface](int face, const Vector3& direction)
  { return std::abs(surface.Faces.ToComplex(face, direction)); };
  const auto atVertex = [&surface](int vertex, const Vector3& direction)
  { return std::abs(surface.Vertices.ToComplex(vertex, WithoutNormalPart(surface.Mesh, vertex, direction))); };
  KeepUsable(constraints.OnFaces, onFace, unusable);
  KeepUsable(constraints.AtVertices, atVertex, unusable);
  return unusable;
}

bool IsSymmetric(const Eigen::Matrix3d& tensor)
{
  constexpr double Rounding = 1e-5;
  return (tensor - tensor.transpose()).cwiseAbs().maxCoeff() <= Rounding * tensor.cwiseAbs().maxCoeff();
}

Vector3 PrincipalDirection(const Eigen::Matrix3d& tensor, const TangentFrames& frames, int element)
{
  constexpr double SmallestDifference = 1e-9;
  const double size = tensor.cwiseAbs().maxCoeff();
  if (!std::isfinite(size) || size == 0.0)
  {
    return Vector3::Zero();
  }
  const Eigen::Matrix3d scaled = tensor / size; // squares would overflow
  const Vector3 x = frames.X.row(element), y = frames.Y.row(element);
  const double difference = x.dot(scaled * x) - y.dot(scaled * y);
  const double twiceMixed = x.dot(scaled * y) + y.dot(scaled * x);
  if (std::hypot(difference, twiceMixed) <= SmallestDifference)
  {
    return Vector3::Zero();
  }
  return frames.ToVector(element, std::polar(1.0, 0.5 * std::atan2(twiceMixed, difference)));
}

double DifferenceOfPrincipalValues(const Eigen::Matrix3d& tensor, const TangentFrames& frames, int element)
{
  const Vector3 x = frames.X.row(element), y = frames.Y.row(element);
  return std::hypot(x.dot(tensor * x) - y.dot(tensor * y), x.dot(tensor * y) + y.dot(tensor * x));
}

std::array<double, 2> PrincipalValues(const Eigen::Matrix3d& tensor, const TangentFrames& frames, int element)
{
  const Vector3 x = frames.X.row(element), y = frames.Y.row(element);
  const double mean = 0.5 * x.dot(tensor * x) + 0.5 * y.dot(tensor * y);
  const double half = 0.5 * DifferenceOfPrincipalValues(tensor, frames, element);
  return { mean + half, mean - half };
}

Complex PowerOfDirection(const Complex& direction, int N)
{
  return std::polar(std::abs(direction), N * std::arg(direction));
}

std::vector<int> ByElement(const std::vector<Constraint>& constraints)
{
  std::vector<int> order(constraints.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return constraints[a].Element < constraints[b].Element; });
  return order;
}

std::vector<int> LeaveOutCancelling(std::vector<Constraint>& directions, const TangentFrames& faceFrames, int N)
{
  const std::vector<int> order = ByElement(directions);
  std::vector<int> faces;
  std::vector<char> isLeftOut(directions.size(), 0);
  for (auto first = order.begin(); first != order.end();)
  {
    const int face = directions[*first].Element;
    const auto last = std::find_if(first, order.end(), [&](int i) { return directions[i].Element != face; });
    Complex sum = 0.0;
    double lengths = 0.0;
    for (auto i = first; last - first > 1 && i != last; ++i)
    {
      const Complex v = faceFrames.ToComplex(face, directions[*i].Direction);
      sum += directions[*i].Weight * PowerOfDirection(v, N);
      lengths += directions[*i].Weight * std::abs(v);
    }
    if (std::abs(sum) < SmallestMean * lengths)
    {
      faces.push_back(face);
      std::for_each(first, last, [&isLeftOut](int i) { isLeftOut[i] = 1; });
    }
    first = last;
  }
  if (!faces.empty())
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      if (!isLeftOut[i])
      {
        directions[kept++] = directions[i];
      }
    }
    directions.resize(kept);
  }
  return faces;
}

Vector3 Turned(const Vector3& direction, const TangentFrames& frames, int element, double angle)
{
  return angle == 0.0 ? direction : Vector3(Eigen::AngleAxisd(angle, frames.Normal(element)) * direction);
}

void RefuseRotation(const std::string& element)
{
  throw InvalidInput("the rotation at " + element +
    " is not finite, and a direction is prescribed there; repair it, or leave the direction out");
}

void Turn(Constraints& constraints, const FramedMesh& surface, const RotationAngles& angles, const ElementNames& names)
{
  for (Constraint& on : constraints.OnFaces)
  {
    CheckElement(on.Element, surface.Mesh.NumberOfFaces(), "face");
    const double angle = angles.Everywhere + (angles.Faces.size() > 0 ? angles.Faces[on.Element] : 0.0);
    if (!std::isfinite(angle))
    {
      RefuseRotation(names.Face(on.Element));
    }
    on.Direction = Turned(on.Direction, surface.Faces, on.Element, angle);
  }
  for (Constraint& at : constraints.AtVertices)
  {
    CheckElement(at.Element, surface.Mesh.NumberOfVertices(), "vertex");
    const double angle = angles.Everywhere + (angles.Vertices.size() > 0 ? angles.Vertices[at.Element] : 0.0);
    if (!std::isfinite(angle))
    {
      RefuseRotation(names.Vertex(at.Element));
    }
    at.Direction = Turned(at.Direction, surface.Vertices, at.Element, angle);
  }
}

}
