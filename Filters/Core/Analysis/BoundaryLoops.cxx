#include "Analysis/BoundaryLoops.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace dmg
{

std::vector<BoundaryLoop> FindBoundaryLoops(const TriangleMesh& mesh)
{
  const std::vector<int> components = FaceComponents(mesh);
  std::vector<char> isVisited(mesh.NumberOfVertices(), 0);
  std::vector<BoundaryLoop> loops;
  for (int first = 0; first < mesh.NumberOfVertices(); ++first)
  {
    if (isVisited[first] || !mesh.IsBoundaryVertex(first))
    {
      continue;
    }
    BoundaryLoop loop;
    loop.Component = components[TriangleMesh::FaceOf(mesh.OutgoingHalfedge(first))];
    for (int vertex = first; !isVisited[vertex];)
    {
      isVisited[vertex] = 1;
      loop.Vertices.push_back(vertex);
      const int next = mesh.Head(mesh.OutgoingHalfedge(vertex));
      loop.Length += (mesh.Position(next) - mesh.Position(vertex)).norm();
      vertex = next;
    }
    loops.push_back(std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(),
    [](const BoundaryLoop& a, const BoundaryLoop& b)
    { return std::make_tuple(a.Component, -a.Length) < std::make_tuple(b.Component, -b.Length); });
  return loops;
}

std::vector<int> BoundaryVertices(const TriangleMesh& mesh)
{
  std::vector<int> vertices;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (mesh.IsBoundaryVertex(vertex))
    {
      vertices.push_back(vertex);
    }
  }
  return vertices;
}

}
