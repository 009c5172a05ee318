#include "Drawing/ContourLines.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dmg
{
namespace
{

/// Joins the segments of lines at their points.
class Tracer
{
public:
  Tracer(const TriangleMesh& mesh, const Points& places, const Vector<double>& u, const std::vector<double>& values,
    const SidesOfSurface& sides, const ExecutionContext& context)
    : Mesh(mesh)
    , Places(places)
    , U(u)
    , Values(values)
    , Sides(sides)
    , Ranks(mesh.NumberOfVertices())
    , FirstPoints(mesh.NumberOfEdges() + 1)
  {
    constexpr int Grain = 8192;
    context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
      [this](int first, int last)
      {
        for (int vertex = first; vertex < last; ++vertex)
        {
          const auto larger = std::upper_bound(this->Values.begin(), this->Values.end(), this->U[vertex]);
          this->Ranks[vertex] = static_cast<int>(larger - this->Values.begin());
        }
      });
    int points = 0;
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      const auto [a, b] = this->RanksOf(edge);
      this->FirstPoints[edge] = points;
      points += b - a;
    }
    this->FirstPoints.back() = points;
  }

  ContourLines Trace() const
  {
    ContourLines lines;
    this->Place(lines);
    const int points = this->FirstPoints.back();
    std::vector<int> next(points, -1);
    std::vector<char> isReached(points, 0);
    this->Join(next, isReached);
    lines.Offsets.push_back(0);
    for (int point = 0; point < points; ++point)
    {
      if (!isReached[point]) // on a boundary
      {
        Follow(point, next, lines);
      }
    }
    for (int point = 0; point < points; ++point)
    {
      if (next[point] >= 0)
      {
        Follow(point, next, lines);
      }
    }
    return lines;
  }

private:
  /// The numbers of values that are not larger than those of the ends, ascending.
  std::array<int, 2> RanksOf(int edge) const
  {
    const auto [a, b] = this->Mesh.EdgeVertices(edge);
    return { std::min(this->Ranks[a], this->Ranks[b]), std::max(this->Ranks[a], this->Ranks[b]) };
  }

  int PointOn(int halfedge, int value) const
  {
    const int edge = this->Mesh.EdgeOf(halfedge);
    return this->FirstPoints[edge] + value - this->RanksOf(edge)[0];
  }

  void Place(ContourLines& lines) const
  {
    lines.Positions.resize(this->FirstPoints.back(), 3);
    lines.Values.resize(lines.Positions.rows());
    for (int edge = 0; edge < this->Mesh.NumberOfEdges(); ++edge)
    {
      const auto [a, b] = this->Mesh.EdgeVertices(edge);
      for (int point = this->FirstPoints[edge]; point < this->FirstPoints[edge + 1]; ++point)
      {
        const int value = this->RanksOf(edge)[0] + point - this->FirstPoints[edge];
        const double t = std::clamp((this->Values[value] - this->U[a]) / (this->U[b] - this->U[a]), 0.0, 1.0);
        lines.Positions.row(point) = ((1.0 - t) * this->Places.row(a) + t * this->Places.row(b));
        lines.Values[point] = value;
      }
    }
  }

  /// A line comes into a face through the side along which the function passes its value upwards, counter-clockwise from the positive side.
  void Join(std::vector<int>& next, std::vector<char>& isReached) const
  {
    for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
    {
      std::array<int, 4> ranks;
      for (int k = 0; k < 4; ++k)
      {
        ranks[k] = this->Ranks[this->Mesh.FaceCorners()(face, k % 3)];
      }
      const auto [smallest, largest] = std::minmax({ ranks[0], ranks[1], ranks[2] });
      for (int value = smallest; value < largest; ++value)
      {
        int in = -1;
        int out = -1;
        for (int k = 0; k < 3; ++k)
        {
          in = ranks[k] <= value && value < ranks[k + 1] ? 3 * face + k : in;
          out = ranks[k + 1] <= value && value < ranks[k] ? 3 * face + k : out;
        }
        if (this->Sides.OfFaces[face] < 0.0)
        {
          std::swap(in, out);
        }
        const int end = this->PointOn(out, value);
        next[this->PointOn(in, value)] = end;
        isReached[end] = 1;
      }
    }
  }

  static void Follow(int point, std::vector<int>& next, ContourLines& lines)
  {
    lines.Order.push_back(point);
    while (next[point] >= 0)
    {
      const int following = next[point];
      next[point] = -1;
      point = following;
      lines.Order.push_back(point);
    }
    lines.Offsets.push_back(static_cast<int>(lines.Order.size()));
  }

  const TriangleMesh& Mesh;
  const Points& Places;
  const Vector<double>& U;
  const std::vector<double>& Values;
  const SidesOfSurface& Sides;
  std::vector<int> Ranks;       ///< of vertices
  std::vector<int> FirstPoints; ///< of edges
};

}

ContourLines FindContourLines(const TriangleMesh& mesh, const Points& places, const Vector<double>& u,
  const std::vector<double>& values, const SidesOfSurface& sides, const ExecutionContext& context)
{
  return Tracer(mesh, places, u, values, sides, context).Trace();
}

}
