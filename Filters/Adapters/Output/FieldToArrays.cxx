#include "Adapters/Output/FieldToArrays.h"

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Operators/PowerFieldDirections.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

constexpr int LargestN = 8;

/// The edges as lines, without points, with the angle by which the field turns across each.
vtkSmartPointer<vtkPolyData> MakeEdges(const TriangleMesh& mesh, const SurfaceRelation& surface,
  const Vector<double>& rotations, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  const vtkIdType numberOfEdges = static_cast<vtkIdType>(surface.Edges().size());
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * numberOfEdges);
  vtkIdType* const points = ends->GetPointer(0);
  context.ParallelFor(0, static_cast<int>(numberOfEdges), Grain,
    [&](int first, int last)
    {
      for (vtkIdType line = first; line < last; ++line)
      {
        const auto [a, b] = mesh.EdgeVertices(surface.Edges()[line]);
        const auto [smaller, larger] = std::minmax<vtkIdType>({ surface.PointOf(a), surface.PointOf(b) });
        points[2 * line] = smaller;
        points[2 * line + 1] = larger;
      }
    });
  vtkNew<vtkCellArray> lines;
  lines->SetData(2, ends);
  auto edges = vtkSmartPointer<vtkPolyData>::New();
  edges->SetLines(lines);
  AddOnEdges(mesh, surface, ArrayNames::Rotation, rotations, edges->GetCellData(), context);
  edges->GetCellData()->SetActiveScalars(ArrayNames::Rotation);
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
    attributes->AddArray(CopyOf(vtkDoubleArray::SafeDownCast(arrays->GetAbstractArray(i))));
  }
  attributes->SetActiveVectors(ArrayNames::Direction(0).c_str());
}

}

FieldArrays MakeFieldArrays(const FramedMesh& framed, const SurfaceRelation& surface,
  const Discretisation& discretisation, const Vector<double>& unknowns, const Field& field, vtkDataSet* input,
  const ExecutionContext& context)
{
  FieldArrays arrays{ vtkSmartPointer<vtkFieldData>::New(), vtkSmartPointer<vtkFieldData>::New(),
    MakeEdges(framed.Mesh, surface, field.Rotation, context) };
  const auto cells = ArraysOfCells(framed.Mesh, surface, input, arrays.Cells, context);
  const auto points = ArraysOfPoints(surface, input, arrays.Points, context);
  field.AreSingularitiesOnFaces ? cells.AddSums(ArrayNames::SingularityIndex, field.Indices.data())
                                : points.AddSums(ArrayNames::SingularityIndex, field.Indices.data());
  // First, so that copies of the numbers are gone before most memory is needed.
  for (const ElementValues& values : discretisation.Values(unknowns, field.Powers))
  {
    switch (values.On)
    {
      case ElementKind::Faces:
        values.Components == 2
          ? cells.AddPowers(values.Name, framed.Faces, values.Values.data(), field.OnFaces, field.N)
          : cells.Add(values.Name, values.Components, values.Values.data());
        break;
      case ElementKind::Vertices:
        points.Add(values.Name, values.Components, values.Values.data());
        break;
      case ElementKind::Edges:
        AddOnEdges(framed.Mesh, surface, values.Name, values.Values, arrays.Edges->GetCellData(), context);
        break;
    }
  }
  cells.AddDirections(framed.Faces, field.OnFaces, field.N, field.HasUnitLength);
  context.Checkpoint(0.5);
  points.AddDirections(framed.Vertices, field.AtVertices, field.N, field.HasUnitLength);
  context.Checkpoint(1.0);
  return arrays;
}

void AddFieldArrays(const FieldArrays& arrays, vtkDataSet* surface, vtkPolyData* edges)
{
  AddAll(arrays.Cells, surface->GetCellData());
  AddAll(arrays.Points, surface->GetPointData());
  RemoveBasis(surface);
  edges->ShallowCopy(arrays.Edges);
  for (int i = 0; i < arrays.Edges->GetCellData()->GetNumberOfArrays(); ++i)
  {
    edges->GetCellData()->AddArray(CopyOf(vtkDoubleArray::SafeDownCast(arrays.Edges->GetCellData()->GetArray(i))));
  }
  edges->SetPoints(PointsOf(surface));
}

void AddPrescribed(const SurfaceRelation& relation, const FieldConstraints& constraints, ElementKind elements,
  vtkDataSet* surface, vtkPolyData* edges)
{
  const bool areEdges = elements == ElementKind::Edges;
  const bool arePoints = elements == ElementKind::Vertices;
  vtkDataSetAttributes* const attributes = areEdges ? edges->GetCellData()
    : arePoints                                     ? static_cast<vtkDataSetAttributes*>(surface->GetPointData())
                                                    : surface->GetCellData();
  const vtkIdType tuples = areEdges ? edges->GetNumberOfCells()
    : arePoints                     ? surface->GetNumberOfPoints()
                                    : surface->GetNumberOfCells();
  std::vector<vtkIdType> lines; // of the edges; -1 for diagonals
  for (std::size_t line = 0; areEdges && line < relation.Edges().size(); ++line)
  {
    lines.resize(std::max<std::size_t>(lines.size(), relation.Edges()[line] + 1), -1);
    lines[relation.Edges()[line]] = static_cast<vtkIdType>(line);
  }
  const auto tupleOf = [&](int element) -> vtkIdType
  {
    return !areEdges                             ? arePoints ? relation.PointOf(element) : relation.CellOf(element)
                                  : element < static_cast<int>(lines.size()) ? lines[element]
                                                 : -1;
  };
  const auto weights = NewArray(ArrayNames::Prescribed, 1, tuples);
  weights->Fill(0.0);
  for (std::size_t i = 0; i < constraints.Elements.size(); ++i)
  {
    const bool isPinned =
      std::binary_search(constraints.Pinned.begin(), constraints.Pinned.end(), constraints.Elements[i]);
    if (const vtkIdType tuple = tupleOf(constraints.Elements[i]); tuple >= 0 && !isPinned)
    {
      weights->SetValue(tuple, std::max(weights->GetValue(tuple), constraints.Weights[i]));
    }
  }
  attributes->AddArray(weights);
}

}
