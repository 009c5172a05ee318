#include "Adapters/FieldToArrays.h"

#include "HarmonicBasis.h"
#include "HarmonicForms.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldDirections.h"
#include "Support/Permutations.h"

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
#include <utility>

namespace dmg
{

namespace
{

constexpr int LargestN = 8;
constexpr int Grain = 8192;
constexpr const char* BasisPrefix = "HarmonicBasis ";

/// Its values are to be written.
vtkSmartPointer<vtkDoubleArray> NewArray(
  const std::string& name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Arrays of the cells or points of the surface: zeros where these are no elements of the mesh.
template <class ElementOf>
class ArraysOfElements
{
public:
  /// \param tuples of each array.
  /// \param elementOf the face or vertex of a tuple, or -1.
  ArraysOfElements(
    vtkFieldData* data, vtkIdType tuples, ElementOf elementOf, const ExecutionContext& context)
    : Data(data)
    , Tuples(static_cast<int>(tuples)) // MeshFromPolyData has seen to it
    , ElementOfTuple(std::move(elementOf))
    , Context(context)
  {
  }

  /// \param values of each element, one after the other.
  void Add(const std::string& name, int components, const double* values) const
  {
    double* const tuples = this->NewTuples(name, components);
    this->ForTuples([&](vtkIdType tuple, vtkIdType element) {
      std::copy_n(values + components * element, components, tuples + components * tuple);
    },
      [&](vtkIdType tuple) { std::fill_n(tuples + components * tuple, components, 0.0); });
  }

  void AddDirections(const TangentFrames& frames, const Vector<Complex>& firstDirections, int N,
    bool unitLength) const
  {
    std::vector<double*> tuples;
    for (int k = 0; k < N; ++k)
    {
      tuples.push_back(this->NewTuples(ArrayNames::Direction(k), 3));
    }
    const DirectionVectors vectors(N, unitLength);
    this->ForTuples([&](vtkIdType tuple, int element) {
      vectors.VisitAt(frames, element, firstDirections[element],
        [&](int k, const Vector3& vector) { std::copy_n(vector.data(), 3, tuples[k] + 3 * tuple); });
    },
      [&](vtkIdType tuple) {
        for (double* const direction : tuples)
        {
          std::fill_n(direction + 3 * tuple, 3, 0.0);
        }
      });
  }

  void AddPowers(const Vector<Complex>& powers) const
  {
    // std::complex is two consecutive numbers by the standard.
    this->Add(ArrayNames::PowerField, 2, reinterpret_cast<const double*>(powers.data()));
  }

private:
  double* NewTuples(const std::string& name, int components) const
  {
    const auto array = NewArray(name, components, this->Tuples);
    this->Data->AddArray(array);
    return array->GetPointer(0);
  }

  /// Arrays are written from one end to the other: what they are made from is less.
  template <class OfElement, class OfNone>
  void ForTuples(const OfElement& ofElement, const OfNone& ofNone) const
  {
    this->Context.ParallelFor(0, this->Tuples, Grain, [&](int first, int last) {
      for (int tuple = first; tuple < last; ++tuple)
      {
        if (const int element = this->ElementOfTuple(tuple); element >= 0)
        {
          ofElement(tuple, element);
        }
        else
        {
          ofNone(tuple);
        }
      }
    });
  }

  vtkFieldData* const Data;
  const int Tuples;
  const ElementOf ElementOfTuple;
  const ExecutionContext& Context;
};

auto ArraysOfCells(const SurfaceMesh& surface, vtkPolyData* input, vtkFieldData* data,
  const ExecutionContext& context)
{
  return ArraysOfElements(data, input->GetNumberOfCells(),
    [&surface](vtkIdType cell) { return surface.FaceOf(cell); }, context);
}

auto ArraysOfPoints(const SurfaceMesh& surface, vtkPolyData* input, vtkFieldData* data,
  const ExecutionContext& context)
{
  return ArraysOfElements(data, input->GetNumberOfPoints(),
    [&surface](vtkIdType point) { return surface.VertexOf(point); }, context);
}

/// Adds an array of the lines of edges: of numbers that change their sign with the edge's orientation, one per
/// edge of the mesh.
void AddOnEdges(const SurfaceMesh& surface, const std::string& name, const Vector<double>& values,
  vtkFieldData* data, const ExecutionContext& context)
{
  const int numberOfEdges = surface.Mesh.NumberOfEdges();
  const auto array = NewArray(name, 1, numberOfEdges);
  double* const tuples = array->GetPointer(0);
  context.ParallelFor(0, numberOfEdges, Grain, [&](int first, int last) {
    for (int line = first; line < last; ++line)
    {
      const int edge = surface.Edges[line];
      tuples[line] = surface.EdgeSign(edge) * values[edge];
    }
  });
  data->AddArray(array);
}

/// The edges as lines, without points, with the angle by which the field turns across each.
vtkSmartPointer<vtkPolyData> MakeEdges(
  const SurfaceMesh& surface, const Vector<double>& turnings, const ExecutionContext& context)
{
  const vtkIdType numberOfEdges = surface.Mesh.NumberOfEdges();
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * numberOfEdges);
  vtkIdType* const points = ends->GetPointer(0);
  context.ParallelFor(0, surface.Mesh.NumberOfEdges(), Grain, [&](int first, int last) {
    for (vtkIdType line = first; line < last; ++line)
    {
      const auto [a, b] = surface.Mesh.EdgeVertices(surface.Edges[line]);
      const auto [smaller, larger] = std::minmax({ surface.PointOf(a), surface.PointOf(b) });
      points[2 * line] = smaller;
      points[2 * line + 1] = larger;
    }
  });
  vtkNew<vtkCellArray> lines;
  lines->SetData(2, ends);
  auto edges = vtkSmartPointer<vtkPolyData>::New();
  edges->SetLines(lines);
  AddOnEdges(surface, ArrayNames::Turning, turnings, edges->GetCellData(), context);
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
  const Unfilled<Complex> sides = SideDirections(mesh, framed.Faces, context);
  const Unfilled<Corner> corners = Corners(mesh, sides, framed.Faces, framed.Vertices, context);
  const FieldPowers powers =
    PowersOfField(mesh, framed.Faces, framed.Vertices, corners, unknowns, options, context);
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
      arrays.Edges = MakeEdges(surface, matching.Turning, context);
    });
  context.Checkpoint(0.6);
  const Vector<Complex> onFaces = FirstDirections(powers.Faces, N, labels, context);
  const Vector<Complex> atVertices = combing
    ? FirstDirectionsAtVertices(mesh, corners, onFaces, powers.Vertices, N, context)
    : FirstDirections(powers.Vertices, N, {}, context);

