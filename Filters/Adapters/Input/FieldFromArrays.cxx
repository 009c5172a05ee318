#include "Adapters/Input/FieldFromArrays.h"

#include "Adapters/Input/ChosenVectors.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/View/ChosenArrays.h"
#include "Adapters/View/EastAndNorth.h"
#include "Adapters/View/FillValues.h"
#include "Adapters/View/HiddenGaps.h"
#include "Directions/CellDirections.h"
#include "Directions/GapsOfField.h"
#include "Directions/SignFlips.h"
#include "Mesh/NormalParts.h"
#include "Support/Errors.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// A vector that leans out of the normal by less than this (as a sine) has no tangential part.
constexpr double SmallestTangentialPart = 1e-6;

/// The tolerance of the angles between directions of a cell, 2 pi / N: single precision, rounded some times.
constexpr double LargestAngle = 1e-3;

/// The principal direction of a tensor.
Complex ReadTensor(vtkDataArray* array, vtkIdType tuple, const TangentFrames& frames, int element)
{
  std::array<double, 9> numbers;
  array->GetTuple(tuple, numbers.data());
  const Eigen::Matrix3d tensor = TensorOf(numbers.data(), array->GetNumberOfComponents());
  return tensor.allFinite() ? frames.ToComplex(element, PrincipalDirection(tensor, frames, element))
                            : Complex(std::numeric_limits<double>::infinity());
}

/// The tangential part of a vector, or infinity where it is not finite.
Complex TangentialPart(const Vector3& vector, Complex inPlane)
{
  return std::abs(inPlane) > SmallestTangentialPart * vector.stableNorm() ? inPlane
    : vector.allFinite()                                                  ? Complex(0.0)
                         : Complex(std::numeric_limits<double>::infinity());
}

/// The vector of a tuple.
Vector3 ReadVector(vtkDataArray* array, vtkIdType tuple)
{
  Vector3 vector = Vector3::Zero();
  array->GetTuple(tuple, vector.data());
  return vector;
}

/// The direction of a vertex.
Complex ReadVertex(vtkDataArray* array, vtkIdType point, const FramedMesh& surface, int vertex)
{
  if (HoldsTensors(array))
  {
    return ReadTensor(array, point, surface.Vertices, vertex);
  }
  const Vector3 vector = ReadVector(array, point);
  const Vector3 tangential = WithoutNormalPart(surface.Mesh, surface.Vertices, vertex, vector);
  return TangentialPart(vector, surface.Vertices.ToComplex(vertex, tangential));
}

/// Arrays of cells, read on the faces.
class CellsOnFaces
{
public:
  CellsOnFaces(const FramedSurface& surface, const ExecutionContext& context)
    : Relation(surface.Relation)
    , Mesh(surface.Geometry.Mesh)
    , Frames(surface.Geometry.Faces)
    , Normals(NormalsOfCells(surface.Geometry.Mesh, surface.Geometry.Faces, surface.Relation, context))
  {
  }

  Complex Read(vtkDataArray* array, int face) const
  {
    const int cell = this->Relation.CellOf(face);
    if (HoldsTensors(array))
    {
      return ReadTensor(array, cell, this->Frames, face);
    }
    const Vector3 vector = ReadVector(array, cell);
    const Vector3 tangential = WithoutNormalPartOfCell(this->Mesh, this->Relation, face, vector);
    return TangentialPart(vector,
      this->Normals.rows() == 0 ? this->Frames.ToComplex(face, tangential)
                                : OnFaceOfCell(this->Frames, face, this->Normals.row(face), tangential));
  }

  const SurfaceRelation& Relation;

private:
  const TriangleMesh& Mesh;
  const TangentFrames& Frames;
  const Points Normals; ///< of the cells
};

bool IsFinite(Complex number)
{
  return std::isfinite(number.real()) && std::isfinite(number.imag());
}

/// Directions of elements; zero where they are not finite, of which \p left counts the tuples.
template <class Read, class TupleOf>
Vector<Complex> ReadTuples(
  const Read& read, int size, const TupleOf& tupleOf, std::set<vtkIdType>& left, const ExecutionContext& context)
{
  Vector<Complex> directions(size);
  std::atomic<bool> areFinite{ true };
  context.ParallelFor(0, size, Grain,
    [&](int first, int last)
    {
      for (int element = first; element < last; ++element)
      {
        const Complex direction = read(element);
        directions[element] = direction;
        if (!IsFinite(direction))
        {
          areFinite = false;
        }
      }
    });
  for (int element = 0; !areFinite && element < size; ++element)
  {
    if (!IsFinite(directions[element]))
    {
      left.insert(tupleOf(element));
      directions[element] = 0.0;
    }
  }
  return directions;
}

Vector<Complex> ReadVertices(
  vtkDataArray* array, const FramedSurface& surface, std::set<vtkIdType>& left, const ExecutionContext& context)
{
  const auto pointOf = [&surface](int vertex) { return surface.Relation.PointOf(vertex); };
  return ReadTuples([&](int vertex) { return ReadVertex(array, pointOf(vertex), surface.Geometry, vertex); },
    surface.Geometry.Mesh.NumberOfVertices(), pointOf, left, context);
}

