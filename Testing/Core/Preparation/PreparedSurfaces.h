#ifndef dmgTestPreparedSurfaces_h
#define dmgTestPreparedSurfaces_h

#include "Preparation/PreparedSurface.h"
#include "Support/MeshFactory.h"

#include <algorithm>
#include <initializer_list>
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
