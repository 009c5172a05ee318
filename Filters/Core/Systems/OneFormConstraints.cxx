#include "Systems/OneFormConstraints.h"

#include "Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <string>
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

void CheckIndex(int element, int size, const std::string& kind)
{
  if (element < 0 || element >= size)
  {
    throw InvalidInput("a direction is prescribed on " + kind + " " + std::to_string(element) +
      ", but there are " + std::to_string(size) + "; leave it out");
  }
}

/// The integral of a constant vector along an edge.
double Along(const TriangleMesh& mesh, int edge, const Vector3& direction)
{
  const auto [tail, head] = mesh.EdgeVertices(edge);
  return direction.dot(mesh.Position(head) - mesh.Position(tail));
}

/// Means of the wishes of each edge.
OneFormConstraints Averaged(std::vector<Wish> wishes)
{
  std::stable_sort(
    wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.Edge < b.Edge; });
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

OneFormConstraints OneFormConstraintsOnFaces(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const std::vector<PrescribedDirection>& directions,
  const ElementNames& names)
{
  std::vector<Wish> wishes;
  for (const PrescribedDirection& prescribed : directions)
  {
    const int face = prescribed.Face;
    CheckIndex(face, mesh.NumberOfFaces(), "face");
    const Vector3 v = faceFrames.ToVector(face,
      TangentialPart(
        faceFrames, face, prescribed.Direction, prescribed.Weight, names.Face(face), "cell"));
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const int edge = mesh.EdgeOf(h);
      const double share = mesh.Twin(h) < 0 ? 1.0 : 0.5;
      wishes.push_back({ edge, Along(mesh, edge, v), share * prescribed.Weight });
    }
  }
  return Averaged(std::move(wishes));
}

OneFormConstraints OneFormConstraintsAtVertices(const TriangleMesh& mesh,
  const TangentFrames& vertexFrames, const std::vector<PrescribedVertexDirection>& directions,
  const ElementNames& names)
{
  std::vector<Vector3> sums(mesh.NumberOfVertices(), Vector3::Zero());
  std::vector<double> weights(mesh.NumberOfVertices(), 0.0);
  for (const PrescribedVertexDirection& prescribed : directions)
  {
    const int vertex = prescribed.Vertex;
    CheckIndex(vertex, mesh.NumberOfVertices(), "vertex");
    const Vector3 v = vertexFrames.ToVector(vertex,
      TangentialPart(vertexFrames, vertex, prescribed.Direction, prescribed.Weight,
        names.Vertex(vertex), "point"));
    weights[vertex] += prescribed.Weight;
    sums[vertex] += prescribed.Weight * v;
  }
  std::vector<Wish> wishes;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    for (int vertex : mesh.EdgeVertices(edge))
    {
      if (weights[vertex] > 0.0)
      {
        wishes.push_back(
          { edge, Along(mesh, edge, sums[vertex] / weights[vertex]), 0.5 * weights[vertex] });
      }
    }
  }
  return Averaged(std::move(wishes));
}

}
