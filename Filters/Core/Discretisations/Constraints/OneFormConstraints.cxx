#include "Discretisations/Constraints/OneFormConstraints.h"

#include "Discretisations/Constraints/WeightedMeans.h"

#include <utility>

namespace dmg
{

namespace
{

using Values = std::vector<WeightedValue<double>>;

/// The integral of a constant vector along an edge.
double Along(const TriangleMesh& mesh, int edge, const Vector3& direction)
{
  const auto [tail, head] = mesh.EdgeVertices(edge);
  return direction.dot(mesh.Position(head) - mesh.Position(tail));
}

}

FieldConstraints OneFormConstraintsOnFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<Constraint>& directions, const ElementNames& names)
{
  Values values;
  for (const Constraint& prescribed : directions)
  {
    const int face = prescribed.Element;
    CheckElement(face, mesh.NumberOfFaces(), "face");
    const Vector3 v = faceFrames.ToVector(
      face, TangentialPart(faceFrames, face, prescribed.Direction, prescribed.Weight, names.Face(face), "cell"));
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const int edge = mesh.EdgeOf(h);
      const double share = mesh.Twin(h) < 0 ? 1.0 : 0.5;
      values.push_back({ edge, Along(mesh, edge, v), share * prescribed.Weight });
    }
  }
  return MeansByElement(std::move(values));
}

FieldConstraints OneFormConstraintsAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const std::vector<Constraint>& directions, const ElementNames& names)
{
  Values values;
  for (const Constraint& prescribed : directions)
  {
    for (const auto& [leaving, v] : CarriedIntoFaces(mesh, faceFrames, vertexFrames, prescribed, names))
    {
      for (int h : { leaving, TriangleMesh::Previous(leaving) })
      {
        const int edge = mesh.EdgeOf(h);
        const double share = mesh.Twin(h) < 0 ? 0.5 : 0.25; // of the face in the end's half
        values.push_back({ edge, Along(mesh, edge, v), share * prescribed.Weight });
      }
    }
  }
  return MeansByElement(std::move(values));
}

FieldConstraints Joined(const FieldConstraints& a, const FieldConstraints& b)
{
  Values values;
  for (const FieldConstraints* constraints : { &a, &b })
  {
    const std::vector<int>& edges = constraints->Elements;
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      values.push_back({ edges[i], constraints->Values[i], constraints->Weights[i] });
    }
  }
  return MeansByElement(std::move(values));
}

}
