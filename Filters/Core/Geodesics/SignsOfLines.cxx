#include "Geodesics/SignsOfLines.h"

#include "Support/DisjointSets.h"

#include <algorithm>
#include <vector>

namespace dmg
{

std::optional<Vector<double>> SignsOf(const TriangleMesh& mesh, const SplitSurface& split)
{
  const int faces = mesh.NumberOfFaces();
  DisjointSets parts(faces);
  for (int h = 0; h < 3 * faces; ++h)
  {
    if (mesh.Twin(h) >= 0 && split.SideOf(h) == SplitSurface::Unknown)
    {
      parts.Unite(TriangleMesh::FaceOf(h), TriangleMesh::FaceOf(mesh.Twin(h)));
    }
  }
  std::vector<char> sides(faces, SplitSurface::Unknown); // by part
  bool isAny = false;
  for (int h = 0; h < 3 * faces; ++h)
  {
    sides[parts.Smallest(TriangleMesh::FaceOf(h))] |= split.SideOf(h);
    isAny |= split.SideOf(h) != SplitSurface::Unknown;
  }
  if (!isAny || std::count(sides.begin(), sides.end(), SplitSurface::Both) > 0)
  {
    return {};
  }
  Vector<double> signs(faces);
  for (int face = 0; face < faces; ++face)
  {
    signs[face] = sides[parts.Smallest(face)] == SplitSurface::Inside ? -1.0 : 1.0;
  }
  return signs;
}

}
