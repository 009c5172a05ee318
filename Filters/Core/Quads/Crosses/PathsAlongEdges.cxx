#include "Quads/Crosses/PathsAlongEdges.h"

#include "Analysis/EdgeDistances.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace dmg
{

namespace
{

double LengthOf(const TriangleMesh& mesh, int halfedge)
{
  return (mesh.Position(mesh.Head(halfedge)) - mesh.Position(mesh.Tail(halfedge))).norm();
}

}

PathsAlongEdges::PathsAlongEdges(const TriangleMesh& mesh, int from, double distance)
  : Mesh(mesh)
{
  std::unordered_map<int, double> distances{ { from, 0.0 } };
  std::unordered_map<int, char> isDone;
  // The nearest vertex comes first; of equally near ones, that of the smallest number.
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
  queue.emplace(0.0, from);
  while (!queue.empty())
  {
    const auto [length, vertex] = queue.top();
    queue.pop();
    if (isDone[vertex]++)
    {
      continue;
    }
    this->Vertices.push_back(vertex);
    if (length >= distance)
    {
      this->Farthest.push_back(vertex);
      continue;
    }
    if (mesh.IsBoundaryVertex(vertex))
    {
      continue;
    }
    mesh.VisitFan(vertex,
      [&, length = length](int h)
      {
        const double candidate = length + LengthOf(mesh, h);
        const auto [known, isNew] = distances.try_emplace(mesh.Head(h), candidate);
        if (isNew || candidate < known->second)
        {
          known->second = candidate;
          this->Arrivals[mesh.Head(h)] = h;
          queue.emplace(candidate, mesh.Head(h));
        }
      });
  }
}

std::vector<int> PathsAlongEdges::To(int vertex) const
{
  std::vector<int> path;
  for (auto arrival = this->Arrivals.find(vertex); arrival != this->Arrivals.end();
       arrival = this->Arrivals.find(this->Mesh.Tail(arrival->second)))
  {
    path.push_back(arrival->second);
  }
  return path;
}

void GrowMarks(const TriangleMesh& mesh, const Vector<double>& distances, std::vector<char>& isMarked)
{
  Vector<double> beyond =
    Vector<double>::Constant(mesh.NumberOfVertices(), std::numeric_limits<double>::infinity()); // the ends of marks
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (const int face = TriangleMesh::FaceOf(h); isMarked[face])
    {
      beyond[mesh.Tail(h)] = std::min(beyond[mesh.Tail(h)], -distances[face]);
    }
  }
  beyond = DistancesAlongEdges(mesh, std::move(beyond), 0.0);
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const auto isReached = [&](int k) { return beyond[mesh.Tail(3 * face + k)] <= 0.0; };
    isMarked[face] = isReached(0) && isReached(1) && isReached(2);
  }
}

}
