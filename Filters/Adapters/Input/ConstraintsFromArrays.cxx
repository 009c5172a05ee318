#include "Adapters/Input/ConstraintsFromArrays.h"

#include "Adapters/View/EastAndNorth.h"
#include "Adapters/View/FillValues.h"
#include "Constraints/WeightsOfPoints.h"
#include "Mesh/NormalParts.h"
#include "Support/Errors.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

constexpr const char* Whose = "the surface";

/// The first sentence counts.
void AddFillValues(UnusableDirections& sum, const std::string& sentence)
{
  sum.FillValues = sum.FillValues.empty() ? sentence : sum.FillValues;
}

void Add(UnusableDirections& sum, const UnusableDirections& part)
{
  sum.NotFinite += part.NotFinite;
  sum.Zero += part.Zero;
  sum.Perpendicular += part.Perpendicular;
  sum.NotSymmetric += part.NotSymmetric;
  AddFillValues(sum, part.FillValues);
}

/// The place of a point or cell of the caller's that is part of the surface.
Vector3 PlaceOf(vtkIdType element, bool isPoint, const FramedSurface& surface)
{
  const TriangleMesh& mesh = surface.Geometry.Mesh;
  const ElementRow row = isPoint ? surface.Relation.VerticesOf(element) : surface.Relation.FacesOf(element);
  Vector3 sum = Vector3::Zero();
  for (const int part : row)
  {
    for (int k = 0; k < 3; ++k)
    {
      sum += mesh.Position(isPoint ? part : mesh.FaceCorners()(part, k)) / (3.0 * row.size());
    }
  }
  return sum;
}

