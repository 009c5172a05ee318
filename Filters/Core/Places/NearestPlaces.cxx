#include "Places/NearestPlaces.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

using Box = Eigen::AlignedBox<double, 3>;
using BoxTree = Eigen::KdBVH<double, 3, int>;

Vector3 ClosestOnSide(const Vector3& tail, const Vector3& head, const Vector3& position)
{
  const Vector3 side = head - tail;
  const double squaredLength = side.squaredNorm();
  const double along = squaredLength > 0.0 ? side.dot(position - tail) / squaredLength : 0.0;
  return tail + std::clamp(along, 0.0, 1.0) * side;
}

std::array<Vector3, 3> CornersOf(const TriangleMesh& mesh, int face)
{
  return { mesh.Position(mesh.Tail(3 * face)), mesh.Position(mesh.Tail(3 * face + 1)),
    mesh.Position(mesh.Tail(3 * face + 2)) };
}

/// The squared distance from a box, without branches, which make Eigen's squaredExteriorDistance slow.
double SquaredDistance(const Box& box, const Vector3& position)
{
  return (box.min() - position).cwiseMax(position - box.max()).cwiseMax(0.0).squaredNorm();
}

inline Box BoxOf(const TriangleMesh& mesh, int face)
{
  const std::array<Vector3, 3> corners = CornersOf(mesh, face);
  return { corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]), corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) };
}

/// Whether no place in a bounding box is nearer than the nearest one so far.
inline bool IsFarther(double squaredDistance, const NearestPlace& nearest)
{
  constexpr double Rounding = 1.0 + 1e-12; // faces that are as near as each other are not told apart here
  return squaredDistance > Rounding * nearest.Distance * nearest.Distance;
}

/// Takes the place of a face that is nearest to a point, if it is nearer than the nearest one so far, or as near and of a smaller
/// number. So the result does not depend on the way of a search.
void TakeNearer(const TriangleMesh& mesh, int face, const Vector3& position, NearestPlace& nearest)
{
  if (!IsFarther(SquaredDistance(BoxOf(mesh, face), position), nearest))
  {
    const NearestPlace place = ClosestOnFace(mesh, face, position);
    const bool isNearer = place.Distance < nearest.Distance;
    nearest = isNearer || (place.Distance == nearest.Distance && place.Face < nearest.Face) ? place : nearest;
  }
}

std::vector<Box> BoxesOf(const TriangleMesh& mesh)
{
  std::vector<Box> boxes(mesh.NumberOfFaces());
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    boxes[TriangleMesh::FaceOf(h)].extend(mesh.Position(mesh.Tail(h)));
  }
  return boxes;
}

}

NearestPlace ClosestOnFace(const TriangleMesh& mesh, int face, const Vector3& position)
{
  const std::array<Vector3, 3> corners = CornersOf(mesh, face);
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double squaredNormal = normal.squaredNorm();
  bool isInside = squaredNormal > 0.0;
  NearestPlace place{ face };
  for (int k = 0; k < 3; ++k)
  {
    const Vector3 &tail = corners[k], &head = corners[(k + 1) % 3];
    if (squaredNormal == 0.0 || normal.cross(head - tail).dot(position - tail) < 0.0)
    {
      isInside = false;
      const Vector3 onSide = ClosestOnSide(tail, head, position);
      const double distance = (position - onSide).norm();
      if (distance < place.Distance)
      {
        place.Distance = distance;
        place.Position = onSide;
      }
    }
  }
  if (isInside)
  {
    const double height = normal.dot(position - corners[0]) / squaredNormal;
    place.Position = position - height * normal;
    place.Distance = std::abs(height) * std::sqrt(squaredNormal);
  }
  return place;
}

/// Eigen's tree of boxes, with a search that leaves out what is farther than the nearest face so far.
class NearestPlaces::Tree
{
public:
  explicit Tree(const TriangleMesh& mesh)
    : Mesh(mesh)
  {
    std::vector<int> faces(mesh.NumberOfFaces());
    std::iota(faces.begin(), faces.end(), 0);
    const std::vector<Box> boxes = BoxesOf(mesh);
    this->Boxes.init(faces.begin(), faces.end(), boxes.begin(), boxes.end());
  }

