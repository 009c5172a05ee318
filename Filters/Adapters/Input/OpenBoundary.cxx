#include "Adapters/Input/OpenBoundary.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

namespace dmg
{

std::vector<char> OpenEdgesOf(const ChosenArray& choice, FlowBoundary otherwise, const SurfaceView& view)
{
  const TriangleMesh& mesh = view.Mesh();
  const ChosenArray chosen = FindArray(choice, view.Given(), 1, "open boundary", "the surface");
  if (!chosen.Array)
  {
    return OpenEdges(mesh, otherwise);
  }
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
        ? isOpenAt(view.Relation().PointOf(mesh.Tail(h))) && isOpenAt(view.Relation().PointOf(mesh.Head(h)))
        : isOpenAt(view.Relation().CellOf(TriangleMesh::FaceOf(h)));
    }
  }
  return isOpen;
}

}
