#include "Analysis/EdgeDistances.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace dmg
{

Vector<double> DistancesAlongEdges(const TriangleMesh& mesh, const std::vector<int>& from, double maximum)
{
  Vector<double> starts = Vector<double>::Constant(mesh.NumberOfVertices(), std::numeric_limits<double>::infinity());
  for (const int vertex : from)
  {
    starts[vertex] = 0.0;
  }
  return DistancesAlongEdges(mesh, std::move(starts), maximum);
}

Vector<double> DistancesAlongEdges(const TriangleMesh& mesh, Vector<double> starts, double maximum)
{
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  Vector<double>& distances = starts;
  for (int vertex = 0; vertex < distances.size(); ++vertex)
  {
    if (distances[vertex] < std::numeric_limits<double>::infinity())
    {
      front.emplace(distances[vertex], vertex);
    }
  }
  while (!front.empty())
  {
    const auto [distance, vertex] = front.top();
    front.pop();
    if (distance > distances[vertex])
    {
      continue;
    }
    const auto visit = [&, distance = distance, vertex = vertex](int neighbour)
    {
      const double further = distance + (mesh.Position(neighbour) - mesh.Position(vertex)).norm();
      if (further <= maximum && further < distances[neighbour])
      {
        distances[neighbour] = further;
        front.emplace(further, neighbour);
      }
    };
    mesh.VisitFan(vertex,
      [&](int h)
      {
        visit(mesh.Head(h));
        visit(mesh.Tail(TriangleMesh::Previous(h)));
      });
  }
  return starts;
}

std::vector<int> FarthestVertices(const Vector<double>& distances, const std::vector<int>& components)
{
  std::vector<int> farthest(*std::max_element(components.begin(), components.end()) + 1, -1);
  for (int vertex = 0; vertex < distances.size(); ++vertex)
  {
    int& best = farthest[components[vertex]];
    if (best < 0 || distances[vertex] > distances[best])
    {
      best = vertex;
    }
  }
  return farthest;
}

std::vector<double> ComponentDiameters(const TriangleMesh& mesh, const std::vector<int>& components)
{
  const Vector<double> noDistances = Vector<double>::Zero(mesh.NumberOfVertices());
  const std::vector<int> ends =
    FarthestVertices(DistancesAlongEdges(mesh, FarthestVertices(noDistances, components)), components);
  const Vector<double> distances = DistancesAlongEdges(mesh, ends);
  std::vector<double> diameters;
  for (const int vertex : FarthestVertices(distances, components))
  {
    diameters.push_back(distances[vertex]);
  }
  return diameters;
}

}
