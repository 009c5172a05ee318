#ifndef dmgTestPreparedSurfaces_h
#define dmgTestPreparedSurfaces_h

#include "Preparation/PreparedSurface.h"
#include "Support/MeshFactory.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <set>
#include <vector>

namespace dmg::test
{

inline CellTriangles TrianglesOf(const Surface& surface)
{
  return { surface.V, surface.F, 0, static_cast<int>(surface.F.rows()), {}, {} };
}

inline PreparedSurface Prepared(const Surface& surface, const PreparationOptions& options = {})
{
  return PrepareSurface(TrianglesOf(surface), options);
}

inline PolygonSurface Polygons(const Points& positions, const std::vector<std::vector<int>>& polygons)
{
  PolygonSurface surface;
  surface.Positions = positions;
  for (const std::vector<int>& polygon : polygons)
  {
    surface.Corners.insert(surface.Corners.end(), polygon.begin(), polygon.end());
    surface.Offsets.push_back(static_cast<int>(surface.Corners.size()));
  }
  return surface;
}

/// Triangles that share no points.
inline Surface Soup(const Surface& surface)
{
  Surface soup;
  soup.F.resize(surface.F.rows(), 3);
  soup.V.resize(3 * surface.F.rows(), 3);
  for (int i = 0; i < soup.F.size(); ++i)
  {
    soup.F.data()[i] = i;
    soup.V.row(i) = surface.V.row(surface.F.data()[i]);
  }
  return soup;
}

/// The faces between voxels.
enum class Interfaces
{
  Both, ///< of each of the voxels
  Left, ///< out
};

/// Unit cubes with points in common, their normals outwards.
inline Surface Voxels(const std::vector<std::array<int, 3>>& voxels, Interfaces interfaces = Interfaces::Both)
{
  std::map<std::array<int, 3>, int> points;
  std::vector<std::array<int, 4>> quads;
  for (const std::array<int, 3>& voxel : voxels)
  {
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, side = face % 2;
      std::array<int, 3> beyond = voxel;
      beyond[axis] += 2 * side - 1;
      if (interfaces == Interfaces::Left && std::find(voxels.begin(), voxels.end(), beyond) != voxels.end())
      {
        continue;
      }
      std::array<int, 4> quad;
      for (int k = 0; k < 4; ++k)
      {
        std::array<int, 3> corner = voxel;
        corner[axis] += side;
        corner[(axis + 1) % 3] += (k == 1 || k == 2) ? 1 : 0;
        corner[(axis + 2) % 3] += k >= 2 ? 1 : 0;
        quad[side ? k : 3 - k] = points.emplace(corner, static_cast<int>(points.size())).first->second;
      }
      quads.push_back(quad);
    }
  }
  Surface surface;
  surface.V.resize(static_cast<Eigen::Index>(points.size()), 3);
  surface.F.resize(2 * static_cast<Eigen::Index>(quads.size()), 3);
  for (const auto& [place, point] : points)
  {
    surface.V.row(point) << place[0], place[1], place[2];
  }
  for (std::size_t q = 0; q < quads.size(); ++q)
  {
    const auto smallest = std::min_element(quads[q].begin(), quads[q].end()) - quads[q].begin();
    const auto at = [&](std::ptrdiff_t k)
    { return quads[q][(smallest + k) % 4]; }; // one diagonal for both sides of a face
    surface.F.row(2 * static_cast<Eigen::Index>(q)) << at(0), at(1), at(2);
    surface.F.row(2 * static_cast<Eigen::Index>(q) + 1) << at(0), at(2), at(3);
  }
  return surface;
}

inline int NumberOfBoundaryEdges(const TriangleMesh& mesh)
{
  return static_cast<int>(std::count(mesh.HalfedgeTwins().begin(), mesh.HalfedgeTwins().end(), -1));
}

inline int NumberOfComponents(const TriangleMesh& mesh)
{
  const std::vector<int> components = FaceComponents(mesh);
  return 1 + *std::max_element(components.begin(), components.end());
}

inline std::vector<int> Items(const ElementRow& row)
{
  return { row.begin(), row.end() };
}

}

#endif
