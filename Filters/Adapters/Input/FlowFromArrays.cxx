#include "Adapters/Input/FlowFromArrays.h"

#include "Adapters/Data/HiddenCells.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Mesh/Globe.h"
#include "Mesh/PositiveSide.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

using Tuple = std::vector<double>;

/// The elements of which a number is NaN.
std::vector<char> WithoutFlow(const std::vector<vtkDataArray*>& arrays, vtkIdType elements)
{
  std::vector<char> isNaN(elements, 0);
  for (vtkDataArray* const array : arrays)
  {
    Tuple tuple(array->GetNumberOfComponents());
    for (vtkIdType element = 0; element < elements; ++element)
    {
      array->GetTuple(element, tuple.data());
      isNaN[element] |= std::any_of(tuple.begin(), tuple.end(), [](double x) { return std::isnan(x); }) ? 1 : 0;
    }
  }
  return isNaN;
}

/// The cells that have one of these points.
std::vector<char> CellsWith(const std::vector<char>& isPoint, vtkDataSet* dataset)
{
  std::vector<char> isCell(dataset->GetNumberOfCells(), 0);
  if (std::find(isPoint.begin(), isPoint.end(), 1) == isPoint.end())
  {
    return isCell;
  }
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
  {
    dataset->GetCellPoints(cell, points);
    isCell[cell] =
      std::any_of(points->begin(), points->end(), [&](vtkIdType point) { return isPoint[point] != 0; }) ? 1 : 0;
  }
  return isCell;
}

/// Gives the elements without a vector the mean of their neighbours, as far as these have one.
/// \param visitNeighbours calls a function with each of them.
template <class VisitNeighbours>
void FillFromNeighbours(Points& vectors, const std::vector<char>& isDefined, const VisitNeighbours& visitNeighbours)
{
  for (int element = 0; element < vectors.rows(); ++element)
  {
    if (isDefined[element])
    {
      continue;
    }
    Vector3 sum = Vector3::Zero();
    int number = 0;
    visitNeighbours(element,
      [&](int neighbour)
      {
        sum += isDefined[neighbour] ? Vector3(vectors.row(neighbour).transpose()) : Vector3::Zero();
        number += isDefined[neighbour] ? 1 : 0;
      });
    vectors.row(element) = sum.transpose() / std::max(number, 1);
  }
}

FaceFlow OnFaces(const FramedMesh& surface, const Points& vectors)
{
  const int faces = surface.Mesh.NumberOfFaces();
  FaceFlow flow{ Vector<Complex>(faces), Vector<double>(faces), {} };
  for (int face = 0; face < faces; ++face)
  {
    const Vector3 vector = vectors.row(face).transpose();
    flow.Tangential[face] = surface.Faces.ToComplex(face, vector);
    flow.Normal[face] = surface.Faces.Normal(face).dot(vector);
  }
  return flow;
}

/// The means over the corners of the faces.
Points MeansOfCorners(const TriangleMesh& mesh, const Points& ofVertices)
{
  Points means(mesh.NumberOfFaces(), 3);
  for (int face = 0; face < means.rows(); ++face)
  {
    const auto corners = mesh.FaceCorners().row(face);
    means.row(face) = (ofVertices.row(corners[0]) + ofVertices.row(corners[1]) + ofVertices.row(corners[2])) / 3.0;
  }
  return means;
}

}

ChosenFlow::ChosenFlow(vtkAlgorithm* algorithm, vtkDataSet* input, const Vector3& axis, bool isMap)
  : Components(FindEastAndNorth(ChoiceOf(algorithm, 1), ChoiceOf(algorithm, 2), axis, input, "the surface"))
  , OnPoints(Components.Eastward.OnPoints())
  , IsMap(isMap)
{
  if (this->Components.Eastward.Array)
  {
    return;
  }
  const ChosenArray vectors = FindVectors(ChoiceOf(algorithm, 0), input, "flow", "the surface");
  if (!vectors.Array)
  {
    throw WrongChoice(
      "there is no flow to decompose: no array of vectors is chosen, and none is active; choose one, or eastward and "
      "northward components, or connect Edges");
  }
  this->Vectors = vectors.Array;
  this->OnPoints = vectors.OnPoints();
}

