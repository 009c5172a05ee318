#include "Adapters/Input/OpenBoundary.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

namespace dmg
{

std::vector<char> OpenEdgesOf(const ChosenArray& choice, vtkDataSet* input, const FramedSurface& surface)
{
  const ChosenArray chosen = FindArray(choice, input, 1, "open boundary", "the surface");
  if (!chosen.Array)
  {
    return {};
  }
  const TriangleMesh& mesh = surface.Geometry.Mesh;
  const auto isOpenAt = [&chosen](vtkIdType element)
  {
    const double number = chosen.Array->GetComponent(element, 0);
    return number < 0.0 || number > 0.0;
  };
  std::vector<char> isOpen(mesh.NumberOfEdges(), 0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (mesh.Twin(h) < 0)
    {
      isOpen[mesh.EdgeOf(h)] = chosen.OnPoints()
        ? isOpenAt(surface.Relation.PointOf(mesh.Tail(h))) && isOpenAt(surface.Relation.PointOf(mesh.Head(h)))
        : isOpenAt(surface.Relation.CellOf(TriangleMesh::FaceOf(h)));
    }
  }
  return isOpen;
}

}
