#include "Adapters/Output/FieldToArrays.h"

#include "Adapters/Surface/ElementArrays.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Directions/PowerFieldDirections.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>

namespace dmg
{

namespace
{

/// Makes lines of the edges.
void MakeLines(const FramedSurface& on, vtkDataSet* surface, vtkPolyData* edges, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  const vtkIdType numberOfEdges = static_cast<vtkIdType>(on.Relation.Edges().size());
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * numberOfEdges);
  vtkIdType* const points = ends->GetPointer(0);
  context.ParallelFor(0, static_cast<int>(numberOfEdges), Grain,
    [&](int first, int last)
    {
      for (vtkIdType line = first; line < last; ++line)
      {
        const auto [a, b] = on.Geometry.Mesh.EdgeVertices(on.Relation.Edges()[line]);
        const auto [smaller, larger] = std::minmax<vtkIdType>({ on.Relation.PointOf(a), on.Relation.PointOf(b) });
        points[2 * line] = smaller;
        points[2 * line + 1] = larger;
      }
    });
  vtkNew<vtkCellArray> lines;
  lines->SetData(2, ends);
  edges->SetLines(lines);
  edges->SetPoints(PointsOf(surface));
}

}

void AddField(
  const SurfaceView& view, const Field& field, bool allDirections, vtkPolyData* edges, const ExecutionContext& context)
{
  const FramedSurface& on = view.Surface();
  vtkDataSet* const surface = view.Output();
  const TriangleMesh& mesh = on.Geometry.Mesh;
  MakeLines(on, surface, edges, context);
  AddOnEdges(mesh, on.Relation, ArrayNames::Rotation, field.Rotation, edges->GetCellData(), context);
  edges->GetCellData()->SetActiveScalars(ArrayNames::Rotation);
  const ArraysOfCells cells = view.OfCells(context);
  const ArraysOfPoints points = view.OfPoints(context);
  field.AreSingularitiesOnFaces ? cells.AddSums(ArrayNames::SingularityIndex, field.Indices.data())
                                : points.AddSums(ArrayNames::SingularityIndex, field.Indices.data());
  // First, so that copies of the numbers are gone before most memory is needed.
  for (const ElementValues& values : field.Solution->Discretisation->Values(field.Solution->Unknowns, field.Powers))
  {
    switch (values.On)
    {
      case ElementKind::Faces:
        values.Components == 2
          ? cells.AddPowers(values.Name, on.Geometry.Faces, values.Values.data(), field.OnFaces, field.N)
          : cells.Add(values.Name, values.Components, values.Values.data());
        break;
      case ElementKind::Vertices:
        points.Add(values.Name, values.Components, values.Values.data());
        break;
      case ElementKind::Edges:
        AddOnEdges(mesh, on.Relation, values.Name, values.Values, edges->GetCellData(), context);
        break;
    }
  }
  const DirectionVectors vectors(field.N, field.HasUnitLength, allDirections ? field.N : 1);
  cells.AddDirections(on.Geometry.Faces, field.OnFaces, vectors);
  context.Checkpoint(0.5);
  points.AddDirections(on.Geometry.Vertices, field.AtVertices, vectors);
  for (vtkDataSetAttributes* const attributes : { static_cast<vtkDataSetAttributes*>(surface->GetCellData()),
         static_cast<vtkDataSetAttributes*>(surface->GetPointData()) })
  {
    attributes->SetActiveVectors(ArrayNames::Direction(0).c_str());
  }
  context.Checkpoint(1.0);
}

void AddPrescribed(
  const SurfaceView& view, const FieldConstraints& constraints, ElementKind elements, vtkPolyData* edges)
{
  const SurfaceRelation& relation = view.Relation();
  vtkDataSet* const surface = view.Output();
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

void AddPrincipalValues(const SurfaceView& view, const ConstraintArrays& choices)
{
  vtkDataSet* const given = view.Given();
  const int components = ComponentsOf(choices.Vectors, given);
  const ChosenArray chosen =
    components > 0 ? FindArray(choices.Vectors, given, components, "directions", "the surface") : ChosenArray();
  vtkDataArray* const tensors = chosen.Array;
  if (!HoldsTensors(tensors))
  {
    return;
  }
  const bool onPoints = chosen.OnPoints();
  const FramedSurface& surface = view.Surface();
  const TangentFrames& frames = onPoints ? surface.Geometry.Vertices : surface.Geometry.Faces;
  const auto values = NewArray(ArrayNames::PrincipalValues, 2, tensors->GetNumberOfTuples());
  values->Fill(0.0);
  for (vtkIdType element = 0; element < tensors->GetNumberOfTuples(); ++element)
  {
    const ElementRow row = onPoints ? surface.Relation.VerticesOf(element) : surface.Relation.FacesOf(element);
    double numbers[9];
    tensors->GetTuple(element, numbers);
    const Eigen::Matrix3d tensor = TensorOf(numbers, tensors->GetNumberOfComponents());
    if (!row.empty() && tensor.allFinite())
    {
      values->SetTypedTuple(element, PrincipalValues(tensor, frames, row.front()).data());
    }
  }
  vtkDataSetAttributes* const attributes =
    onPoints ? static_cast<vtkDataSetAttributes*>(view.Output()->GetPointData()) : view.Output()->GetCellData();
  attributes->AddArray(values);
}

}
