#include "Directions/UnresolvedSingularities.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// The indices of the triangles at a vertex and of those in the ring around them, and the number of its triangles.
struct Disc
{
  double Inside = 0.0, Around = 0.0;
  int NumberOfFaces = 0;
};

/// Singular vertices that are not more than two edges from each other. Three rings around a vertex have room for what a singularity of any index looks
/// like; larger sets are noise.
constexpr std::size_t LargestCluster = 37;

template <class Visit>
void VisitRing(const TriangleMesh& mesh, int vertex, const Visit& visit)
{
  mesh.VisitFan(vertex,
    [&](int h)
    {
      visit(mesh.Head(h));
      visit(mesh.Tail(TriangleMesh::Previous(h)));
    });
}

std::vector<int> ClusterOf(
  const TriangleMesh& mesh, const Vector<double>& indices, int start, std::vector<char>& isDone)
{
  std::vector<int> cluster{ start };
  isDone[start] = 1;
  const auto add = [&](int vertex)
  {
    if (indices[vertex] != 0.0 && !isDone[vertex])
    {
      isDone[vertex] = 1;
      cluster.push_back(vertex);
    }
  };
  for (std::size_t k = 0; k < cluster.size(); ++k)
  {
    VisitRing(mesh, cluster[k], [&](int neighbour) { VisitRing(mesh, neighbour, add); });
  }
  return cluster;
}

int NumberOfFacesAt(const TriangleMesh& mesh, int vertex)
{
  int number = 0;
  mesh.VisitFan(vertex, [&number](int) { ++number; });
  return number;
}

std::vector<int> UnresolvedAtVertices(const TriangleMesh& mesh, const Vector<double>& indices, int N)
{
  std::vector<int> unresolved;
  std::vector<char> isDone(mesh.NumberOfVertices(), 0);
  for (int start = 0; start < mesh.NumberOfVertices(); ++start)
  {
    if (indices[start] == 0.0 || isDone[start])
    {
      continue;
    }
    const std::vector<int> cluster = ClusterOf(mesh, indices, start, isDone);
    double sum = 0.0;
    for (const int vertex : cluster)
    {
      sum += indices[vertex];
    }
    for (const int vertex : cluster)
    {
      const bool hasOtherSign = sum * indices[vertex] < 0.0 && cluster.size() <= LargestCluster;
      if (hasOtherSign && !mesh.IsBoundaryVertex(vertex) &&
        NumberOfFacesAt(mesh, vertex) < 2 * std::lround(N * std::abs(sum)))
      {
        unresolved.push_back(vertex);
      }
    }
  }
  std::sort(unresolved.begin(), unresolved.end());
  return unresolved;
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
  if (areAtVertices)
  {
    return UnresolvedAtVertices(mesh, indices, N);
  }
  std::vector<int> unresolved;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const Disc disc = DiscOfFaces(mesh, indices, vertex);
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
