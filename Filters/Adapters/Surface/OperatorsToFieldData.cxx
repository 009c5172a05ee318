#include "Adapters/Surface/OperatorsToFieldData.h"

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Support/Errors.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace dmg
{

namespace
{

constexpr int CurrentFormat = 2;
constexpr int NumberOfOptions = 8;

bool IsOfProlongation(const char* name)
{
  const char* const prefix = ArrayNames::ProlongationPrefix;
  return name && std::strncmp(name, prefix, std::strlen(prefix)) == 0;
}

/// The options of an origin beside the digest, in the order of the properties of
/// vtkDirectionalProlongation.
std::array<double, NumberOfOptions> NumbersOf(const OperatorsOrigin& origin)
{
  const HierarchyOptions& options = origin.Options;
  const OperatorSelection& selection = origin.Selection;
  return { options.FaceRatio, static_cast<double>(options.MaximumNumberOfCoarseLevels),
    static_cast<double>(options.MinimumNumberOfFaces), static_cast<double>(options.Policy),
    static_cast<double>(options.Construction), static_cast<double>(selection.PowerFields),
    static_cast<double>(selection.FaceFields), static_cast<double>(selection.OneForms) };
}

// Writing
// ------------------------------------------------------------------------------------------

template <class ArrayType, class Value>
void AddValues(
  vtkFieldData* fieldData, const std::string& name, const Value* values, std::size_t tuples, int components = 1)
{
  vtkNew<ArrayType> array;
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  std::copy_n(values, components * tuples, array->GetPointer(0));
  array->SetName(name.c_str());
  AddHidden(fieldData, array);
}

/// A number as VTK stores it: one component if real, two if complex.
constexpr int Components(double)
{
  return 1;
}
constexpr int Components(Complex)
{
  return 2;
}

template <class Scalar>
void AddOperator(vtkFieldData* fieldData, const std::string& name, int level, const SparseMatrix<Scalar>& matrix)
{
  AddValues<vtkIntArray>(
    fieldData, ArrayNames::Prolongation(name, level, "Offsets"), matrix.outerIndexPtr(), matrix.rows() + 1);
  AddValues<vtkIntArray>(
    fieldData, ArrayNames::Prolongation(name, level, "Columns"), matrix.innerIndexPtr(), matrix.nonZeros());
  AddValues<vtkDoubleArray>(fieldData, ArrayNames::Prolongation(name, level, "Values"),
    reinterpret_cast<const double*>(matrix.valuePtr()), matrix.nonZeros(), Components(Scalar()));
}

// Reading
// ------------------------------------------------------------------------------------------

[[noreturn]] void Refuse(const std::string& name, const std::string& what)
{
  throw InvalidInput("field array '" + name + "' " + what +
    "; remove the damaged operators or apply Directional Prolongation (vtkDirectionalProlongation) again");
}

template <class ArrayType>
ArrayType* Find(vtkFieldData* fieldData, const std::string& name, int components = 1)
{
  vtkAbstractArray* const found = fieldData->GetAbstractArray(name.c_str());
  if (!found)
  {
    Refuse(name, "is missing");
  }
  auto* const array = ArrayType::SafeDownCast(found);
  if (!array || array->GetNumberOfComponents() != components)
  {
    Refuse(name, "has another type or number of components than it was written with");
  }
  return array;
}

/// One value per row and non-zero, checked but for the values.
struct Pattern
{
  std::vector<int> Offsets;
  std::vector<int> Columns;
};

Pattern ReadPattern(vtkFieldData* fieldData, const std::string& name, int level, int rows, int columns)
{
  const std::string offsetsName = ArrayNames::Prolongation(name, level, "Offsets");
  const std::string columnsName = ArrayNames::Prolongation(name, level, "Columns");
  auto* const offsets = Find<vtkIntArray>(fieldData, offsetsName);
  auto* const indices = Find<vtkIntArray>(fieldData, columnsName);
  if (offsets->GetNumberOfValues() != static_cast<vtkIdType>(rows) + 1)
  {
    Refuse(offsetsName,
      "has " + std::to_string(offsets->GetNumberOfValues()) + " entries for " + std::to_string(rows) + " rows");
  }
  Pattern pattern;
  pattern.Offsets.assign(offsets->GetPointer(0), offsets->GetPointer(0) + rows + 1);
  if (pattern.Offsets.front() != 0 || pattern.Offsets.back() != indices->GetNumberOfValues() ||
    !std::is_sorted(pattern.Offsets.begin(), pattern.Offsets.end()))
  {
    Refuse(offsetsName,
      "does not rise from 0 to the " + std::to_string(indices->GetNumberOfValues()) + " columns that are stored");
  }
  pattern.Columns.assign(indices->GetPointer(0), indices->GetPointer(0) + indices->GetNumberOfValues());
  for (int row = 0; row < rows; ++row)
  {
    int previous = -1;
    for (int i = pattern.Offsets[row]; i < pattern.Offsets[row + 1]; ++i)
    {
      if (pattern.Columns[i] <= previous || pattern.Columns[i] >= columns)
      {
        Refuse(columnsName,
          "holds " + std::to_string(pattern.Columns[i]) + " at " + std::to_string(i) +
            ", out of range or out of order");
      }
      previous = pattern.Columns[i];
    }
  }
  return pattern;
}

enum class ValueKind
{
  Weights, ///< their absolute values sum to 1 in every row
  Any,
};

template <class Scalar>
const Scalar* ReadValues(
  vtkFieldData* fieldData, const std::string& name, int level, const Pattern& pattern, ValueKind kind)
{
  const std::string valuesName = ArrayNames::Prolongation(name, level, "Values");
  auto* const array = Find<vtkDoubleArray>(fieldData, valuesName, Components(Scalar()));
  if (array->GetNumberOfTuples() != static_cast<vtkIdType>(pattern.Columns.size()))
  {
    Refuse(valuesName,
      "has " + std::to_string(array->GetNumberOfTuples()) + " entries for " + std::to_string(pattern.Columns.size()) +
        " columns");
  }
  const Scalar* const values = reinterpret_cast<const Scalar*>(array->GetPointer(0));
  // Generous, so that operators that went through a text format pass.
  const double tolerance = 1e-4;
  for (std::size_t row = 0; row + 1 < pattern.Offsets.size(); ++row)
  {
    double sum = 0.0;
    for (int i = pattern.Offsets[row]; i < pattern.Offsets[row + 1]; ++i)
    {
      sum += std::abs(values[i]);
    }
    if (!std::isfinite(sum))
    {
      Refuse(valuesName, "holds a value in row " + std::to_string(row) + " that is not finite");
    }
    if (kind == ValueKind::Weights && !(std::abs(sum - 1.0) <= tolerance))
    {
      Refuse(valuesName, "holds weights of row " + std::to_string(row) + " that do not sum to 1");
    }
  }
  return values;
}

template <class Scalar>
SparseMatrix<Scalar> ReadOperator(vtkFieldData* fieldData, const std::string& name, int level, int rows, int columns,
  ValueKind kind = ValueKind::Weights)
{
  const Pattern pattern = ReadPattern(fieldData, name, level, rows, columns);
  return Eigen::Map<const SparseMatrix<Scalar>>(rows, columns, static_cast<int>(pattern.Columns.size()),
    pattern.Offsets.data(), pattern.Columns.data(), ReadValues<Scalar>(fieldData, name, level, pattern, kind));
}

std::vector<int> ReadSizes(vtkFieldData* fieldData, const std::string& name, int finest)
{
  auto* const array = Find<vtkIntArray>(fieldData, name);
  std::vector<int> sizes(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
  if (sizes.empty() || sizes.front() != finest || !std::is_sorted(sizes.rbegin(), sizes.rend()) || sizes.back() < 1)
  {
    Refuse(name, "does not descend from the size of the surface, " + std::to_string(finest));
  }
  return sizes;
}

}

bool OperatorsOrigin::operator==(const OperatorsOrigin& other) const
{
  return this->Digest == other.Digest && NumbersOf(*this) == NumbersOf(other);
}

void OperatorsToFieldData(
  const ProlongationOperators& operators, const OperatorsOrigin& origin, vtkFieldData* fieldData)
{
  AddValues<vtkIntArray>(fieldData, ArrayNames::ProlongationFormat, &CurrentFormat, 1);
  AddHidden(fieldData, NewValue<vtkStringArray>(ArrayNames::ProlongationDigest, origin.Digest));
  AddValues<vtkDoubleArray>(fieldData, ArrayNames::ProlongationOptions, NumbersOf(origin).data(), NumberOfOptions);
  const auto addSizes = [fieldData](const char* name, const std::vector<int>& sizes)
  { AddValues<vtkIntArray>(fieldData, name, sizes.data(), sizes.size()); };
  addSizes(ArrayNames::NumbersOfVertices, operators.NumbersOfVertices);
  addSizes(ArrayNames::NumbersOfEdges, operators.NumbersOfEdges);
  addSizes(ArrayNames::NumbersOfFaces, operators.NumbersOfFaces);
  const auto addAll = [fieldData](const char* name, const auto& matrices)
  {
    for (std::size_t level = 0; level < matrices.size(); ++level)
    {
      AddOperator(fieldData, name, static_cast<int>(level), matrices[level]);
    }
  };
  addAll("S0", operators.S0);
  addAll("S1", operators.S1);
  addAll("SX", operators.SX);
  addAll("SP", operators.SP);
  addAll("Nodal", operators.Linear);
}

void RelationToFieldData(const SurfaceRelation& relation, const TriangleMesh& mesh, vtkFieldData* fieldData)
{
  std::vector<int> cells(mesh.NumberOfFaces()), points(mesh.NumberOfVertices());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    cells[face] = relation.CellOf(face);
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    points[vertex] = relation.PointOf(vertex);
  }
  AddValues<vtkIntArray>(fieldData, ArrayNames::CellsOfFaces, cells.data(), cells.size());
  AddValues<vtkIntArray>(fieldData, ArrayNames::PointsOfVertices, points.data(), points.size());
}

void RemoveOperators(vtkFieldData* fieldData)
{
  for (int i = fieldData->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (IsOfProlongation(fieldData->GetAbstractArray(i)->GetName()))
    {
      fieldData->RemoveArray(i);
    }
  }
}

std::optional<OperatorsOrigin> OperatorsOriginOf(vtkFieldData* fieldData)
{
  bool any = false;
  for (int i = 0; fieldData && i < fieldData->GetNumberOfArrays(); ++i)
  {
    any = any || IsOfProlongation(fieldData->GetAbstractArray(i)->GetName());
  }
  if (!any)
  {
    return std::nullopt;
  }

  auto* const format = Find<vtkIntArray>(fieldData, ArrayNames::ProlongationFormat);
  if (format->GetNumberOfValues() != 1 || format->GetValue(0) != CurrentFormat)
  {
    Refuse(ArrayNames::ProlongationFormat, "is not " + std::to_string(CurrentFormat) + ", the format of this version");
  }
  auto* const digest = Find<vtkStringArray>(fieldData, ArrayNames::ProlongationDigest);
  if (digest->GetNumberOfValues() != 1)
  {
    Refuse(ArrayNames::ProlongationDigest, "is not one value");
  }
  auto* const options = Find<vtkDoubleArray>(fieldData, ArrayNames::ProlongationOptions);
  const bool areOptions = options->GetNumberOfValues() == NumberOfOptions &&
    std::all_of(options->GetPointer(0), options->GetPointer(0) + NumberOfOptions,
      [](double value) { return value >= 0.0 && value <= std::numeric_limits<int>::max(); });
  if (!areOptions)
  {
    Refuse(ArrayNames::ProlongationOptions, "does not hold " + std::to_string(NumberOfOptions) + " options");
  }
  OperatorsOrigin origin;
  origin.Digest = digest->GetValue(0);
  origin.Options.FaceRatio = options->GetValue(0);
  origin.Options.MaximumNumberOfCoarseLevels = static_cast<int>(options->GetValue(1));
  origin.Options.MinimumNumberOfFaces = static_cast<int>(options->GetValue(2));
  origin.Options.Policy = static_cast<CollapsePolicy>(static_cast<int>(options->GetValue(3)));
  origin.Options.Construction = static_cast<ProlongationConstruction>(static_cast<int>(options->GetValue(4)));
  origin.Selection.PowerFields = options->GetValue(5) != 0.0;
  origin.Selection.FaceFields = options->GetValue(6) != 0.0;
  origin.Selection.OneForms = options->GetValue(7) != 0.0;
  return origin;
}

ProlongationOperators OperatorsFromFieldData(vtkFieldData* fieldData, const TriangleMesh& mesh)
{
  const OperatorSelection selection = OperatorsOriginOf(fieldData).value().Selection;
  ProlongationOperators operators;
  operators.NumbersOfVertices = ReadSizes(fieldData, ArrayNames::NumbersOfVertices, mesh.NumberOfVertices());
  operators.NumbersOfEdges = ReadSizes(fieldData, ArrayNames::NumbersOfEdges, mesh.NumberOfEdges());
  operators.NumbersOfFaces = ReadSizes(fieldData, ArrayNames::NumbersOfFaces, mesh.NumberOfFaces());
  const std::vector<int>& vertices = operators.NumbersOfVertices;
  const std::vector<int>& edges = operators.NumbersOfEdges;
  const std::vector<int>& faces = operators.NumbersOfFaces;
  if (vertices.size() != faces.size())
  {
    Refuse(ArrayNames::NumbersOfVertices, "has another number of levels than that of faces");
  }
  if (edges.size() != faces.size())
  {
    Refuse(ArrayNames::NumbersOfEdges, "has another number of levels than that of faces");
  }
  for (int l = 0; l + 1 < operators.NumberOfLevels(); ++l)
  {
    operators.S0.push_back(ReadOperator<double>(fieldData, "S0", l, vertices[l], vertices[l + 1]));
    if (selection.OneForms)
    {
      operators.S1.push_back(ReadOperator<double>(fieldData, "S1", l, edges[l], edges[l + 1], ValueKind::Any));
    }
    if (selection.FaceFields)
    {
      operators.SX.push_back(ReadOperator<double>(fieldData, "SX", l, 2 * faces[l], 2 * faces[l + 1], ValueKind::Any));
    }
    if (selection.PowerFields)
    {
      operators.SP.push_back(ReadOperator<Complex>(fieldData, "SP", l, faces[l], faces[l + 1]));
    }
    operators.Linear.push_back(
      ReadOperator<Complex>(fieldData, "Nodal", l, l == 0 ? faces[0] : vertices[l], vertices[l + 1]));
  }
  return operators;
}

}
