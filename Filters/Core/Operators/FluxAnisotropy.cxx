#include "Operators/FluxAnisotropy.h"

#include "Mesh/TangentFrames.h"
#include "Operators/PowerFieldOperators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>
#include <vector>

namespace dmg
{
namespace
{

constexpr int Grain = 16;
constexpr int NumberOfPlaces = 256;
constexpr std::size_t FacesAround = 100;
constexpr double LargestAnisotropy = 0.2;

/// The vector between the centroids of the faces of a halfedge and of its twin, unfolded, with the halfedge along the real axis.
Complex BetweenCentroids(const TriangleMesh& mesh, int halfedge)
{
  const Vector3 tail = mesh.Position(mesh.Tail(halfedge));
  const Vector3 along = (mesh.Position(mesh.Head(halfedge)) - tail).normalized();
  const auto centroid = [&](int h)
  {
    const Vector3 apex = mesh.Position(mesh.Tail(TriangleMesh::Previous(h))) - tail;
    const Vector3 center = (apex + mesh.Position(mesh.Head(h)) - tail + mesh.Position(mesh.Tail(h)) - tail) / 3.0;
    return Complex(center.dot(along), center.cross(along).norm());
  };
  return std::conj(centroid(mesh.Twin(halfedge))) - centroid(halfedge);
}

/// A face that is unfolded into the plane of another one.
struct UnfoldedFace
{
  int Face;
  Complex Turn; ///< carries directions from its frame into that of the other face
};

/// Faces spread evenly over the area, in the order of the faces; an area above 0.
std::vector<int> PlacesOnArea(const Vector<double>& areas)
{
  const double step = areas.sum() / NumberOfPlaces;
  std::vector<int> places;
  double passed = 0.0;
  for (int face = 0; face < areas.size(); ++face)
  {
    passed += areas[face];
    while (places.size() < NumberOfPlaces && (places.size() + 0.5) * step < passed)
    {
      places.push_back(face);
    }
  }
  return places;
}

}

double FluxAnisotropy(const TriangleMesh& mesh, int face)
{
  // T has half its trace in the mean; the modulus of the deviator is half the difference of its eigenvalues.
  double mean = 0.0;
  Complex deviator = 0.0;
  std::unordered_set<int> reached = { face };
  std::vector<UnfoldedFace> faces = { { face, 1.0 } };
  for (std::size_t next = 0; next < faces.size(); ++next)
  {
    const UnfoldedFace here = faces[next];
    const std::array<Complex, 3> sides = SideDirections(mesh, here.Face);
    for (int k = 0; k < 3; ++k)
    {
      const int h = 3 * here.Face + k;
      const int twin = mesh.Twin(h);
      if (twin < 0)
      {
        continue;
      }
      const double weight = PowerEdgeWeight(mesh, h);
      const Complex between = BetweenCentroids(mesh, h) * sides[k] * here.Turn;
      mean += weight * std::norm(between);
      deviator += weight * between * between;
      const int neighbour = TriangleMesh::FaceOf(twin);
      if (faces.size() < FacesAround && reached.insert(neighbour).second)
      {
        const Complex turn = TransportOfSides(SideDirections(mesh, neighbour)[twin % 3], sides[k]);
        faces.push_back({ neighbour, here.Turn * turn });
      }
    }
  }
  return mean > 0.0 ? std::abs(deviator) / mean : 0.0;
}

double ShareOfShearedArea(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const std::vector<int> places = PlacesOnArea(mesh.FaceAreas(context));
  std::vector<char> isSheared(places.size());
  context.ParallelFor(0, static_cast<int>(places.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        isSheared[i] = FluxAnisotropy(mesh, places[i]) > LargestAnisotropy;
      }
    });
  const double sheared = static_cast<double>(std::count(isSheared.begin(), isSheared.end(), true));
  return places.empty() ? 0.0 : sheared / static_cast<double>(places.size());
}

}
