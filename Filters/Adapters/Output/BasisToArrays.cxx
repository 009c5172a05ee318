#include "Adapters/Output/BasisToArrays.h"

#include "Adapters/Surface/ElementArrays.h"

#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"

#include <string>

namespace dmg
{

BasisArrays MakeBasisArrays(const FramedMesh& framed, const SurfaceRelation& surface,
  const Discretisation& discretisation, const Eigen::MatrixXd& basis, vtkDataSet* input,
  const ExecutionContext& context)
{
  const auto fields = static_cast<int>(basis.cols());
  BasisArrays arrays{ vtkSmartPointer<vtkFieldData>::New(), vtkSmartPointer<vtkFieldData>::New() };
  const auto cells = ArraysOfCells(framed.Mesh, surface, input, arrays.Cells, context);
  for (int k = 0; k < fields; ++k)
  {
    context.Checkpoint(static_cast<double>(k) / fields);
    const Vector<double> field = basis.col(k);
    const std::string name = ArrayNames::HarmonicBasis(k + 1);
    cells.Add(name, 3, discretisation.VectorsOnFaces(field, context).data());
    if (discretisation.Elements() == ElementKind::Edges)
    {
      AddOnEdges(framed.Mesh, surface, name, field, arrays.Edges, context);
    }
  }
  context.Checkpoint(1.0);
  return arrays;
}

void AddBasisArrays(const BasisArrays& arrays, vtkDataSet* surface, vtkPolyData* edges)
{
  const auto add = [](vtkFieldData* from, vtkFieldData* to)
  {
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      to->AddArray(CopyOf(vtkDoubleArray::SafeDownCast(from->GetAbstractArray(i))));
    }
  };
  add(arrays.Cells, surface->GetCellData());
  add(arrays.Edges, edges->GetCellData());
}

void AddBasisSize(const BasisArrays& arrays, vtkFieldData* fieldData)
{
  vtkNew<vtkIntArray> size;
  size->SetName(ArrayNames::HarmonicBasisSize);
  size->InsertNextValue(arrays.Cells->GetNumberOfArrays());
  AddHidden(fieldData, size);
}

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
  surface->GetFieldData()->RemoveArray(ArrayNames::HarmonicBasisSize);
}

}
