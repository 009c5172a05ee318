#include "Drawing/ThinWalls.h"

#include "Constraints/NearestPlaces.h"

#include <algorithm>

namespace dmg
{

namespace
{

constexpr double Thickness = 0.01;    // of thin walls, over the diagonal
constexpr double Opposite = -0.5;     // cosine between the normals of both sheets
constexpr double Behind = -0.5;       // cosine between the normal and the way to the other sheet
constexpr double SameDistance = 1e-9; // over the diagonal

/// Whether a face is the other side of a thin wall at a position.
bool IsOtherSide(const FramedMesh& surface, int face, const Vector3& position, const Vector3& normal, double diagonal)
{
  if (surface.Faces.Normal(face).dot(normal) > Opposite)
  {
    return false;
  }
  const Vector3 way = ClosestOnFace(surface.Mesh, face, position).Position - position;
  const double distance = way.norm();
  return distance <= SameDistance * diagonal ||
    (distance <= Thickness * diagonal && way.dot(normal) <= Behind * distance);
}

}

void HalveNormalsAtThinWalls(const FramedMesh& surface, const std::vector<Vector3>& positions,
  std::vector<Vector3>& normals, const ExecutionContext& context)
{
  if (positions.empty())
  {
    return;
  }
  const NearestPlaces places(surface);
  const double diagonal = places.Sizes.Diagonal();
  // The ball behind that touches the surface here has few faces of this sheet in it.
  const double reach = 0.5 * Thickness * diagonal;
  constexpr double Slack = 1e-3;
  constexpr int Grain = 256, Interval = 8192;
  const int size = static_cast<int>(positions.size());
  for (int begin = 0; begin < size; begin += Interval)
  {
    context.Checkpoint(static_cast<double>(begin) / size);
    context.ParallelFor(begin, std::min(begin + Interval, size), Grain,
      [&](int first, int last)
      {
        for (int point = first; point < last; ++point)
        {
          bool isThin = false;
          places.VisitNear(positions[point] - reach * normals[point], (1.0 + Slack) * reach,
            [&](int face)
            { isThin = isThin || IsOtherSide(surface, face, positions[point], normals[point], diagonal); });
          normals[point] *= isThin ? 0.5 : 1.0;
        }
      });
  }
  context.Checkpoint(1.0);
}

}
