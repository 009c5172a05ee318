#include "Adapters/Output/FieldToArrays.h"

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Operators/PowerFieldDirections.h"
#include "Operators/VertexFieldTopology.h"
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

/// Calls two functions, at the same time where there are threads.
template <class First, class Second>
void CallBoth(const ExecutionContext& context, const First& first, const Second& second)
{
  context.ParallelFor(0, 2, 1,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        i == 0 ? first() : second();
      }
    });
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

ShownField ShowField(const FramedMesh& framed, const SurfaceNumbering& surface, const Discretisation& discretisation,
  const Vector<double>& unknowns, bool combing, const ShownField* former, const ExecutionContext& context)
{
  const TriangleMesh& mesh = framed.Mesh;
  const int N = discretisation.DirectionsPerPoint();
  const Unfilled<Complex> sides = SideDirections(mesh, framed.Faces, context);
  const Unfilled<Corner> corners = Corners(mesh, sides, framed.Faces, framed.Vertices, context);
  ShownField shown;
  shown.Combing = combing;
  shown.N = N;
  shown.Powers = discretisation.Powers(unknowns, corners, context);
  const Vector<Complex>& powers = shown.Powers.Faces;
  context.Checkpoint(0.3);
  const PrincipalMatching matching = MatchDirections(mesh, sides, powers, N, context);
  context.Checkpoint(0.6);

  std::vector<int> labels;
  if (combing && former && former->Combing && former->N == N)
  {
    labels = LabelsNearTo(former->OnFaces, powers, N, context);
  }
  // A tree grows in one thread; what does not need it goes on beside.
  CallBoth(
    context,
    [&]
    {
      if (combing && labels.empty())
      {
        labels = CombingLabels(mesh, powers, matching, N, context);
      }
    },
    [&]
    {
      if (const VertexConnection* const connection = discretisation.ConnectionOfPowers(context))
      {
        const Vector<double> turning = TurningAlongEdges(mesh, *connection, shown.Powers.Vertices, N, context);
        shown.AreSingularitiesOnFaces = true;
        shown.Indices = IndicesOfFaces(mesh, *connection, turning, N, context);
        shown.Edges = MakeEdges(mesh, surface, turning, context);
        return;
      }
      shown.Indices = SingularityIndices(mesh, corners, matching.Turning, N, context);
      shown.Edges = MakeEdges(mesh, surface, matching.Turning, context);
    });
  shown.OnFaces = FirstDirections(powers, N, labels, context);
  shown.AtVertices = combing
    ? FirstDirectionsAtVertices(mesh, corners, shown.OnFaces, shown.Powers.Vertices, N, context)
    : FirstDirections(shown.Powers.Vertices, N, {}, context);
  context.Checkpoint(1.0);
  return shown;
}

FieldArrays MakeFieldArrays(const FramedMesh& framed, const SurfaceNumbering& surface,
  const Discretisation& discretisation, const Vector<double>& unknowns, const ShownField& shown, bool unitLength,
  vtkPolyData* input, const ExecutionContext& context)
{
  FieldArrays arrays{ unitLength, vtkSmartPointer<vtkFieldData>::New(), vtkSmartPointer<vtkFieldData>::New(),
    vtkSmartPointer<vtkPolyData>::New() };
  arrays.Edges->ShallowCopy(shown.Edges);
  const auto cells = ArraysOfCells(surface, input, arrays.Cells, context);
  const auto points = ArraysOfPoints(surface, input, arrays.Points, context);
  shown.AreSingularitiesOnFaces ? cells.Add(ArrayNames::SingularityIndex, 1, shown.Indices.data())
                                : points.Add(ArrayNames::SingularityIndex, 1, shown.Indices.data());
  cells.AddDirections(framed.Faces, shown.OnFaces, shown.N, unitLength);
  context.Checkpoint(0.5);
  points.AddDirections(framed.Vertices, shown.AtVertices, shown.N, unitLength);
  for (const ElementValues& values : discretisation.Values(unknowns, shown.Powers))
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