vtkSmartPointer<vtkDataSet> ChosenFlow::WithFlow(vtkDataSet* dataset)
{
  const std::vector<vtkDataArray*> arrays = this->Vectors
    ? std::vector<vtkDataArray*>{ this->Vectors }
    : std::vector<vtkDataArray*>{ this->Components.Eastward.Array, this->Components.Northward.Array };
  const vtkIdType elements = this->OnPoints ? dataset->GetNumberOfPoints() : dataset->GetNumberOfCells();
  const std::vector<char> isNaN = WithoutFlow(arrays, elements);
  this->CheckFillValues(isNaN);
  const std::vector<char> isHidden = this->OnPoints ? CellsWith(isNaN, dataset) : isNaN;
  const vtkIdType number = std::count(isHidden.begin(), isHidden.end(), 1);
  if (number > 0 && number == dataset->GetNumberOfCells())
  {
    throw InvalidInput(
      "the flow is NaN at each cell or at one of its points, so nothing is left; choose another array or time");
  }
  if (number == 0)
  {
    return { dataset };
  }
  this->IsHidden = isHidden;
  return WithHidden(dataset, isHidden);
}

void ChosenFlow::MarkCellsWithoutFlow(
  vtkDataSet* output, const SurfaceRelation& relation, const std::vector<std::string>& names) const
{
  const auto number = NewArray(ArrayNames::CellsWithoutFlow, 1, 1);
  number->SetValue(0, static_cast<double>(std::count(this->IsHidden.begin(), this->IsHidden.end(), 1)));
  output->GetFieldData()->AddArray(number);
  std::vector<vtkIdType> cells, points;
  vtkNew<vtkIdList> corners;
  for (std::size_t cell = 0; cell < this->IsHidden.size(); ++cell)
  {
    if (!this->IsHidden[cell])
    {
      continue;
    }
    cells.push_back(static_cast<vtkIdType>(cell));
    output->GetCellPoints(cells.back(), corners);
    std::copy_if(corners->begin(), corners->end(), std::back_inserter(points),
      [&relation](vtkIdType point) { return relation.VerticesOf(point).empty(); });
  }
  const auto erase = [](vtkDataArray* array, const std::vector<vtkIdType>& tuples)
  {
    for (std::size_t k = 0; array && k < tuples.size(); ++k)
    {
      for (int component = 0; component < array->GetNumberOfComponents(); ++component)
      {
        array->SetComponent(tuples[k], component, std::numeric_limits<double>::quiet_NaN());
      }
    }
    AllowNaN(tuples.empty() ? nullptr : array);
  };
  for (const std::string& name : names)
  {
    erase(output->GetCellData()->GetArray(name.c_str()), cells);
    erase(output->GetPointData()->GetArray(name.c_str()), points);
  }
}

void ChosenFlow::CheckFillValues(const std::vector<char>& isNaN)
{
  constexpr double Impossible = 1e8, Suspicious = 1e3; // times the median
  std::vector<double> sizes;
  for (vtkDataArray* const array : { this->Vectors, this->Components.Eastward.Array, this->Components.Northward.Array })
  {
    Tuple tuple(array ? array->GetNumberOfComponents() : 0);
    for (vtkIdType element = 0; array && element < static_cast<vtkIdType>(isNaN.size()); ++element)
    {
      array->GetTuple(element, tuple.data());
      for (const double x : tuple)
      {
        if (x != 0.0 && !isNaN[element])
        {
          sizes.push_back(std::abs(x));
        }
      }
    }
  }
  if (sizes.empty())
  {
    return;
  }
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  const auto number = std::count(sizes.begin(), sizes.end(), largest);
  auto rest = std::partition(sizes.begin(), sizes.end(), [largest](double size) { return size < largest; });
  double median = largest;
  if (rest != sizes.begin())
  {
    const auto middle = sizes.begin() + (rest - sizes.begin()) / 2;
    std::nth_element(sizes.begin(), middle, rest);
    median = *middle;
  }
  const std::string values = std::to_string(number) + (number == 1 ? " number" : " numbers") + " of the flow " +
    (number == 1 ? "has" : "have") + " the size " + ShortText(largest);
  const std::string remedy = "switch on Replace Fill Value With Nan in the reader, or make them NaN";
  if (!std::isfinite(largest) || largest > Impossible * median)
  {
    throw InvalidInput(values + ", as fill values have where there is no flow; " + remedy);
  }
  this->Suspicion =
    number > 1 && largest > Suspicious * median ? values + ". If that is a fill value, " + remedy + "." : "";
}

