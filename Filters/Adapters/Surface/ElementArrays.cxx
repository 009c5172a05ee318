#include "Adapters/Surface/ElementArrays.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace dmg
{

vtkSmartPointer<vtkDoubleArray> NewArray(const std::string& name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  // Arrays of ParaView's VTK end the process where there is no memory; this throws.
  const vtkIdType size = components * tuples;
  auto* const values = static_cast<double*>(std::malloc(std::max<vtkIdType>(size, 1) * sizeof(double)));
  if (!values)
  {
    throw std::bad_alloc();
  }
  array->SetArray(values, size, 0, vtkDoubleArray::VTK_DATA_ARRAY_FREE);
  return array;
}

void AddOnEdges(const TriangleMesh& mesh, const SurfaceNumbering& surface, const std::string& name,
  const Vector<double>& values, vtkFieldData* data, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  const int numberOfEdges = mesh.NumberOfEdges();
  const auto array = NewArray(name, 1, numberOfEdges);
  double* const tuples = array->GetPointer(0);
  context.ParallelFor(0, numberOfEdges, Grain,
    [&](int first, int last)
    {
      for (int line = first; line < last; ++line)
      {
        const int edge = surface.Edges[line];
        tuples[line] = surface.EdgeSign(mesh, edge) * values[edge];
      }
    });
  data->AddArray(array);
}

void AddHidden(vtkFieldData* fieldData, vtkAbstractArray* array)
{
  array->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
  fieldData->AddArray(array);
}

}
