#include "Adapters/Output/BasisToArrays.h"

#include "Adapters/Surface/ElementArrays.h"

#include "vtkCellData.h"

#include <string>

namespace dmg
{

namespace
{

/// Takes away a basis of any size.
void RemoveBasis(vtkDataSet* surface)
{
  vtkCellData* const cells = surface->GetCellData();
  for (int i = cells->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const char* const chars = cells->GetArrayName(i);
    const std::string name = chars ? chars : "";
    const std::string prefix = ArrayNames::HarmonicBasisPrefix;
    if (name.size() > prefix.size() && name.compare(0, prefix.size(), prefix) == 0 &&
      name.find_first_not_of("0123456789", prefix.size()) == std::string::npos)
    {
      cells->RemoveArray(i);
    }
  }
}

}

void AddBasis(
  const FramedSurface& on, const Field& field, vtkDataSet* surface, vtkPolyData* edges, const ExecutionContext& context)
{
  RemoveBasis(surface);
  if (!field.HarmonicBasis)
  {
    return;
  }
  const Discretisation& discretisation = *field.Solution->Discretisation;
  const auto fields = static_cast<int>(field.HarmonicBasis->cols());
  const ArraysOfCells cells(on.Geometry.Mesh, on.Relation, surface, surface->GetCellData(), context);
  for (int k = 0; k < fields; ++k)
  {
    context.Checkpoint(static_cast<double>(k) / fields);
    const Vector<double> harmonic = field.HarmonicBasis->col(k);
    const std::string name = ArrayNames::HarmonicBasis(k + 1);
    cells.Add(name, 3, discretisation.VectorsOnFaces(harmonic, context).data());
    if (discretisation.Elements() == ElementKind::Edges)
    {
      AddOnEdges(on.Geometry.Mesh, on.Relation, name, harmonic, edges->GetCellData(), context);
    }
  }
  context.Checkpoint(1.0);
}

}