/// Refuses arrays Direction1, ... that are not Direction0, turned either way: fields of pieces are as their cells are.
void CheckSiblings(
  vtkDataSet* input, const CellsOnFaces& cells, const Vector<Complex>& first, int N, const ExecutionContext& context)
{
  for (int k = 1; k < N; ++k)
  {
    vtkDataArray* const array = input->GetCellData()->GetArray(ArrayNames::Direction(k).c_str());
    if (!array || array->GetNumberOfComponents() != 3)
    {
      continue;
    }
    CheckTuples(array, input, vtkDataObject::CELL);
    const Complex turn = std::polar(1.0, 2.0 * Pi * k / N);
    const auto areAlike = [](Complex one, Complex other) {
      return std::abs(one / std::max(std::abs(one), 1e-300) - other / std::max(std::abs(other), 1e-300)) <=
        LargestAngle;
    };
    const auto isTurned = [&](int face)
    {
      const Complex given = cells.Read(array, face);
      if (!IsFinite(given))
      {
        return first[face] == 0.0;
      }
      return areAlike(given, turn * first[face]) || areAlike(given, std::conj(turn) * first[face]);
    };
    std::atomic<bool> areTurned{ true };
    context.ParallelFor(0, static_cast<int>(first.size()), Grain,
      [&](int begin, int end)
      {
        for (int face = begin; face < end; ++face)
        {
          if (!isTurned(face))
          {
            areTurned = false;
          }
        }
      });
    for (vtkIdType cell = 0; !areTurned && cell < input->GetNumberOfCells(); ++cell)
    {
      const ElementRow faces = cells.Relation.FacesOf(cell);
      if (!std::all_of(faces.begin(), faces.end(), isTurned))
      {
        throw InvalidInput("the vectors Direction0 and " + ArrayNames::Direction(k) + " of cell " +
          std::to_string(cell) + " are not " + std::to_string(360 * k / N) + " degrees apart, as those of a field of " +
          std::to_string(N) + " directions are; draw one array at a time, with 1 as Number Of Directions");
      }
    }
  }
}

double DiagonalOf(const TriangleMesh& mesh)
{
  const Points& positions = mesh.VertexPositions();
  return (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
}

/// Warns of directions that are not finite.
void CheckLeft(vtkAlgorithm* algorithm, const ChosenArray& chosen, const std::set<vtkIdType>& left)
{
  if (!left.empty())
  {
    vtkWarningWithObjectMacro(algorithm, << "array '" << NameOf(chosen.Array) << "' is not finite at " << left.size()
                                         << (chosen.OnPoints() ? " points" : " cells") << ", as at " << *left.begin()
                                         << ", where nothing is drawn; make it zero where there is no direction");
  }
}

/// Whether filters of this module have found the vectors. Fields of solvers are combed, and transported vectors have the signs of their sources;
/// neither have fill values.
bool IsOurs(const std::string& name)
{
  return name == ArrayNames::Direction(0) || name == ArrayNames::TransportedVectors;
}

/// Warns where vectors flip as axes do.
void CheckSign(vtkAlgorithm* algorithm, const ChosenArray& chosen, const TriangleMesh& mesh,
  const TangentFrames& frames, const Vector<Complex>& directions)
{
  const std::string name = NameOf(chosen.Array);
  if (!IsOurs(name) && FlipsLikeAxes(mesh, frames, directions, chosen.OnPoints()))
  {
    vtkWarningWithObjectMacro(
      algorithm, << "array '" << name
                 << "' seems to have no sign, as it flips from one element to the next; choose 2 as "
                    "Number Of Directions");
  }
}

/// The directions of an array, brought to the faces.
struct ReadDirections
{
  ReadDirections(const FramedSurface& surface, const ChosenArray& chosen, int N, const ExecutionContext& context)
  {
    const TriangleMesh& mesh = surface.Geometry.Mesh;
    if (chosen.OnPoints())
    {
      this->OfVertices = ReadVertices(chosen.Array, surface, this->Left, context);
      this->First =
        FirstDirectionsOfFaces(mesh, surface.Geometry.Faces, surface.Geometry.Vertices, this->OfVertices, N, context);
      return;
    }
    const CellsOnFaces cells(surface, context);
    this->First = ReadTuples([&](int face) { return cells.Read(chosen.Array, face); }, mesh.NumberOfFaces(),
      [&](int face) { return surface.Relation.CellOf(face); }, this->Left, context);
  }

  Vector<Complex> First;      ///< of faces
  Vector<Complex> OfVertices; ///< of an array of points
  std::set<vtkIdType> Left;   ///< tuples that are not finite
};

/// Takes cells without a direction out of the surface, unless there are no others.
/// \return whether there are some.
bool HideGaps(SurfaceView& view, const Vector<Complex>& first)
{
  const std::vector<char> isGap = CellsWithoutDirection(view.Relation(), first, view.Data()->GetNumberOfCells());
  bool isSome = false, isAll = true;
  for (int face = 0; face < first.size(); ++face)
  {
    isSome = isSome || isGap[view.Relation().CellOf(face)];
    isAll = isAll && isGap[view.Relation().CellOf(face)];
  }
  view.TakeIf<HiddenGaps>(isSome && !isAll, isGap);
  return isSome && !isAll;
}

/// Warns of vectors that have no sign, and refuses directions that do not belong together.
void CheckRead(vtkAlgorithm* algorithm, vtkDataSet* input, const ChosenArray& chosen, const FramedSurface& surface,
  const ReadDirections& read, int N, bool areSiblings, const ExecutionContext& context)
{
  if (N == 1)
  {
    CheckSign(algorithm, chosen, surface.Geometry.Mesh,
      chosen.OnPoints() ? surface.Geometry.Vertices : surface.Geometry.Faces,
      chosen.OnPoints() ? read.OfVertices : read.First);
  }
  if (areSiblings && !chosen.OnPoints())
  {
    CheckSiblings(input, CellsOnFaces(surface, context), read.First, N, context);
  }
}

}

