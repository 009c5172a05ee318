#include "Operators/UnresolvedSingularities.h"

#include <cmath>
#include <set>

namespace dmg
{

namespace
{

double SumAroundVertex(const TriangleMesh& mesh, const Vector<double>& indices, int vertex)
{
  double sum = indices[vertex];
  mesh.VisitFan(vertex, [&](int h) { sum += indices[mesh.Head(h)]; });
  return sum;
}

double SumAroundFace(const TriangleMesh& mesh, const Vector<double>& indices, int face)
{
  std::set<int> faces; // each once, although two vertices may see it
  for (int k = 0; k < 3; ++k)
  {
    mesh.VisitFan(mesh.FaceCorners()(face, k), [&](int h) { faces.insert(TriangleMesh::FaceOf(h)); });
  }
  double sum = 0.0;
  for (const int other : faces)
  {
    sum += indices[other];
  }
  return sum;
}

}

std::vector<int> UnresolvedSingularities(
  const TriangleMesh& mesh, const Vector<double>& indices, int N, bool areAtVertices)
{
  std::vector<int> unresolved;
  for (int element = 0; element < indices.size(); ++element)
  {
    if (indices[element] == 0.0)
    {
      continue;
    }
    const double sum = areAtVertices ? SumAroundVertex(mesh, indices, element) : SumAroundFace(mesh, indices, element);
    if (sum * indices[element] < 0.0 && std::lround(N * std::abs(sum)) >= 2)
    {
      unresolved.push_back(element);
    }
  }
  return unresolved;
}

}