Vector3 ChosenFlow::At(vtkIdType tuple, const Vector3& place) const
{
  if (!this->Vectors)
  {
    return this->Components.At(tuple, place);
  }
  Vector3 vector = Vector3::Zero();
  this->Vectors->GetTuple(tuple, vector.data());
  if (this->IsMap)
  {
    const GlobeDirections at = DirectionsOnGlobe(Vector3::UnitZ(), place);
    vector = vector[0] * at.East + vector[1] * at.North + vector[2] * at.Up;
  }
  return vector;
}

FaceFlow ChosenFlow::On(const FramedSurface& surface, const ExecutionContext& context) const
{
  const FramedMesh& on = surface.Geometry;
  const TriangleMesh& mesh = on.Mesh;
  if (this->Components.Eastward.Array && HaveConstantZ(mesh.VertexPositions()))
  {
    throw WrongChoice("the surface is a plane, and eastward and northward components need a globe around the origin; "
                      "set Coordinates to "
                      "Longitude and Latitude in Degrees, or choose vectors");
  }
  if (const std::string problem =
        this->Vectors && !this->IsMap ? ProblemOfPlaneVectors(this->Vectors, mesh.VertexPositions()) : "";
      !problem.empty())
  {
    throw WrongChoice(problem);
  }
  const Points centres = this->OnPoints ? mesh.VertexPositions() : CellCentres(mesh, surface.Relation);
  Points vectors(centres.rows(), 3);
  std::vector<char> isDefined(centres.rows(), 1);
  for (int element = 0; element < vectors.rows(); ++element)
  {
    const Vector3 place = centres.row(element).transpose();
    const vtkIdType tuple = this->OnPoints ? surface.Relation.PointOf(element) : surface.Relation.CellOf(element);
    vectors.row(element) = this->At(tuple, place).transpose();
    isDefined[element] = this->IsOnGlobe() && DirectionsOnGlobe(this->Components.Axis, place).East.isZero(0.0) ? 0 : 1;
  }
  if (this->OnPoints)
  {
    FillFromNeighbours(vectors, isDefined,
      [&mesh](int vertex, const auto& visit)
      {
        mesh.VisitFan(vertex,
          [&](int h)
          {
            visit(mesh.Head(h));
            if (mesh.Twin(TriangleMesh::Previous(h)) < 0)
            {
              visit(mesh.Tail(TriangleMesh::Previous(h)));
            }
          });
      });
  }
  else
  {
    FillFromNeighbours(vectors, isDefined,
      [&](int face, const auto& visit)
      {
        for (const int part : surface.Relation.FacesOf(surface.Relation.CellOf(face)))
        {
          mesh.VisitNeighbours(part, visit);
        }
      });
  }
  FaceFlow flow = OnFaces(on, this->OnPoints ? MeansOfCorners(mesh, vectors) : vectors);
  flow.Derivatives = [surface, vectors, onPoints = this->OnPoints](const ExecutionContext& loops)
  {
    return onPoints ? DerivativesOfVertexVectors(surface.Geometry, surface.Relation, vectors, loops)
                    : DerivativesOfCellVectors(surface.Geometry, surface.Relation, vectors, loops);
  };
  context.Checkpoint(1.0);
  return flow;
}

}
