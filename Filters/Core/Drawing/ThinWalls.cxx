#include "Drawing/ThinWalls.h"

#include "Places/NearestPlaces.h"

#include <algorithm>

namespace dmg
{

namespace
{

constexpr double Thickness = 0.01;    // of thin walls, over the diagonal
constexpr double Parallel = 0.5;      // cosine between the normals of both sheets, or of one and the other's opposite
constexpr double Across = 0.5;        // cosine between the normal, or its opposite, and the way to the other sheet
constexpr double SameDistance = 1e-9; // over the diagonal

/// The other sheets of a thin wall at a position.
struct SheetsNearby
{
  bool HasOneBehind = false;
  bool HasOneInFront = false; ///< that faces the same way: the viewer sees its other side

  void Visit(const FramedMesh& surface, int face, const Vector3& position, const Vector3& normal, double diagonal)
  {
    const double cosine = surface.Faces.Normal(face).dot(normal);
    const bool isOpposite = cosine <= -Parallel, isAlike = cosine >= Parallel;
    if (!isOpposite && !isAlike)
    {
      return;
    }
    const Vector3 way = ClosestOnFace(surface.Mesh, face, position).Position - position;
    const double distance = way.norm();
    if (distance <= SameDistance * diagonal)
    {
      this->HasOneBehind = this->HasOneBehind || isOpposite; // alike it is the sheet itself
    }
    else if (distance <= Thickness * diagonal)
    {
      this->HasOneBehind = this->HasOneBehind || way.dot(normal) <= -Across * distance;
      this->HasOneInFront = this->HasOneInFront || (isAlike && way.dot(normal) >= Across * distance);
    }
  }

  double Factor() const { return this->HasOneBehind ? 0.5 : this->HasOneInFront ? -0.5 : 1.0; }
};

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
  // The balls on both sides that touch the surface here have few faces of this sheet in them.
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
          SheetsNearby sheets;
          for (const double side : { -reach, reach })
          {
            places.VisitNear(positions[point] + side * normals[point], (1.0 + Slack) * reach,
              [&](int face) { sheets.Visit(surface, face, positions[point], normals[point], diagonal); });
          }
          normals[point] *= sheets.Factor();
        }
      });
  }
  context.Checkpoint(1.0);
}

}
