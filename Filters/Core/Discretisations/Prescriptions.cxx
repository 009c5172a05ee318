#include "Discretisations/Prescriptions.h"

#include "Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>

namespace dmg
{

namespace
{

/// A direction leaning less than this (as a sine) out of the normal has no part in the plane.
constexpr double SmallestTangentialPart = 1e-6;

std::string InShort(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

void CheckWeight(const std::string& name, double weight)
{
  if (!(weight >= SmallestWeight && weight <= LargestWeight))
  {
    throw InvalidInput(name + " is " + InShort(weight) + "; make it positive, from 1e-20 to 1e20");
  }
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
        InShort(this->Number) + ", too large to compute with; bring it to at most " + InShort(to) +
        ", with Calculator (vtkArrayCalculator) for example");
    }
    if (this->Number > 0.0 && this->Number < from)
    {
      throw InvalidInput("the largest " + what + " of all, on " + (names.*this->Name)(this->Element) + ", is " +
        InShort(this->Number) + ", too small to compute with; multiply all of them, so that it is at least " +
        InShort(from) + ", with Calculator (vtkArrayCalculator) for example");
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
    throw InvalidInput("a direction is prescribed on " + kind + " " + std::to_string(element) +
      ", but there are " + std::to_string(size) + "; leave it out");
  }
}

Complex TangentialPart(const TangentFrames& frames, int element, const Vector3& direction,
  double weight, const std::string& name, const std::string& kind)
{
  const std::string where = " prescribed on " + name;
  const std::string orLeaveOut = ", or leave the " + kind + " out, by Mask or a direction of zero where there is no mask";
  if (!direction.allFinite())
  {
    throw InvalidInput("the direction" + where + " is not finite; repair it" + orLeaveOut);
  }
  if (!(weight > 0.0) || !std::isfinite(weight))
  {
    throw InvalidInput("the weight of the direction" + where + " is " + InShort(weight) +
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

std::vector<CarriedDirection> CarriedIntoFaces(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const TangentFrames& vertexFrames,
  const PrescribedVertexDirection& prescribed, const ElementNames& names)
{
  const auto& [vertex, inSpace, weight] = prescribed;
  CheckPrescribedElement(vertex, mesh.NumberOfVertices(), "vertex");
  const Complex direction =
    TangentialPart(vertexFrames, vertex, inSpace, weight, names.Vertex(vertex), "point");
  std::vector<CarriedDirection> carried;
  mesh.VisitFan(prescribed.Vertex, [&](int halfedge) {
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

PowerConstraints MakePowerConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  int N, const std::vector<PrescribedDirection>& directions, const ElementNames& names)
{
  std::vector<int> order(directions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&directions](int a, int b) { return directions[a].Face < directions[b].Face; });

  PowerConstraints constraints;
  PrescribedFaces& prescribed = constraints.Prescribed;
  std::vector<Complex> sums;
  for (int i : order)
  {
    const auto& [face, direction, weight] = directions[i];
    CheckPrescribedElement(face, mesh.NumberOfFaces(), "face");
    const Complex v =
      TangentialPart(faceFrames, face, direction, weight, names.Face(face), "cell");
    if (prescribed.Faces.empty() || prescribed.Faces.back() != directions[i].Face)
    {
      prescribed.Faces.push_back(directions[i].Face);
      prescribed.Weights.push_back(0.0);
      sums.emplace_back(0.0);
    }
    prescribed.Weights.back() += directions[i].Weight;
    sums.back() += directions[i].Weight * std::polar(std::abs(v), N * std::arg(v));
  }

  constraints.Values.resize(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
  {
    constraints.Values[b] = sums[b] / prescribed.Weights[b];
  }
  return constraints;
}

}