/// Makes vectors of tensors, of vectors in the plane, and of eastward and northward components.
DirectionReader ReaderOf(
  const ConstraintArrays& choices, const ConstraintArrays& arrays, vtkDataSet* input, const FramedSurface& surface)
{
  vtkDataArray* const vectors = arrays.Vectors.Array;
  const int components = vectors ? vectors->GetNumberOfComponents() : 3;
  if (components == 1)
  {
    if (const std::string problem = ProblemOfComponents(surface.Geometry.Mesh.VertexPositions()); !problem.empty())
    {
      throw InvalidInput(problem);
    }
    const EastAndNorth both = FindEastAndNorth(choices.Eastward, choices.Northward, choices.Axis, input, Whose);
    return [both, &surface](vtkIdType element, const double*)
    { return both.At(element, PlaceOf(element, both.Eastward.OnPoints(), surface)); };
  }
  if (vectors)
  {
    if (const std::string problem = ProblemOfPlaneVectors(vectors, surface.Geometry.Mesh.VertexPositions());
        !problem.empty())
    {
      throw InvalidInput(problem);
    }
  }
  if (components == 2)
  {
    return [](vtkIdType, const double* numbers) { return Vector3(numbers[0], numbers[1], 0.0); };
  }
  if (!HoldsTensors(vectors))
  {
    return {};
  }
  return
    [&surface, components, onPoints = arrays.Vectors.OnPoints()](vtkIdType element, const double* numbers) -> Vector3
  {
    const ElementRow row = onPoints ? surface.Relation.VerticesOf(element) : surface.Relation.FacesOf(element);
    const int place = row.empty() ? -1 : row.front();
    const Eigen::Matrix3d tensor = TensorOf(numbers, components);
    return place < 0 ? Vector3(Vector3::Zero())
      : tensor.allFinite()
      ? PrincipalDirection(tensor, onPoints ? surface.Geometry.Vertices : surface.Geometry.Faces, place)
      : Vector3(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  };
}

/// Weighs the directions of tensors by the difference of both principal values, relative to the mean of all.
void WeighByDifference(std::vector<Constraint>& constraints, const std::vector<double>& differences)
{
  double sum = 0.0;
  for (const double difference : differences)
  {
    sum += difference;
  }
  for (std::size_t i = 0; sum > 0.0 && i < constraints.size(); ++i)
  {
    constraints[i].Weight *= differences[i] * static_cast<double>(differences.size()) / sum;
  }
}

Constraints DirectionsOnSurface(
  const ConstraintArrays& choices, vtkDataSet* input, const FramedSurface& surface, UnusableDirections& unusable)
{
  Constraints directions;
  const ConstraintArrays arrays = FindArrays(choices, input, Whose, true);
  const bool onPoints = arrays.Vectors.OnPoints();
  const bool areTensors = HoldsTensors(arrays.Vectors.Array);
  std::vector<double> differences;
  const SurfaceRelation& relation = surface.Relation;
  const auto elementsOf = [&](vtkIdType element)
  {
    return onPoints                       ? relation.VerticesOf(element)
      : relation.IsPartOfSurface(element) ? relation.FacesOf(element)
                                          : ElementRow();
  };
  std::vector<Constraint>& constraints = onPoints ? directions.AtVertices : directions.OnFaces;
  Add(unusable,
    VisitPrescribed(
      arrays, input, Whose, ReaderOf(choices, arrays, input, surface),
      [&](vtkIdType element) { return !elementsOf(element).empty(); },
      [&](const ElementDirection& given)
      {
        Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
        if (areTensors)
        {
          double numbers[9];
          arrays.Vectors.Array->GetTuple(given.Element, numbers);
          tensor = TensorOf(numbers, arrays.Vectors.Array->GetNumberOfComponents());
          unusable.NotSymmetric += IsSymmetric(tensor) ? 0 : 1;
        }
        const Vector3 direction = onPoints || areTensors
          ? given
              .Vector // parts along normals of vertices are those of the whole surface, which may be on several ranks
          : WithoutNormalPartOfCell(surface.Geometry.Mesh, relation, elementsOf(given.Element).front(), given.Vector);
        if (direction.isZero(0.0))
        {
          ++unusable.Perpendicular;
          return;
        }
        for (const int element : elementsOf(given.Element))
        {
          constraints.push_back({ element, direction, given.Weight });
          if (areTensors && choices.WeighsTensors)
          {
            differences.push_back(DifferenceOfPrincipalValues(
              tensor, onPoints ? surface.Geometry.Vertices : surface.Geometry.Faces, element));
          }
        }
      }));
  WeighByDifference(constraints, differences);
  WeighPlacesOnce(directions.AtVertices, surface.Geometry.Mesh, relation);
  Add(unusable, LeaveOutUnusable(directions, surface.Geometry));
  return directions;
}

/// Values at points: where the mask is not zero, or, without a mask, where they are numbers; with weights, where those are
/// not zero, too.
std::vector<ValueConstraint> ValuesOnSurface(
  const ConstraintArrays& choices, vtkDataSet* surface, const SurfaceRelation& relation, UnusableDirections& unusable)
{
  std::vector<ValueConstraint> prescribed;
  const ChosenArray values = FindArray(choices.Values, surface, 1, "values", Whose);
  if (!values.Array)
  {
    return prescribed;
  }
  const ChosenArray mask = FindArray(choices.Mask, surface, 1, "mask", Whose);
  const ChosenArray weights = FindArray(choices.Weights, surface, 1, "weights", Whose);
  for (const ChosenArray& array : { values, mask, weights })
  {
    if (array.Array && !array.OnPoints())
    {
      throw InvalidInput("values are prescribed at points, and an array of cells is chosen for "
                         "Values, Mask or Weights; choose arrays of points");
    }
  }
  std::vector<char> isLeftOut(surface->GetNumberOfPoints(), 1);
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    const double value = values.Array->GetComponent(point, 0);
    const double weight = weights.Array ? weights.Array->GetComponent(point, 0) : 1.0;
    if (weight != 0.0 && (mask.Array ? mask.Array->GetComponent(point, 0) != 0.0 : !std::isnan(value)))
    {
      isLeftOut[point] = std::isfinite(value) ? 0 : 1;
      for (const int vertex : relation.VerticesOf(point))
      {
        prescribed.push_back({ vertex, value, weight });
      }
    }
  }
  AddFillValues(unusable, SuspectedFillValues({ values.Array }, isLeftOut, "values"));
  return prescribed;
}

