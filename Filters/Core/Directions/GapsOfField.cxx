#include "Directions/GapsOfField.h"

#include "Mesh/TangentFrames.h"

namespace dmg
{

void FillLoneCells(const FramedMesh& surface, const SurfaceRelation& relation, Vector<Complex>& first)
{
  const Vector<Complex> given = first;
  for (int face = 0; face < given.size(); ++face)
  {
    if (given[face] != 0.0)
    {
      continue;
    }
    const int cell = relation.CellOf(face);
    int beside = -1;
    bool isAlone = true;
    for (const int part : relation.FacesOf(cell))
    {
      surface.Mesh.VisitNeighbours(part,
        [&](int neighbour)
        {
          const bool isOutside = relation.CellOf(neighbour) != cell;
          isAlone = isAlone && !(isOutside && given[neighbour] == 0.0);
          beside = isOutside ? neighbour : beside;
        });
    }
    if (isAlone && beside >= 0)
    {
      first[face] = TransportTurn(surface.Faces, beside, surface.Faces, face) * given[beside];
    }
  }
}

std::vector<char> CellsWithoutDirection(const SurfaceRelation& relation, const Vector<Complex>& first, long long cells)
{
  std::vector<char> isWithout(cells, 0);
  for (int face = 0; face < first.size(); ++face)
  {
    if (first[face] == 0.0)
    {
      isWithout[relation.CellOf(face)] = 1;
    }
  }
  return isWithout;
}

}
