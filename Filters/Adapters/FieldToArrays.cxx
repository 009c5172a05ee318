#include "Adapters/FieldToArrays.h"

#include "HarmonicBasis.h"
#include "HarmonicForms.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldOperators.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dmg
{

namespace
{

constexpr int LargestN = 8;
constexpr const char* BasisPrefix = "HarmonicBasis ";

vtkSmartPointer<vtkDoubleArray> NewArray(const std::string& name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  return array;
}

/// Adds an array with values for the elements of the mesh; the other tuples hold zeros.
/// \param id the tuple of element i.
template <class Id>
void AddArray(vtkFieldData* data, const std::string& name, vtkIdType tuples, int components,
  const double* values, int elements, Id&& id)
{
  const auto array = NewArray(name, components, tuples);
  for (int i = 0; i < elements; ++i, values += components)
  {
    std::copy_n(values, components, array->GetPointer(components * id(i)));
  }
  data->AddArray(array);
}

/// Directions of powers.
template <class Id>
void AddDirections(vtkFieldData* data, vtkIdType tuples, const TangentFrames& frames,
  const Vector<Complex>& powers, int N, bool unitLength, const std::vector<int>& labels, Id&& id)
{
  const int elements = static_cast<int>(powers.size());
  const std::vector<Points> directions =
    DirectionsFromPowers(frames, powers, N, unitLength, labels);
  for (int k = 0; k < N; ++k)
  {
    AddArray(data, ArrayNames::Direction(k), tuples, 3, directions[k].data(), elements, id);
  }
}

template <class Id>
void AddPowers(vtkFieldData* data, vtkIdType tuples, const Vector<Complex>& powers, Id&& id)
{
  // std::complex is two consecutive numbers by the standard.
  AddArray(data, ArrayNames::PowerField, tuples, 2, reinterpret_cast<const double*>(powers.data()),
    static_cast<int>(powers.size()), id);
}

/// The edges as lines, without points, with the angle by which the field turns across each.
vtkSmartPointer<vtkPolyData> MakeEdges(
  const FramedSurface& framed, const Vector<Complex>& powers, int N)
{
  const TriangleMesh& mesh = framed.Surface.Mesh;
  const vtkIdType numberOfEdges = mesh.NumberOfEdges();
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * numberOfEdges);
  const auto turning = NewArray(ArrayNames::Turning, 1, numberOfEdges);
  for (vtkIdType edge = 0; edge < numberOfEdges; ++edge)
  {
    const auto& vertices = mesh.EdgeVertices(static_cast<int>(edge));
    ends->SetValue(2 * edge, framed.Surface.PointOf(vertices[0]));
    ends->SetValue(2 * edge + 1, framed.Surface.PointOf(vertices[1]));
    const int left = mesh.HalfedgeOf(static_cast<int>(edge));
    const int right = mesh.Twin(left);
    if (right >= 0)
    {
      const Complex carried = powers[TriangleMesh::FaceOf(left)] *
        std::polar(1.0, N * TransportAcrossEdge(mesh, framed.Faces, left));
      turning->SetValue(
        edge, std::arg(powers[TriangleMesh::FaceOf(right)] * std::conj(carried)) / N);
    }
  }
  vtkNew<vtkCellArray> lines;
  lines->SetData(2, ends);
  auto edges = vtkSmartPointer<vtkPolyData>::New();
  edges->SetLines(lines);
  edges->GetCellData()->SetScalars(turning);
  return edges;
}

/// Calls all functions, at the same time where there are threads.
void CallAll(const ExecutionContext& context, const std::vector<std::function<void()>>& functions)
{
  context.ParallelFor(0, static_cast<int>(functions.size()), 1,
    [&functions](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        functions[i]();
      }
    });
}

void AddAll(vtkFieldData* arrays, vtkDataSetAttributes* attributes)
{
  for (int k = 0; k < LargestN; ++k)
  {
    attributes->RemoveArray(ArrayNames::Direction(k).c_str());
  }
  attributes->RemoveArray(ArrayNames::PowerField);
  attributes->RemoveArray(ArrayNames::FaceField);
  attributes->RemoveArray(ArrayNames::Prescribed);
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    attributes->AddArray(arrays->GetArray(i));
  }
  attributes->SetActiveVectors(ArrayNames::Direction(0).c_str());
}

/// Takes away the basis that an earlier solver left, of any size.
void RemoveBasis(vtkPolyData* surface)
{
  vtkCellData* const cells = surface->GetCellData();
  for (int i = cells->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const char* const chars = cells->GetArrayName(i);
    const std::string name = chars ? chars : "";
    const std::string prefix = BasisPrefix;
    if (name.size() > prefix.size() && name.compare(0, prefix.size(), prefix) == 0 &&
      name.find_first_not_of("0123456789", prefix.size()) == std::string::npos)
    {
      cells->RemoveArray(i);
    }
  }
  surface->GetFieldData()->RemoveArray(ArrayNames::HarmonicBasisSize);
}