  NearestPlace Nearest(const Vector3& position, NearestPlace nearest) const
  {
    std::array<Candidate, 2 * 64> candidates; // a tree of so many levels would not fit into memory
    int size = 0;
    candidates[size++] = { 0.0, this->Boxes.getRootIndex() };
    while (size > 0)
    {
      const Candidate candidate = candidates[--size];
      if (IsFarther(candidate.SquaredDistance, nearest))
      {
        continue;
      }
      BoxTree::VolumeIterator box = nullptr, lastBox = nullptr;
      BoxTree::ObjectIterator face = nullptr, lastFace = nullptr;
      this->Boxes.getChildren(candidate.Node, box, lastBox, face, lastFace);
      for (; face != lastFace; ++face)
      {
        TakeNearer(this->Mesh, *face, position, nearest);
      }
      const int first = size;
      for (; box != lastBox; ++box)
      {
        candidates[size++] = { SquaredDistance(this->Boxes.getVolume(*box), position), *box };
      }
      if (size == first + 2 && candidates[first].SquaredDistance < candidates[first + 1].SquaredDistance)
      {
        std::swap(candidates[first], candidates[first + 1]); // the nearer one is looked at first
      }
    }
    return nearest;
  }

  void VisitNear(const Vector3& position, double distance, const std::function<void(int)>& visit) const
  {
    std::vector<int> nodes{ this->Boxes.getRootIndex() };
    while (!nodes.empty())
    {
      BoxTree::VolumeIterator box = nullptr, lastBox = nullptr;
      BoxTree::ObjectIterator face = nullptr, lastFace = nullptr;
      this->Boxes.getChildren(nodes.back(), box, lastBox, face, lastFace);
      nodes.pop_back();
      for (; face != lastFace; ++face)
      {
        if (SquaredDistance(BoxOf(this->Mesh, *face), position) <= distance * distance)
        {
          visit(*face);
        }
      }
      for (; box != lastBox; ++box)
      {
        if (SquaredDistance(this->Boxes.getVolume(*box), position) <= distance * distance)
        {
          nodes.push_back(*box);
        }
      }
    }
  }

private:
  struct Candidate
  {
    double SquaredDistance;
    int Node;
  };

  const TriangleMesh& Mesh;
  BoxTree Boxes;
};

NearestPlaces::NearestPlaces(const FramedMesh& surface)
  : NearestPlaces(surface, SizesOf(surface.Mesh))
{
}

NearestPlaces::NearestPlaces(const FramedMesh& surface, const SurfaceSizes& sizes)
  : Surface(surface)
  , Sizes(sizes)
  , Boxes(std::make_unique<const Tree>(surface.Mesh))
{
}

NearestPlaces::~NearestPlaces() = default;

NearestPlace NearestPlaces::operator()(const Vector3& position, int near) const
{
  NearestPlace start;
  if (!std::isfinite(position.squaredNorm()))
  {
    return start;
  }
  if (near >= 0)
  {
    start = ClosestOnFace(this->Surface.Mesh, near, position);
  }
  return this->Boxes->Nearest(position, start);
}

void NearestPlaces::VisitNear(
  const Vector3& position, double distance, const std::function<void(int face)>& visit) const
{
  this->Boxes->VisitNear(position, distance, visit);
}

NearestPlace NearestPlaces::From(int face, const Vector3& position, int last) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  NearestPlace nearest = ClosestOnFace(mesh, face, position);
  for (int former = -1; former != nearest.Face && nearest.Face != last;)
  {
    former = nearest.Face;
    for (int h = 3 * former; h < 3 * former + 3; ++h)
    {
      mesh.VisitFan(mesh.Tail(h),
        [&mesh, &position, &nearest, former](int halfedge)
        {
          if (const int beside = TriangleMesh::FaceOf(halfedge); beside != former)
          {
            TakeNearer(mesh, beside, position, nearest);
          }
        });
    }
  }
  return nearest;
}

}
