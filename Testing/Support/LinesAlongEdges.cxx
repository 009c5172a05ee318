#include "Support/LinesAlongEdges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dmg::test
{

namespace
{

/// The edges of quads, by the boxes of a grid that they pass through, or nearly so.
class EdgesOfQuads
{
public:
  EdgesOfQuads(const std::vector<std::array<int, 4>>& quads, const Points& positions)
  {
    double sum = 0.0;
    for (const auto& quad : quads)
    {
      for (int k = 0; k < 4; ++k)
      {
        const Vector3 tail = positions.row(quad[k]).transpose(), head = positions.row(quad[(k + 1) % 4]).transpose();
        this->Edges.emplace_back(tail, head);
        sum += (head - tail).norm();
      }
    }
    this->MeanLength = sum / static_cast<double>(std::max<std::size_t>(this->Edges.size(), 1));
    for (int edge = 0; edge < static_cast<int>(this->Edges.size()); ++edge)
    {
      const auto& [tail, head] = this->Edges[edge];
      const int steps = 1 + static_cast<int>(2.0 * (head - tail).norm() / this->MeanLength);
      for (int k = 0; k <= steps; ++k)
      {
        this->Boxes[this->BoxOf(tail + (head - tail) * k / steps)].push_back(edge);
      }
    }
  }

  double Length() const { return this->MeanLength; }

  bool HasOneAlong(const Vector3& place, const Vector3& direction) const
  {
    const std::array<long long, 3> middle = this->BoxOf(place);
    for (int k = 0; k < 27; ++k)
    {
      const auto box = this->Boxes.find({ middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1 });
      if (box != this->Boxes.end() &&
        std::any_of(box->second.begin(), box->second.end(),
          [&](int edge) { return RunsAlong(this->Edges[edge].first, this->Edges[edge].second, place, direction); }))
      {
        return true;
      }
    }
    return false;
  }

private:
  static bool RunsAlong(const Vector3& tail, const Vector3& head, const Vector3& place, const Vector3& direction)
  {
    const Vector3 way = head - tail;
    const double length = way.norm();
    const double t = std::clamp(way.dot(place - tail) / (length * length), 0.0, 1.0);
    return length > 0.0 && (tail + t * way - place).norm() < 0.15 * length &&
      std::abs(way.dot(direction)) > std::cos(Pi / 6.0) * length * direction.norm();
  }

  std::array<long long, 3> BoxOf(const Vector3& place) const
  {
    return { std::llround(place[0] / this->MeanLength), std::llround(place[1] / this->MeanLength),
      std::llround(place[2] / this->MeanLength) };
  }

  std::vector<std::pair<Vector3, Vector3>> Edges;
  std::map<std::array<long long, 3>, std::vector<int>> Boxes;
  double MeanLength = 0.0;
};

}

double ShareAlongEdges(const TriangleMesh& surface, const std::vector<char>& isOnLine,
  const std::vector<std::array<int, 4>>& quads, const Points& positions)
{
  const EdgesOfQuads edges(quads, positions);
  double along = 0.0, all = 0.0;
  for (int edge = 0; edge < surface.NumberOfEdges(); ++edge)
  {
    if (isOnLine[edge])
    {
      const auto [a, b] = surface.EdgeVertices(edge);
      const Vector3 way = surface.Position(b) - surface.Position(a);
      const int places = 1 + static_cast<int>(4.0 * way.norm() / edges.Length());
      for (int k = 0; k < places; ++k)
      {
        const Vector3 place = surface.Position(a) + way * (k + 0.5) / places;
        along += edges.HasOneAlong(place, way) ? way.norm() / places : 0.0;
      }
      all += way.norm();
    }
  }
  return all > 0.0 ? along / all : 1.0;
}

}
