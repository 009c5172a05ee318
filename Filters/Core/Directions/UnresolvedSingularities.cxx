#include "Directions/UnresolvedSingularities.h"

#include <cmath>

namespace dmg
{

namespace
{

/// The indices at a vertex and in the ring around it, and the number of its triangles.
struct Disc
{
  double Inside = 0.0, Around = 0.0;
  int NumberOfFaces = 0;
};

Disc DiscOfVertices(const TriangleMesh& mesh, const Vector<double>& indices, int vertex)
{
  Disc disc{ indices[vertex] };
  mesh.VisitFan(vertex,
    [&](int h)
    {
      disc.Around += indices[mesh.Head(h)];
      ++disc.NumberOfFaces;
    });
  return disc;
}

Disc DiscOfFaces(const TriangleMesh& mesh, const Vector<double>& indices, int vertex)
{
  Disc disc;
  mesh.VisitFan(vertex,
    [&](int h)
    {
      disc.Inside += indices[TriangleMesh::FaceOf(h)];
      const int across = mesh.Twin(TriangleMesh::Next(h));
      disc.Around += across >= 0 ? indices[TriangleMesh::FaceOf(across)] : 0.0;
      ++disc.NumberOfFaces;
    });
  return disc;
}

}

std::vector<int> UnresolvedSingularities(
  const TriangleMesh& mesh, const Vector<double>& indices, int N, bool areAtVertices)
{
  std::vector<int> unresolved;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const Disc disc = areAtVertices ? DiscOfVertices(mesh, indices, vertex) : DiscOfFaces(mesh, indices, vertex);
    const double sum = disc.Inside + disc.Around;
    const bool turnsTooFast = disc.NumberOfFaces < 2 * std::lround(N * std::abs(sum));
    if (turnsTooFast && sum * disc.Inside < 0.0 && !mesh.IsBoundaryVertex(vertex))
    {
      unresolved.push_back(vertex);
    }
  }
  return unresolved;
}

}
