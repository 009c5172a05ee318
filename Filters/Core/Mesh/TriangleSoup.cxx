#include "Mesh/TriangleSoup.h"

#include <algorithm>
#include <array>
#include <vector>

namespace dmg
{

namespace
{

/// The number of different places of the vertices of a mesh.
std::ptrdiff_t NumberOfPlaces(const TriangleMesh& mesh)
{
  std::vector<std::array<double, 3>> places;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const Vector3 place = mesh.Position(vertex);
    places.push_back({ place[0], place[1], place[2] });
  }
  std::sort(places.begin(), places.end());
  return std::unique(places.begin(), places.end()) - places.begin();
}

}

bool IsSoup(const TriangleMesh& mesh)
{
  const int sides = 3 * mesh.NumberOfFaces();
  int alone = 0;
  for (int side = 0; side < sides; ++side)
  {
    alone += mesh.Twin(side) < 0;
  }
  return 2 * alone > sides && 2 * NumberOfPlaces(mesh) < mesh.NumberOfVertices();
}

}
