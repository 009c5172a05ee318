#include "Discretisations/OneFormConstraints.h"

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

/// The value that one direction asks of one edge.
struct Wish
{
  int Edge;
  double Value;
  double Weight;
};

/// The integral of a constant vector along an edge.
double Along(const TriangleMesh& mesh, int edge, const Vector3& direction)
{
  const auto [tail, head] = mesh.EdgeVertices(edge);
  return direction.dot(mesh.Position(head) - mesh.Position(tail));
}

/// Means of the wishes of each edge.
FieldConstraints Averaged(std::vector<Wish> wishes)
{
  std::stable_sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.Edge < b.Edge; });
  FieldConstraints constraints;
  std::vector<double> sums;
  for (const Wish& wish : wishes)
  {
    if (constraints.Elements.empty() || constraints.Elements.back() != wish.Edge)
    {
      constraints.Elements.push_back(wish.Edge);
      constraints.Weights.push_back(0.0);
      sums.push_back(0.0);
    }
    constraints.Weights.back() += wish.Weight;
    sums.back() += wish.Weight * wish.Value;
  }
  constraints.Values.resize(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
  {
    constraints.Values[b] = sums[b] / constraints.Weights[b];
  }
  return constraints;
}

}

FieldConstraints OneFormConstraintsOnFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<Constraint>& directions, const ElementNames& names)
{
  std::vector<Wish> wishes;
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
      wishes.push_back({ edge, Along(mesh, edge, v), share * prescribed.Weight });
    }
  }
  return Averaged(std::move(wishes));
}

FieldConstraints OneFormConstraintsAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const std::vector<Constraint>& directions, const ElementNames& names)
{
  std::vector<Wish> wishes;
  for (const Constraint& prescribed : directions)
  {
    for (const auto& [leaving, v] : CarriedIntoFaces(mesh, faceFrames, vertexFrames, prescribed, names))
    {
      for (int h : { leaving, TriangleMesh::Previous(leaving) })
      {
        const int edge = mesh.EdgeOf(h);
        const double share = mesh.Twin(h) < 0 ? 0.5 : 0.25; // of the face in the end's half
        wishes.push_back({ edge, Along(mesh, edge, v), share * prescribed.Weight });
      }
    }
  }
  return Averaged(std::move(wishes));
}

FieldConstraints Joined(const FieldConstraints& a, const FieldConstraints& b)
{
  std::vector<Wish> wishes;
  for (const FieldConstraints* constraints : { &a, &b })
  {
    const std::vector<int>& edges = constraints->Elements;
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      wishes.push_back({ edges[i], constraints->Values[i], constraints->Weights[i] });
    }
  }
  return Averaged(std::move(wishes));
}

}