SurfaceWithField ReadField(
  vtkAlgorithm* algorithm, SurfaceView& view, int N, const ExecutionContext& context, GapsInField gaps)
{
  vtkDataSet* const input = view.Given();
  const ChosenArray chosen = ChooseVectors(algorithm, input);
  const int numberByName = NumberOfDirections(input, chosen);
  const bool areSiblings = NameOf(chosen.Array) == ArrayNames::Direction(0) && (N == 0 || N == numberByName);
  N = N == 0 ? numberByName : N;
  if (N % 2 == 1 && HoldsTensors(chosen.Array))
  {
    throw InvalidInput("array '" + NameOf(chosen.Array) +
      "' holds tensors, whose principal directions have no sign; choose 2 or 4 as Number Of Directions");
  }
  view.Prepare(PreparationOf(input), context);
  context.Checkpoint(0.5);
  if (const std::string problem = ProblemOfPlaneVectors(chosen.Array, view.Mesh().VertexPositions()); !problem.empty())
  {
    throw WrongChoice(problem);
  }
  ReadDirections read(view.Surface(), chosen, N, context);
  const std::set<vtkIdType> left = read.Left;
  if (gaps == GapsInField::AreHoles)
  {
    FillLoneCells(view.Surface().Geometry, view.Relation(), read.First);
    if (HideGaps(view, read.First))
    {
      view.Prepare(PreparationOf(input), context);
      read = ReadDirections(view.Surface(), chosen, N, context);
      FillLoneCells(view.Surface().Geometry, view.Relation(), read.First);
    }
  }
  CheckRead(algorithm, input, chosen, view.Surface(), read, N, areSiblings, context);
  if (read.First.isZero(0.0))
  {
    throw WrongChoice("array '" + NameOf(chosen.Array) +
      "' has no direction on any triangle, its vectors are zero, not finite or perpendicular to the surface; "
      "choose another");
  }
  if (!IsOurs(NameOf(chosen.Array)))
  {
    const vtkIdType tuples = input->GetNumberOfElements(chosen.Association);
    Warn(algorithm, { SuspectedFillValues({ chosen.Array }, tuples, "array '" + NameOf(chosen.Array) + "'") });
  }
  CheckLeft(algorithm, chosen, left);
  context.Checkpoint(1.0);
  const double diagonal = DiagonalOf(view.Mesh());
  DirectionsOnFaces field(N, read.First, context);
  const bool isAtPoints = IsFieldAtPoints(input, chosen) && N == numberByName;
  return { view, std::move(field), diagonal, isAtPoints };
}

FieldAtVertices ReadFieldAtPoints(const SurfaceWithField& given, const ExecutionContext& context)
{
  vtkDataSet* const input = given.View.Given();
  vtkDataArray* const array = input->GetPointData()->GetArray(ArrayNames::Direction(0).c_str());
  CheckTuples(array, input, vtkDataObject::POINT);
  std::set<vtkIdType> left; // those of the cells were counted
  const FramedSurface& surface = given.View.Surface();
  return { VertexConnection(surface.Geometry, context), ReadVertices(array, surface, left, context) };
}

Points ReferenceVectors(
  vtkAlgorithm* algorithm, const ChosenArray& choice, const SurfaceView& view, const Vector3& otherwise)
{
  const TriangleMesh& mesh = view.Mesh();
  Points references(mesh.NumberOfFaces(), 3);
  if (const VectorArrays arrays({ choice }, view.Given(), "reference vectors", "the surface"); !arrays.AreNone())
  {
    Warn(algorithm, { SuspectedFillValues(arrays.Arrays(), arrays.NumberOfTuples(view.Given()), "reference vectors") });
    VectorsOnSurface vectors = view.Vectors(arrays);
    vectors.TakeOutNormalParts(mesh, view.Relation());
    references = vectors.OnFaces(mesh);
  }
  else
  {
    references.rowwise() = UnitAxis(otherwise, ", or choose Reference Vectors").transpose();
  }
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (!references.row(face).allFinite())
    {
      throw InvalidInput("the reference vector of cell " + std::to_string(view.Relation().CellOf(face)) +
        " is not finite; repair it, or choose other vectors or Axis");
    }
  }
  return references;
}

}
