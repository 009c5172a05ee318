#include "Quads/Isolines/QuadDistances.h"

#include "Mesh/FramedMesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace dmg
{

namespace
{

Vector3 MiddleOf(const std::array<int, 4>& quad, const Points& positions)
{
  Vector3 sum = Vector3::Zero();
  for (const int vertex : quad)
  {
    sum += positions.row(vertex).transpose();
  }
  return sum / 4.0;
}

/// The quads as triangles; none where a triangle would have all of its corners in one place.
std::optional<FramedMesh> AsTriangles(
  const std::vector<std::array<int, 4>>& quads, const Points& positions, const ExecutionContext& context)
{
  std::vector<int> numbers(positions.rows(), -1), used;
  for (const auto& quad : quads)
  {
    for (const int vertex : quad)
    {
      if (numbers[vertex] < 0)
      {
        numbers[vertex] = static_cast<int>(used.size());
        used.push_back(vertex);
      }
    }
  }
  const int corners = static_cast<int>(used.size()), size = static_cast<int>(quads.size());
  Points points(corners + size, 3);
  for (int k = 0; k < corners; ++k)
  {
    points.row(k) = positions.row(used[k]);
  }
  Triangles triangles(4 * size, 3);
  for (int q = 0; q < size; ++q)
  {
    points.row(corners + q) = MiddleOf(quads[q], positions).transpose();
    for (int k = 0; k < 4; ++k)
    {
      const int a = numbers[quads[q][k]], b = numbers[quads[q][(k + 1) % 4]];
      triangles.row(4 * q + k) << a, b, corners + q;
      if (points.row(a) == points.row(b) && points.row(a) == points.row(corners + q))
      {
        return std::nullopt;
      }
    }
  }
  return FramedMesh(TriangleMesh(std::move(points), std::move(triangles), {}, context), context);
}

/// Calls measure(i) for all indices, a part after the other.
void InParts(int size, const ExecutionContext& context, const std::function<void(int)>& measure)
{
  constexpr int Part = 16384, Grain = 256;
  for (int first = 0; first < size; first += Part)
  {
    context.Checkpoint(static_cast<double>(first) / size);
    context.ParallelFor(first, std::min(size, first + Part), Grain,
      [&measure](int begin, int end)
      {
        for (int i = begin; i < end; ++i)
        {
          measure(i);
        }
      });
  }
}

}

Vector<double> DistancesFromQuads(const TriangleMesh& mesh, const std::vector<std::array<int, 4>>& quads,
  const Points& positions, const ExecutionContext& context)
{
  const std::optional<FramedMesh> triangles = AsTriangles(quads, positions, context);
  Vector<double> distances(triangles ? mesh.NumberOfVertices() : 0);
  if (triangles)
  {
    const NearestPlaces places(*triangles);
    InParts(mesh.NumberOfVertices(), context,
      [&](int vertex) { distances[vertex] = places(mesh.Position(vertex)).Distance; });
  }
  return distances;
}

Vector<double> DistancesFromSurface(const NearestPlaces& surface, const std::vector<std::array<int, 4>>& quads,
  const std::vector<int>& faces, const Points& positions, const ExecutionContext& context)
{
  Vector<double> distances(static_cast<int>(quads.size()));
  InParts(static_cast<int>(distances.size()), context,
    [&](int q)
    {
      distances[q] = surface(MiddleOf(quads[q], positions), faces[q]).Distance;
      for (int k = 0; k < 4; ++k)
      {
        const Vector3 middle = 0.5 * (positions.row(quads[q][k]) + positions.row(quads[q][(k + 1) % 4])).transpose();
        distances[q] = std::max(distances[q], surface(middle, faces[q]).Distance);
      }
    });
  return distances;
}

Vector<double> AreasOfQuads(const std::vector<std::array<int, 4>>& quads, const Points& positions)
{
  Vector<double> areas = Vector<double>::Zero(static_cast<int>(quads.size()));
  for (int q = 0; q < areas.size(); ++q)
  {
    const Vector3 middle = MiddleOf(quads[q], positions);
    for (int k = 0; k < 4; ++k)
    {
      const Vector3 a = positions.row(quads[q][k]).transpose(), b = positions.row(quads[q][(k + 1) % 4]).transpose();
      areas[q] += 0.5 * (a - middle).cross(b - middle).norm();
    }
  }
  return areas;
}

}
