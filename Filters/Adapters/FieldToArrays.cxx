#include "Adapters/FieldToArrays.h"

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
#include <functional>

namespace dmg
{

namespace
{

constexpr int LargestN = 8;

vtkSmartPointer<vtkDoubleArray> NewArray(
  const std::string& name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  return array;
}

/// Where mesh elements of one kind stand in a vtkPolyData; the other elements keep zeros.
struct Attribute
{
  vtkDataSetAttributes* Data;
  vtkIdType Size;
  std::function<vtkIdType(int)> Id; // element to tuple

  void Add(const std::string& name, const double* values, int components, int elements) const
  {
    const auto array = NewArray(name, components, this->Size);
    for (int i = 0; i < elements; ++i, values += components)
    {
      std::copy_n(values, components, array->GetPointer(components * this->Id(i)));
    }
    this->Data->AddArray(array);
  }

  void AddPowers(const TangentFrames& frames, const Vector<Complex>& powers, int N, bool unitLength,
    const std::vector<int>& labels) const
  {
    const int elements = static_cast<int>(powers.size());
    // std::complex is two consecutive numbers by the standard.
    this->Add(
      ArrayNames::PowerField, reinterpret_cast<const double*>(powers.data()), 2, elements);
    const std::vector<Points> directions =
      DirectionsFromPowers(frames, powers, N, unitLength, labels);
    for (int k = 0; k < N; ++k)
    {
      this->Add(ArrayNames::Direction(k), directions[k].data(), 3, elements);
    }
    for (int k = N; k < LargestN; ++k)
    {
      this->Data->RemoveArray(ArrayNames::Direction(k).c_str());
    }
    this->Data->SetActiveVectors(ArrayNames::Direction(0).c_str());
  }
};

Attribute CellsOf(const SurfaceMesh& surface, vtkPolyData* output)
{
  return { output->GetCellData(), output->GetNumberOfCells(),
    [&surface](int face) { return surface.CellOf(face); } };
}

Attribute PointsOf(const SurfaceMesh& surface, vtkPolyData* output)
{
  return { output->GetPointData(), output->GetNumberOfPoints(),
    [&surface](int vertex) { return surface.PointOf(vertex); } };
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

std::string ArrayNames::Prolongation(const std::string& name, int level, const std::string& part)
{
  return ProlongationPrefix + name + "." + std::to_string(level) + "." + part;
}

void AddPowerField(const FramedSurface& framed, const Vector<Complex>& powers, int N, bool unitLength,
  bool combed, vtkPolyData* output)
{
  const TriangleMesh& mesh = framed.Surface.Mesh;
  const Vector<Complex> vertexPowers =
    PowersAtVertices(mesh, framed.Faces, framed.Vertices, powers, N);
  std::vector<int> faceLabels, vertexLabels;
  if (combed)
  {
    faceLabels = CombingLabels(mesh, framed.Faces, powers, N);
    vertexLabels =
      VertexLabels(mesh, framed.Faces, framed.Vertices, powers, faceLabels, vertexPowers, N);
  }
  const Attribute cells = CellsOf(framed.Surface, output);
  const Attribute points = PointsOf(framed.Surface, output);
  cells.AddPowers(framed.Faces, powers, N, unitLength, faceLabels);
  points.AddPowers(framed.Vertices, vertexPowers, N, unitLength, vertexLabels);
  points.Add(ArrayNames::SingularityIndex,
    SingularityIndices(mesh, framed.Faces, powers, N).data(), 1, mesh.NumberOfVertices());
}

void AddPrescribed(
  const SurfaceMesh& surface, const PrescribedFaces& prescribed, vtkPolyData* output)
{
  const auto weights = NewArray(ArrayNames::Prescribed, 1, output->GetNumberOfCells());
  for (std::size_t i = 0; i < prescribed.Faces.size(); ++i)
  {
    weights->SetValue(surface.CellOf(prescribed.Faces[i]), prescribed.Weights[i]);
  }
  output->GetCellData()->AddArray(weights);
}

void MakeEdges(const FramedSurface& framed, const Vector<Complex>& powers, int N, vtkPolyData* input,
  vtkPolyData* edges)
{
  const TriangleMesh& mesh = framed.Surface.Mesh;
  const int numberOfEdges = mesh.NumberOfEdges();
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * static_cast<vtkIdType>(numberOfEdges));
  const auto turning = NewArray(ArrayNames::Turning, 1, numberOfEdges);
  for (int edge = 0; edge < numberOfEdges; ++edge)
  {
    const auto& vertices = mesh.EdgeVertices(edge);
    ends->SetValue(2 * static_cast<vtkIdType>(edge), framed.Surface.PointOf(vertices[0]));
    ends->SetValue(2 * static_cast<vtkIdType>(edge) + 1, framed.Surface.PointOf(vertices[1]));
    const int left = mesh.HalfedgeOf(edge);
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
  edges->SetPoints(input->GetPoints());
  edges->SetLines(lines);
  edges->GetCellData()->SetScalars(turning);
}

void MakeConvergenceTable(const SolveReport& report, vtkTable* table)
{
  const vtkIdType size = static_cast<vtkIdType>(report.Iterations.size());
  vtkNew<vtkIntArray> iterations;
  iterations->SetName(ArrayNames::Iteration);
  iterations->SetNumberOfValues(size);
  const auto seconds = NewArray(ArrayNames::Seconds, 1, size);
  const auto residuals = NewArray(ArrayNames::RelativeResidual, 1, size);
  for (vtkIdType i = 0; i < size; ++i)
  {
    const IterationReport& row = report.Iterations[i];
    iterations->SetValue(i, row.Iteration);
    seconds->SetValue(i, row.Seconds);
    residuals->SetValue(i, row.RelativeResidual);
  }
  table->Initialize();
  table->AddColumn(iterations);
  table->AddColumn(seconds);
  table->AddColumn(residuals);
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
  AddValue<vtkDoubleArray>(
    fieldData, ArrayNames::OperatorComplexity, report.OperatorComplexity());
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SetupSeconds, setupSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::PrepareSeconds, report.PrepareSeconds);
  AddValue<vtkDoubleArray>(fieldData, ArrayNames::SolveSeconds, report.SolveSeconds);
  AddValue<vtkDoubleArray>(
    fieldData, ArrayNames::SolverBytes, static_cast<double>(report.Bytes));
}

}
