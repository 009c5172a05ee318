#include "Discretisations/Prescriptions.h"

#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace dmg
{

namespace
{

/// A direction leaning less than this (as a sine) out of the normal has no part in the plane.
constexpr double SmallestTangentialPart = 1e-6;

void CheckWeight(const std::string& name, double weight)
{
  if (!(weight >= SmallestWeight && weight <= LargestWeight))
  {
    throw InvalidInput(name + " is " + ShortText(weight) + "; make it positive, from 1e-20 to 1e20");
  }
}

/// What several directions of a face leave of each other is due to rounding below this, relative to them.
constexpr double SmallestMean = 1e-6;

/// The numbers of directions by face, those on one face in their order.
std::vector<int> ByFace(const std::vector<PrescribedDirection>& directions)
{
  std::vector<int> order(directions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&directions](int a, int b) { return directions[a].Face < directions[b].Face; });
  return order;
}

/// The N-th power of a direction, as long as that.
Complex PowerOf(const Complex& direction, int N)
{
  return std::polar(std::abs(direction), N * std::arg(direction));
}

/// How the names of elements are asked for.
using Naming = std::string (ElementNames::*)(int) const;

/// The largest of some numbers, and whose it is.
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
        ShortText(this->Number) + ", too large to compute with; bring it to at most " + ShortText(to) +
        ", with Calculator (vtkArrayCalculator) for example");
    }
    if (this->Number > 0.0 && this->Number < from)
    {
      throw InvalidInput("the largest " + what + " of all, on " + (names.*this->Name)(this->Element) + ", is " +
        ShortText(this->Number) + ", too small to compute with; multiply all of them, so that it is at least " +
        ShortText(from) + ", with Calculator (vtkArrayCalculator) for example");
    }
  }
};

}

void CheckWeights(const FieldWeights& weights)
{
  CheckWeight("Smoothness", weights.Smoothness);
  CheckWeight("Alignment", weights.Alignment);
}

void CheckSizes(const PrescribedDirections& directions, const ElementNames& names)
{
  Largest length, value, weight;
  for (const PrescribedDirection& prescribed : directions.OnFaces)
  {
    length.Add(prescribed.Direction.stableNorm(), &ElementNames::Face, prescribed.Face);
    weight.Add(prescribed.Weight, &ElementNames::Face, prescribed.Face);
  }
  for (const PrescribedVertexDirection& prescribed : directions.AtVertices)
  {
    length.Add(prescribed.Direction.stableNorm(), &ElementNames::Vertex, prescribed.Vertex);
    weight.Add(prescribed.Weight, &ElementNames::Vertex, prescribed.Vertex);
  }
  for (const PrescribedValue& prescribed : directions.Values)
  {
    value.Add(std::abs(prescribed.Value), &ElementNames::Vertex, prescribed.Vertex);
    weight.Add(prescribed.Weight, &ElementNames::Vertex, prescribed.Vertex);
  }
  length.Check("length of the directions", SmallestPrescribed, LargestPrescribed, names);
  value.Check("value", SmallestPrescribed, LargestPrescribed, names);
  weight.Check("weight", SmallestWeight, LargestWeight, names);
}

void CheckPrescribedElement(int element, int size, const std::string& kind)
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
  const std::string orLeaveOut =
    ", or leave the " + kind + " out, by Mask or a direction of zero where there is no mask";
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

std::vector<CarriedDirection> CarriedIntoFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const PrescribedVertexDirection& prescribed, const ElementNames& names)
{
  const auto& [vertex, inSpace, weight] = prescribed;
  CheckPrescribedElement(vertex, mesh.NumberOfVertices(), "vertex");
  const Complex direction = TangentialPart(vertexFrames, vertex, inSpace, weight, names.Vertex(vertex), "point");
  std::vector<CarriedDirection> carried;
  mesh.VisitFan(prescribed.Vertex,
    [&](int halfedge)
    {
      const int face = TriangleMesh::FaceOf(halfedge);
      const Complex turn = TransportTurn(vertexFrames, prescribed.Vertex, faceFrames, face);
      carried.push_back({ halfedge, faceFrames.ToVector(face, turn * direction) });
    });
  return carried;
}

std::vector<PrescribedDirection> DirectionsOnFaces(
  const FramedMesh& surface, const PrescribedDirections& directions, const ElementNames& names)
{
  std::vector<PrescribedDirection> onFaces = directions.OnFaces;
  for (const PrescribedVertexDirection& prescribed : directions.AtVertices)
  {
    for (const auto& [halfedge, direction] :
      CarriedIntoFaces(surface.Mesh, surface.Faces, surface.Vertices, prescribed, names))
    {
      onFaces.push_back({ TriangleMesh::FaceOf(halfedge), direction, prescribed.Weight });
    }
  }
  return onFaces;
}

std::vector<int> LeaveOutCancelling(
  std::vector<PrescribedDirection>& directions, const TangentFrames& faceFrames, int N)
{
  const std::vector<int> order = ByFace(directions);
  std::vector<int> faces;
  std::vector<char> isLeftOut(directions.size(), 0);
  for (auto first = order.begin(); first != order.end();)
  {
    const int face = directions[*first].Face;
    const auto last = std::find_if(first, order.end(), [&](int i) { return directions[i].Face != face; });
    Complex sum = 0.0;
    double lengths = 0.0;
    for (auto i = first; last - first > 1 && i != last; ++i)
    {
      const Complex v = faceFrames.ToComplex(face, directions[*i].Direction);
      sum += directions[*i].Weight * PowerOf(v, N);
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

PowerConstraints MakePowerConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const std::vector<PrescribedDirection>& directions, const ElementNames& names)
{
  PowerConstraints constraints;
  PrescribedFaces& prescribed = constraints.Prescribed;
  std::vector<Complex> sums;
  for (int i : ByFace(directions))
  {
    const auto& [face, direction, weight] = directions[i];
    CheckPrescribedElement(face, mesh.NumberOfFaces(), "face");
    const Complex v = TangentialPart(faceFrames, face, direction, weight, names.Face(face), "cell");
    if (prescribed.Faces.empty() || prescribed.Faces.back() != directions[i].Face)
    {
      prescribed.Faces.push_back(directions[i].Face);
      prescribed.Weights.push_back(0.0);
      sums.emplace_back(0.0);
    }
    prescribed.Weights.back() += directions[i].Weight;
    sums.back() += directions[i].Weight * PowerOf(v, N);
  }

  constraints.Values.resize(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
  {
    constraints.Values[b] = sums[b] / prescribed.Weights[b];
  }
  return constraints;
}

}