  cells.AddDirections(framed.Faces, onFaces, N, unitLength);
  context.Checkpoint(0.8);
  points.AddDirections(framed.Vertices, atVertices, N, unitLength);
  switch (options.Kind)
  {
    case Discretisation::PowerField:
      cells.AddPowers(powers.Faces);
      points.AddPowers(powers.Vertices);
      break;
    case Discretisation::FaceField:
      cells.Add(ArrayNames::FaceField, 3, VectorsFromFaceField(framed.Faces, unknowns).data());
      break;
    case Discretisation::OneForm:
      AddOnEdges(
        surface, ArrayNames::OneForm, unknowns, arrays.Edges->GetCellData(), context);
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

BasisArrays MakeBasisArrays(const FramedSurface& framed, Discretisation kind,
  Eigen::MatrixXd known, vtkPolyData* input, const ExecutionContext& context)
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
  if (known.cols() == 0)
  {
    const PartOfContext part(context, 0.0, 0.6);
    known = isOneForm ? HarmonicForms(mesh, part) : HarmonicFaceFields(mesh, framed.Faces, part);
  }
  const PartOfContext rest(context, 0.6, 0.9);
  const Eigen::MatrixXd basis = isOneForm
    ? HarmonicBasisOfForms(mesh, framed.Faces, std::move(known), rest)
    : HarmonicBasisOfFaceFields(mesh, std::move(known), rest);
  const auto cells = ArraysOfCells(surface, input, arrays.Cells, context);
  for (int k = 0; k < loops; ++k)
  {
    context.Checkpoint(0.9 + 0.1 * k / loops);
    const Vector<double> field = basis.col(k);
    const std::string name = ArrayNames::HarmonicBasis(k + 1);
    const Points vectors = isOneForm ? WhitneyAtFaces(mesh, field, context)
                                     : VectorsFromFaceField(framed.Faces, field);
    cells.Add(name, 3, vectors.data());
    if (isOneForm)
    {
      AddOnEdges(surface, name, field, arrays.Edges, context);
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
  const bool isOneForm = kind == Discretisation::OneForm;
  const std::vector<int> lines = isOneForm ? Inverse(surface.Edges) : std::vector<int>();
  const auto weights = NewArray(ArrayNames::Prescribed, 1, output->GetNumberOfCells());
  weights->Fill(0.0);
  for (std::size_t i = 0; i < constraints.Elements.size(); ++i)
  {
    const int element = constraints.Elements[i];
    weights->SetValue(
      isOneForm ? lines[element] : surface.CellOf(element), constraints.Weights[i]);
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
