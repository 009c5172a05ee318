#include "Discretisations/Constraints/FieldConstraints.h"

#include "Discretisations/Constraints/WeightedMeans.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <string>
#include <utility>

namespace dmg
{

namespace
{

void CheckWeight(const std::string& name, double weight)
{
  if (!(weight >= SmallestWeight && weight <= LargestWeight))
  {
    throw InvalidInput(name + " is " + ShortText(weight) + "; make it positive, from 1e-20 to 1e20");
  }
}

}

void CheckWeights(const FieldWeights& weights)
{
  CheckWeight("Smoothness", weights.Smoothness);
  CheckWeight("Alignment", weights.Alignment);
}

std::vector<CarriedDirection> CarriedIntoFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Constraint& prescribed, const ElementNames& names)
{
  const auto& [vertex, inSpace, weight, side] = prescribed;
  CheckElement(vertex, mesh.NumberOfVertices(), "vertex");
  const Complex direction = TangentialPart(vertexFrames, vertex, inSpace, weight, names.Vertex(vertex), "point");
  std::vector<CarriedDirection> carried;
  mesh.VisitFan(prescribed.Element,
    [&](int halfedge)
    {
      const int face = TriangleMesh::FaceOf(halfedge);
      const Complex turn = TransportTurn(vertexFrames, prescribed.Element, faceFrames, face);
      carried.push_back({ halfedge, faceFrames.ToVector(face, turn * direction) });
    });
  return carried;
}

std::vector<Constraint> DirectionsOnFaces(
  const FramedMesh& surface, const Constraints& constraints, const ElementNames& names)
{
  std::vector<Constraint> onFaces = constraints.OnFaces;
  for (const Constraint& prescribed : constraints.AtVertices)
  {
    for (const auto& [halfedge, direction] :
      CarriedIntoFaces(surface.Mesh, surface.Faces, surface.Vertices, prescribed, names))
    {
      onFaces.push_back({ TriangleMesh::FaceOf(halfedge), direction, prescribed.Weight });
    }
  }
  return onFaces;
}

FieldConstraints MakePowerConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const std::vector<Constraint>& directions, const ElementNames& names)
{
  std::vector<WeightedValue<Complex>> powers;
  powers.reserve(directions.size());
  for (int i : ByElement(directions))
  {
    const auto& [face, direction, weight, side] = directions[i];
    CheckElement(face, mesh.NumberOfFaces(), "face");
    const Complex v = TangentialPart(faceFrames, face, direction, weight, names.Face(face), "cell");
    powers.push_back({ face, PowerOfDirection(v, N), weight });
  }
  return MeansByElement(std::move(powers));
}

}
