#include "Adapters/Output/BasisToArrays.h"

#include "Adapters/Surface/ElementArrays.h"

#include "vtkCellData.h"

#include <string>

namespace dmg
{

void AddBasis(const SurfaceView& view, const Field& field, vtkPolyData* edges, const ExecutionContext& context)
{
  if (!field.HarmonicBasis)
  {
    return;
  }
  const Discretisation& discretisation = *field.Solution->Discretisation;
  const auto fields = static_cast<int>(field.HarmonicBasis->cols());
  const ArraysOfCells cells = view.OfCells(context);
  for (int k = 0; k < fields; ++k)
  {
    context.Checkpoint(static_cast<double>(k) / fields);
    const Vector<double> harmonic = field.HarmonicBasis->col(k);
    const std::string name = ArrayNames::HarmonicBasis(k + 1);
    cells.AddVectors(name, discretisation.VectorsOnFaces(harmonic, context).data());
    if (discretisation.Elements() == ElementKind::Edges)
    {
      AddOnEdges(view.Mesh(), view.Relation(), name, harmonic, edges->GetCellData(), context);
    }
  }
  context.Checkpoint(1.0);
}

}
