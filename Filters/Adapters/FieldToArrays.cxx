#include "Adapters/FieldToArrays.h"

#include "Adapters/BasisToArrays.h"
#include "Adapters/ElementArrays.h"
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
vtkSmartPointer<vtkPolyData> MakeEdges(
  const TriangleMesh& mesh,
  const SurfaceNumbering& surface, const Vector<double>& turnings, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  const vtkIdType numberOfEdges = mesh.NumberOfEdges();
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * numberOfEdges);
  vtkIdType* const points = ends->GetPointer(0);
  context.ParallelFor(0, mesh.NumberOfEdges(), Grain, [&](int first, int last) {
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
  context.ParallelFor(0, 2, 1, [&](int begin, int end) {
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
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    attributes->AddArray(arrays->GetArray(i));
  }
  attributes->SetActiveVectors(ArrayNames::Direction(0).c_str());
}

}

FieldArrays MakeFieldArrays(const FramedMesh& framed, const SurfaceNumbering& surface,
  const Discretisation& discretisation, const Vector<double>& unknowns, bool unitLength,
  bool combing, vtkPolyData* input, const ExecutionContext& context)
{
  const TriangleMesh& mesh = framed.Mesh;
  const int N = discretisation.DirectionsPerPoint();
  const Unfilled<Complex> sides = SideDirections(mesh, framed.Faces, context);
  const Unfilled<Corner> corners = Corners(mesh, sides, framed.Faces, framed.Vertices, context);
  const FieldPowers powers = discretisation.Powers(unknowns, corners, context);
  context.Checkpoint(0.2);
  const PrincipalMatching matching = MatchDirections(mesh, sides, powers.Faces, N, context);
  context.Checkpoint(0.4);

  FieldArrays arrays{ unitLength, combing, vtkSmartPointer<vtkFieldData>::New(),
    vtkSmartPointer<vtkFieldData>::New(), nullptr };
  const auto cells = ArraysOfCells(surface, input, arrays.Cells, context);
  const auto points = ArraysOfPoints(surface, input, arrays.Points, context);
  // A tree grows in one thread; what does not need it goes on beside.
  std::vector<int> labels;
  CallBoth(
    context,
    [&] {
      if (combing)
      {
        labels = CombingLabels(mesh, powers.Faces, matching, N, context);
      }
    },
    [&] {
      const Vector<double> indices =
        SingularityIndices(mesh, corners, matching.Turning, N, context);
      points.Add(ArrayNames::SingularityIndex, 1, indices.data());
      arrays.Edges = MakeEdges(mesh, surface, matching.Turning, context);
    });
  context.Checkpoint(0.6);
  const Vector<Complex> onFaces = FirstDirections(powers.Faces, N, labels, context);
  const Vector<Complex> atVertices = combing
    ? FirstDirectionsAtVertices(mesh, corners, onFaces, powers.Vertices, N, context)
    : FirstDirections(powers.Vertices, N, {}, context);

  cells.AddDirections(framed.Faces, onFaces, N, unitLength);
  context.Checkpoint(0.8);
  points.AddDirections(framed.Vertices, atVertices, N, unitLength);
  for (const ElementValues& values : discretisation.Values(unknowns, powers))
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
        AddOnEdges(
          mesh, surface, values.Name, values.Values, arrays.Edges->GetCellData(), context);
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

void AddPrescribed(const SurfaceNumbering& numbering, const FieldConstraints& constraints,
  ElementKind elements, vtkPolyData* surface, vtkPolyData* edges)
{
  const bool areEdges = elements == ElementKind::Edges;
  const bool arePoints = elements == ElementKind::Vertices;
  vtkDataSetAttributes* const attributes = areEdges ? edges->GetCellData()
    : arePoints ? static_cast<vtkDataSetAttributes*>(surface->GetPointData())
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
