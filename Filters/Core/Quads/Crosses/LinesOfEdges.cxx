#include "Quads/Crosses/LinesOfEdges.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// Two edges that turn by more than this, in degrees, have a bend between them.
constexpr double LargestBend = 50.0;

int OtherEnd(const TriangleMesh& mesh, int edge, int vertex)
{
  const auto [a, b] = mesh.EdgeVertices(edge);
  return a == vertex ? b : a;
}

}

LinesOfEdges::LinesOfEdges(const TriangleMesh& mesh, std::vector<char> isOnLine)
  : Mesh(mesh)
  , IsOnLine(std::move(isOnLine))
{
}

std::vector<std::pair<int, int>> LinesOfEdges::EdgesAt(int vertex) const
{
  std::vector<std::pair<int, int>> edges;
  const auto add = [&](int h)
  {
    const int edge = this->Mesh.EdgeOf(h);
    if (this->IsOnLine[edge])
    {
      edges.emplace_back(edge, OtherEnd(this->Mesh, edge, vertex));
    }
  };
  this->Mesh.VisitFan(vertex,
    [&](int h)
    {
      add(h);
      const int incoming = TriangleMesh::Previous(h);
      if (this->Mesh.Twin(incoming) < 0)
      {
        add(incoming);
      }
    });
  return edges;
}

bool LinesOfEdges::IsCorner(int vertex) const
{
  const std::vector<std::pair<int, int>> edges = this->EdgesAt(vertex);
  const auto way = [&](int k) -> Vector3
  { return (this->Mesh.Position(edges[k].second) - this->Mesh.Position(vertex)).normalized(); };
  return !edges.empty() && (edges.size() != 2 || way(0).dot(way(1)) > -std::cos(LargestBend * Pi / 180.0));
}

int LinesOfEdges::EdgeOf(const SurfacePlace& place) const
{
  for (int k = 0; k < 3; ++k)
  {
    const int edge = this->Mesh.EdgeOf(3 * place.Face + (k + 1) % 3); // across from corner k
    if (place.Weights[k] == 0.0 && this->IsOnLine[edge])
    {
      return edge;
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    const std::vector<std::pair<int, int>> edges =
      place.Weights[k] == 1.0 ? this->EdgesAt(this->Mesh.Tail(3 * place.Face + k)) : std::vector<std::pair<int, int>>();
    if (!edges.empty())
    {
      return edges.front().first;
    }
  }
  return -1;
}

double LinesOfEdges::NearestPart(int edge, int from, const Vector3& position) const
{
  const Vector3 start = this->Mesh.Position(from);
  const Vector3 way = this->Mesh.Position(OtherEnd(this->Mesh, edge, from)) - start;
  const double square = way.squaredNorm();
  return square > 0.0 ? std::clamp(way.dot(position - start) / square, 0.0, 1.0) : 0.0;
}

SurfacePlace LinesOfEdges::From(const SurfacePlace& place, const Vector3& position) const
{
  int edge = this->EdgeOf(place);
  if (edge < 0)
  {
    return place;
  }
  int from = this->Mesh.EdgeVertices(edge)[0];
  double part = this->NearestPart(edge, from, position);
  if (part == 0.0) // backwards
  {
    from = OtherEnd(this->Mesh, edge, from);
    part = 1.0;
  }
  while (part == 1.0)
  {
    from = OtherEnd(this->Mesh, edge, from);
    if (this->IsCorner(from))
    {
      return place;
    }
    const std::vector<std::pair<int, int>> edges = this->EdgesAt(from);
    edge = edges[0].first == edge ? edges[1].first : edges[0].first;
    part = this->NearestPart(edge, from, position);
  }
  const int h = this->Mesh.HalfedgeOf(edge);
  return part == 0.0 ? place : OnHalfedge(h, this->Mesh.Tail(h) == from ? part : 1.0 - part);
}

}
