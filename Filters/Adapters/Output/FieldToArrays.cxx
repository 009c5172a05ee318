#include "Adapters/Output/FieldToArrays.h"

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Operators/PowerFieldDirections.h"
#include "Support/Permutations.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

constexpr int LargestN = 8;

/// The edges as lines, without points, with the angle by which the field turns across each.
vtkSmartPointer<vtkPolyData> MakeEdges(const TriangleMesh& mesh, const SurfaceNumbering& surface,
  const Vector<double>& turnings, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  const vtkIdType numberOfEdges = mesh.NumberOfEdges();
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * numberOfEdges);
  vtkIdType* const points = ends->GetPointer(0);
  context.ParallelFor(0, mesh.NumberOfEdges(), Grain,
    [&](int first, int last)
    {
      for (vtkIdType line = first; line < last; ++line)
      {
        const auto [a, b] = mesh.EdgeVertices(surface.Edges[line]);
        const auto [smaller, larger] = std::minmax({ surface.PointOf(a), surface.PointOf(b) });
        points[2 * line] = smaller;
        points[2 * line + 1] = larger;
      }
    });
  vtkNew<vtkCellArray> lines;
  lines->SetData(2, ends);
  auto edges = vtkSmartPointer<vtkPolyData>::New();
  edges->SetLines(lines);
  AddOnEdges(mesh, surface, ArrayNames::Turning, turnings, edges->GetCellData(), context);
  edges->GetCellData()->SetActiveScalars(ArrayNames::Turning);
  return edges;
}

void AddAll(vtkFieldData* arrays, vtkDataSetAttributes* attributes)
{
  for (int k = 0; k < LargestN; ++k)
  {
    attributes->RemoveArray(ArrayNames::Direction(k).c_str());
  }
  for (const std::string& name : NamesOfValues())
  {
    attributes->RemoveArray(name.c_str());
  }
  attributes->RemoveArray(ArrayNames::Prescribed);
  attributes->RemoveArray(ArrayNames::SingularityIndex);
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    attributes->AddArray(arrays->GetArray(i));
  }
  attributes->SetActiveVectors(ArrayNames::Direction(0).c_str());
}

}

FieldArrays MakeFieldArrays(const FramedMesh& framed, const SurfaceNumbering& surface,
  const Discretisation& discretisation, const Vector<double>& unknowns, const Field& field, vtkPolyData* input,
  const ExecutionContext& context)
{
  FieldArrays arrays{ vtkSmartPointer<vtkFieldData>::New(), vtkSmartPointer<vtkFieldData>::New(),
    MakeEdges(framed.Mesh, surface, field.Turning, context) };
  const auto cells = ArraysOfCells(surface, input, arrays.Cells, context);
  const auto points = ArraysOfPoints(surface, input, arrays.Points, context);
  field.AreSingularitiesOnFaces ? cells.Add(ArrayNames::SingularityIndex, 1, field.Indices.data())
                                : points.Add(ArrayNames::SingularityIndex, 1, field.Indices.data());
  cells.AddDirections(framed.Faces, field.OnFaces, field.N, field.HasUnitLength);
  context.Checkpoint(0.5);
  points.AddDirections(framed.Vertices, field.AtVertices, field.N, field.HasUnitLength);
  for (const ElementValues& values : discretisation.Values(unknowns, field.Powers))
  {
    switch (values.On)
    {
      case ElementKind::Faces:
        cells.Add(values.Name, values.Components, values.Values.data());
        break;
      case ElementKind::Vertices:
        points.Add(values.Name, values.Components, values.Values.data());
        break;
      case ElementKind::Edges:
        AddOnEdges(framed.Mesh, surface, values.Name, values.Values, arrays.Edges->GetCellData(), context);
        break;
    }
  }
  context.Checkpoint(1.0);
  return arrays;
}

void AddFieldArrays(const FieldArrays& arrays, vtkPolyData* surface, vtkPolyData* edges)
{
  AddAll(arrays.Cells, surface->GetCellData());
  AddAll(arrays.Points, surface->GetPointData());
  RemoveBasis(surface);
  edges->ShallowCopy(arrays.Edges);
  edges->SetPoints(surface->GetPoints());
}

void AddPrescribed(const SurfaceNumbering& numbering, const FieldConstraints& constraints, ElementKind elements,
  vtkPolyData* surface, vtkPolyData* edges)
{
  const bool areEdges = elements == ElementKind::Edges;
  const bool arePoints = elements == ElementKind::Vertices;
  vtkDataSetAttributes* const attributes = areEdges ? edges->GetCellData()
    : arePoints                                     ? static_cast<vtkDataSetAttributes*>(surface->GetPointData())
                                                    : surface->GetCellData();
  const vtkIdType tuples = areEdges ? edges->GetNumberOfCells()
    : arePoints                     ? surface->GetNumberOfPoints()
                                    : surface->GetNumberOfCells();
  const std::vector<int> lines = areEdges ? Inverse(numbering.Edges) : std::vector<int>();
  const auto weights = NewArray(ArrayNames::Prescribed, 1, tuples);
  weights->Fill(0.0);
  for (std::size_t i = 0; i < constraints.Elements.size(); ++i)
  {
    const int element = constraints.Elements[i];
    weights->SetValue(areEdges ? lines[element]
        : arePoints            ? numbering.PointOf(element)
                               : numbering.CellOf(element),
      constraints.Weights[i]);
  }
  attributes->AddArray(weights);
}

}