/// The source of a function at vertices; empty where none is chosen.
Vector<double> SourceOnSurface(
  const ChosenArray& choice, vtkDataSet* surface, const FramedSurface& framed, UnusableDirections& unusable)
{
  const ChosenArray source = FindArray(choice, surface, 1, "source", Whose);
  if (source.Array && !source.OnPoints())
  {
    throw InvalidInput(
      "a source stands at points, and an array of cells is chosen for Source; choose an array of points, "
      "by Cell Data to Point Data (vtkCellDataToPointData) for example");
  }
  if (source.Array)
  {
    AddFillValues(unusable, SuspectedFillValues({ source.Array }, surface->GetNumberOfPoints(), "source"));
  }
  Vector<double> values(source.Array ? framed.Geometry.Mesh.NumberOfVertices() : 0);
  for (int vertex = 0; vertex < values.size(); ++vertex)
  {
    values[vertex] = source.Array->GetComponent(framed.Relation.PointOf(vertex), 0);
  }
  return values;
}

}

bool HasDirections(const ConstraintArrays& choices, vtkDataSet* dataset)
{
  return HasArray(choices.Vectors, dataset) || HasArray(choices.Eastward, dataset) ||
    HasArray(choices.Northward, dataset);
}

std::string TextOf(const UnusableDirections& unusable)
{
  std::string text;
  const auto say = [&text](long long number, const std::string& what)
  { text += number > 0 ? (text.empty() ? "" : ", ") + std::to_string(number) + what : ""; };
  say(unusable.NotFinite, " not finite");
  say(unusable.Zero, " zero where the mask is not");
  say(unusable.Perpendicular, " perpendicular to the surface");
  text = text.empty()
    ? ""
    : "some directions are left out: " + text + "; take them out of the mask, or make them zero where there is none";
  const std::string number = std::to_string(unusable.NotSymmetric);
  const std::string tensors = unusable.NotSymmetric == 0 ? ""
    : unusable.NotSymmetric == 1 ? number + " tensor is not symmetric; its symmetric part is used"
                                 : number + " tensors are not symmetric; their symmetric parts are used";
  for (const std::string& sentence : { tensors, unusable.FillValues })
  {
    text += (text.empty() || sentence.empty() ? "" : ". ") + sentence;
  }
  return text;
}

Constraints ConstraintsFromArrays(
  const ConstraintArrays& choices, vtkDataSet* input, const FramedSurface& surface, UnusableDirections& unusable)
{
  Constraints constraints;
  std::vector<ValueConstraint> values = ValuesOnSurface(choices, input, surface.Relation, unusable);
  // Mask and weights are those of the values otherwise.
  if (!HasArray(choices.Values, input) || HasDirections(choices, input))
  {
    constraints = DirectionsOnSurface(choices, input, surface, unusable);
  }
  WeighPlacesOnce(values, surface.Geometry.Mesh, surface.Relation);
  constraints.Values = std::move(values);
  constraints.Source = SourceOnSurface(choices.Source, input, surface, unusable);
  return constraints;
}

void AddRotation(const ChosenArray& choice, vtkDataSet* input, const FramedSurface& surface, RotationAngles& angles)
{
  constexpr double Degree = Pi / 180.0;
  const ChosenArray chosen = FindArray(choice, input, 1, "rotation", Whose);
  if (!chosen.Array)
  {
    return;
  }
  const TriangleMesh& mesh = surface.Geometry.Mesh;
  angles.Faces.setZero(mesh.NumberOfFaces());
  angles.Vertices.setZero(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (chosen.OnPoints())
    {
      angles.Vertices[vertex] = Degree * chosen.Array->GetComponent(surface.Relation.PointOf(vertex), 0);
      mesh.VisitFan(
        vertex, [&](int halfedge) { angles.Faces[TriangleMesh::FaceOf(halfedge)] += angles.Vertices[vertex] / 3.0; });
      continue;
    }
    int faces = 0;
    mesh.VisitFan(vertex,
      [&](int halfedge)
      {
        const vtkIdType cell = surface.Relation.CellOf(TriangleMesh::FaceOf(halfedge));
        angles.Vertices[vertex] += Degree * chosen.Array->GetComponent(cell, 0);
        ++faces;
      });
    angles.Vertices[vertex] /= faces;
  }
  for (int face = 0; !chosen.OnPoints() && face < mesh.NumberOfFaces(); ++face)
  {
    angles.Faces[face] = Degree * chosen.Array->GetComponent(surface.Relation.CellOf(face), 0);
  }
}

}