template <class ArrayType, class Value>
void AddValue(vtkFieldData* fieldData, const char* name, const Value& value)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fieldData->AddArray(array);
}

}

std::string ArrayNames::Direction(int k)
{
  return "Direction" + std::to_string(k);
}

std::string ArrayNames::HarmonicBasis(int k)
{
  return BasisPrefix + std::to_string(k);
}

std::string ArrayNames::Prolongation(const std::string& name, int level, const std::string& part)
{
  return ProlongationPrefix + name + "." + std::to_string(level) + "." + part;
}

FieldArrays MakeFieldArrays(const FramedSurface& framed, const Vector<double>& unknowns,
  const FieldOptions& options, bool unitLength, bool combing, vtkPolyData* input,
  const ExecutionContext& context)
{
  const SurfaceMesh& surface = framed.Surface;
  const TriangleMesh& mesh = surface.Mesh;
  const int N = options.NumberOfDirections();
  const FieldPowers powers =
    PowersOfField(mesh, framed.Faces, framed.Vertices, unknowns, options);
  context.Checkpoint(0.2);

  Vector<double> indices;
  std::vector<int> faceLabels, vertexLabels;
  FieldArrays arrays{ unitLength, combing, vtkSmartPointer<vtkFieldData>::New(),
    vtkSmartPointer<vtkFieldData>::New(), nullptr };
  CallAll(context,
    { [&] { indices = SingularityIndices(mesh, framed.Faces, powers.Faces, N); },
      [&]
      {
        if (combing)
        {
          faceLabels = CombingLabels(mesh, framed.Faces, powers.Faces, N);
        }
      } });
  context.Checkpoint(0.4);

  if (combing)
  {
    vertexLabels = VertexLabels(
      mesh, framed.Faces, framed.Vertices, powers.Faces, faceLabels, powers.Vertices, N);
  }
  context.Checkpoint(0.6);

  const auto cellOf = [&surface](int face) { return surface.CellOf(face); };
  const auto pointOf = [&surface](int vertex) { return surface.PointOf(vertex); };
  const vtkIdType numberOfCells = input->GetNumberOfCells();
  const vtkIdType numberOfPoints = input->GetNumberOfPoints();
  CallAll(context,
    { [&] { arrays.Edges = MakeEdges(framed, powers.Faces, N); },
      [&]
      {
        AddDirections(arrays.Cells, numberOfCells, framed.Faces, powers.Faces, N, unitLength,
          faceLabels, cellOf);
      },
      [&]
      {
        AddDirections(arrays.Points, numberOfPoints, framed.Vertices, powers.Vertices, N,
          unitLength, vertexLabels, pointOf);
        AddArray(arrays.Points, ArrayNames::SingularityIndex, numberOfPoints, 1, indices.data(),
          static_cast<int>(indices.size()), pointOf);
      } });
  switch (options.Kind)
  {
    case Discretisation::PowerField:
      AddPowers(arrays.Cells, numberOfCells, powers.Faces, cellOf);
      AddPowers(arrays.Points, numberOfPoints, powers.Vertices, pointOf);
      break;
    case Discretisation::FaceField:
      AddArray(arrays.Cells, ArrayNames::FaceField, numberOfCells, 3,
        VectorsFromFaceField(framed.Faces, unknowns).data(), mesh.NumberOfFaces(), cellOf);
      break;
    case Discretisation::OneForm:
      AddArray(arrays.Edges->GetCellData(), ArrayNames::OneForm, mesh.NumberOfEdges(), 1,
        unknowns.data(), mesh.NumberOfEdges(), [](int edge) { return edge; });
      break;
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

BasisArrays MakeBasisArrays(const FramedSurface& framed, Discretisation kind, vtkPolyData* input,
  const ExecutionContext& context)
{
  const SurfaceMesh& surface = framed.Surface;
  const TriangleMesh& mesh = surface.Mesh;
  context.Checkpoint(0.0);
  const int loops = NumberOfLoops(mesh);
  BasisArrays arrays{ kind, loops, AreTooManyToHold(loops, mesh),
    vtkSmartPointer<vtkFieldData>::New(), vtkSmartPointer<vtkFieldData>::New() };
  if (loops == 0 || arrays.TooMany)
  {
    return arrays;
  }
  const bool isOneForm = kind == Discretisation::OneForm;
  const PartOfContext most(context, 0.0, 0.9);
  const Eigen::MatrixXd basis = isOneForm ? HarmonicBasisOfForms(mesh, framed.Faces, most)
                                          : HarmonicBasisOfFaceFields(mesh, framed.Faces, most);
  const auto cellOf = [&surface](int face) { return surface.CellOf(face); };
  for (int k = 0; k < loops; ++k)
  {
    context.Checkpoint(0.9 + 0.1 * k / loops);
    const Vector<double> field = basis.col(k);
    const std::string name = ArrayNames::HarmonicBasis(k + 1);
    const Points vectors =
      isOneForm ? WhitneyAtFaces(mesh, field) : VectorsFromFaceField(framed.Faces, field);
    AddArray(arrays.Cells, name, input->GetNumberOfCells(), 3, vectors.data(),
      mesh.NumberOfFaces(), cellOf);
    if (isOneForm)
    {
      AddArray(arrays.Edges, name, mesh.NumberOfEdges(), 1, field.data(), mesh.NumberOfEdges(),
        [](int edge) { return edge; });
    }
  }
  context.Checkpoint(1.0);
  return arrays;
}

void AddBasisArrays(const BasisArrays& arrays, vtkPolyData* surface, vtkPolyData* edges)
{
  const auto add = [](vtkFieldData* from, vtkFieldData* to)
  {
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      to->AddArray(from->GetArray(i));
    }
  };
  add(arrays.Cells, surface->GetCellData());
  add(arrays.Edges, edges->GetCellData());
}

void AddBasisSize(const BasisArrays& arrays, vtkFieldData* fieldData)
{
  AddValue<vtkIntArray>(
    fieldData, ArrayNames::HarmonicBasisSize, arrays.Cells->GetNumberOfArrays());
}

void AddPrescribed(const SurfaceMesh& surface, const FieldConstraints& constraints,
  Discretisation kind, vtkPolyData* output)
{
  const auto weights = NewArray(ArrayNames::Prescribed, 1, output->GetNumberOfCells());
  for (std::size_t i = 0; i < constraints.Elements.size(); ++i)
  {
    const int element = constraints.Elements[i];
    weights->SetValue(kind == Discretisation::OneForm ? element : surface.CellOf(element),
      constraints.Weights[i]);
  }
  output->GetCellData()->AddArray(weights);
}

void MakeConvergenceTable(const SolveReport& report, vtkTable* table)
{
  const vtkIdType size = static_cast<vtkIdType>(report.Iterations.size());
  vtkNew<vtkIntArray> iterations;
  iterations->SetName(ArrayNames::Iteration);
  iterations->SetNumberOfValues(size);
  table->Initialize();
  table->AddColumn(iterations);
  const auto addColumn = [&](const char* name, double IterationReport::*value)
  {
    const auto column = NewArray(name, 1, size);
    for (vtkIdType i = 0; i < size; ++i)
    {
      column->SetValue(i, report.Iterations[i].*value);
    }
    table->AddColumn(column);
  };
  for (vtkIdType i = 0; i < size; ++i)
  {
    iterations->SetValue(i, report.Iterations[i].Iteration);
  }
  addColumn(ArrayNames::Seconds, &IterationReport::Seconds);
  addColumn(ArrayNames::RelativeResidual, &IterationReport::RelativeResidual);
  addColumn(ArrayNames::Energy, &IterationReport::Energy);
  addColumn(ArrayNames::MassResidual, &IterationReport::MassResidual);
  if (size > 0 && !std::isnan(report.Iterations.back().Error))
  {
    addColumn(ArrayNames::Error, &IterationReport::Error);
  }
}

void AddReport(const SolveReport& report, int N, double setupSeconds, vtkFieldData* fieldData)
{
  const vtkIdType levels = static_cast<vtkIdType>(report.Levels.size());
  const auto unknowns = NewArray(ArrayNames::LevelUnknowns, 1, levels);
  const auto nonZeros = NewArray(ArrayNames::LevelNonZeros, 1, levels);
  for (vtkIdType level = 0; level < levels; ++level)
  {
    unknowns->SetValue(level, static_cast<double>(report.Levels[level].Unknowns));
    nonZeros->SetValue(level, static_cast<double>(report.Levels[level].NonZeros));
  }
  AddValue<vtkIntArray>(fieldData, ArrayNames::NumberOfDirections, N);
  AddValue<vtkStringArray>(fieldData, ArrayNames::Solver, report.Solver);
  AddValue<vtkIntArray>(fieldData, ArrayNames::Converged, report.Converged ? 1 : 0);
  fieldData->AddArray(unknowns);
  fieldData->AddArray(nonZeros);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::OperatorComplexity, report.OperatorComplexity());
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SetupSeconds, setupSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::PrepareSeconds, report.PrepareSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SolveSeconds, report.SolveSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SolverBytes, static_cast<double>(report.Bytes));
}

}
