#include "Discretisations/OneFormConstraints.h"

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

/// What one direction asks of one edge.
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
OneFormConstraints Averaged(std::vector<Wish> wishes)
{
  std::stable_sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.Edge < b.Edge; });
  OneFormConstraints constraints;
  PrescribedEdges& prescribed = constraints.Prescribed;
  std::vector<double> sums;
  for (const Wish& wish : wishes)
  {
    if (prescribed.Edges.empty() || prescribed.Edges.back() != wish.Edge)
    {
      prescribed.Edges.push_back(wish.Edge);
      prescribed.Weights.push_back(0.0);
      sums.push_back(0.0);
    }
    prescribed.Weights.back() += wish.Weight;
    sums.back() += wish.Weight * wish.Value;
  }
  constraints.Values.resize(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
  {
    constraints.Values[b] = sums[b] / prescribed.Weights[b];
  }
  return constraints;
}

}

OneFormConstraints OneFormConstraintsOnFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<PrescribedDirection>& directions, const ElementNames& names)
{
  std::vector<Wish> wishes;
  for (const PrescribedDirection& prescribed : directions)
  {
    const int face = prescribed.Face;
    CheckPrescribedElement(face, mesh.NumberOfFaces(), "face");
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

OneFormConstraints OneFormConstraintsAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const std::vector<PrescribedVertexDirection>& directions,
  const ElementNames& names)
{
  std::vector<Wish> wishes;
  for (const PrescribedVertexDirection& prescribed : directions)
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

OneFormConstraints Joined(const OneFormConstraints& a, const OneFormConstraints& b)
{
  std::vector<Wish> wishes;
  for (const OneFormConstraints* constraints : { &a, &b })
  {
    const auto& [edges, weights] = constraints->Prescribed;
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      wishes.push_back({ edges[i], constraints->Values[i], weights[i] });
    }
  }
  return Averaged(std::move(wishes));
}

}
