#include "Adapters/ConstraintsFromArrays.h"

#include "Support/Errors.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLocator.h"

#include <cmath>

namespace dmg
{

namespace
{

/// A direction leaning less than this (as a sine) out of the normal has no tangential part.
constexpr double SmallestTangentialPart = 1e-6;

/// Arrays of one dataset that prescribe directions. Without vectors nothing is prescribed.
struct ConstraintArrays
{
  vtkDataArray* Mask = nullptr; // 1 component; null: where the vector is not zero
  vtkDataArray* Vectors = nullptr; // 3 components
  vtkDataArray* Weights = nullptr; // 1 component; null: 1
  bool OnPoints = false; // else on cells
};

struct Chosen
{
  vtkDataArray* Array = nullptr;
  int Association = vtkDataObject::FIELD_ASSOCIATION_NONE;
};

Chosen ChosenArray(vtkAlgorithm* algorithm, int index, vtkDataSet* dataset, int components,
  const std::string& what, const std::string& whose)
{
  vtkInformation* const choice = algorithm->GetInputArrayInformation(index);
  const bool byName = choice->Has(vtkDataObject::FIELD_NAME());
  const std::string name = byName ? choice->Get(vtkDataObject::FIELD_NAME()) : "";
  if (byName ? name.empty() : !choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    return {};
  }
  const int wanted = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  vtkAbstractArray* found = nullptr;
  Chosen chosen;
  for (int association :
    { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    if (!found &&
      (wanted == association || wanted == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS))
    {
      vtkDataSetAttributes* const attributes = dataset->GetAttributes(association);
      found = byName
        ? attributes->GetAbstractArray(name.c_str())
        : attributes->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
      chosen.Association = association;
    }
  }
  if (!found && name == "None") // how menus say that nothing is chosen
  {
    return {};
  }
  const std::string called = "array '" + name + "', chosen for the " + what + " of " + whose + ",";
  if (!found)
  {
    throw InvalidInput(
      called + " is not among its point or cell arrays; choose one of those, or none");
  }
  chosen.Array = vtkDataArray::SafeDownCast(found);
  if (!chosen.Array || chosen.Array->GetNumberOfComponents() != components)
  {
    throw InvalidInput(called + " does not hold " + std::to_string(components) +
      (components == 1 ? " number" : " numbers") + " per element; choose another");
  }
  return chosen;
}

/// Calls add(element, vector, weight, name) for all that are prescribed among tuples [0, size) of some arrays.
/// \param elementOf the element of a tuple, or -1, where it does not count.
template <class ElementOf, class Add>
void VisitPrescribed(const ConstraintArrays& arrays, vtkIdType size, const std::string& kind,
  const ElementOf& elementOf, const Add& add)
{
  for (vtkIdType id = 0; id < size; ++id)
  {
    const auto element = elementOf(id);
    if (element < 0)
    {
      continue;
    }
    Vector3 vector;
    arrays.Vectors->GetTuple(id, vector.data());
    if (arrays.Mask ? arrays.Mask->GetComponent(id, 0) == 0.0 : vector.isZero(0.0))
    {
      continue;
    }
    const double weight = arrays.Weights ? arrays.Weights->GetComponent(id, 0) : 1.0;
    const std::string name = kind + " " + std::to_string(id);
    if (!vector.allFinite())
    {
      throw InvalidInput("the direction prescribed at " + name +
        " is not finite; repair it or take it out of the mask");
    }
    if (!(weight > 0.0) || !std::isfinite(weight))
    {
      throw InvalidInput("the weight of the direction prescribed at " + name + " is " +
        std::to_string(weight) + "; make it positive or take it out of the mask");
    }
    add(element, vector, weight, name);
  }
}

std::string NameOf(vtkDataArray* array)
{
  return array->GetName() ? array->GetName() : "(without a name)";
}

/// What was chosen with indices \p first (mask), \p first + 1 (vectors), \p first + 2 (weights).
/// \param byDefault the vectors where none are chosen; may be null.
ConstraintArrays ChosenConstraints(vtkAlgorithm* algorithm, int first, vtkDataSet* dataset,
  vtkDataArray* byDefault, const std::string& whose)
{
  const Chosen mask = ChosenArray(algorithm, first, dataset, 1, "mask", whose);
  const Chosen weights = ChosenArray(algorithm, first + 2, dataset, 1, "weights", whose);
  Chosen vectors = ChosenArray(algorithm, first + 1, dataset, 3, "directions", whose);
  if (!vectors.Array && byDefault)
  {
    vectors = { byDefault, vtkDataObject::FIELD_ASSOCIATION_POINTS };
  }
  for (const Chosen& other : { mask, weights })
  {
    if (other.Array && !vectors.Array)
    {
      throw InvalidInput("array '" + NameOf(other.Array) + "' is chosen as mask or weights of " +
        whose + ", and no directions are; choose an array of vectors as well");
    }
    if (other.Array && other.Association != vectors.Association)
    {
      throw InvalidInput("array '" + NameOf(other.Array) + "' of " + whose +
        " and its directions '" + NameOf(vectors.Array) +
        "' are not both on points or both on cells; choose arrays of one kind");
    }
  }
  return { mask.Array, vectors.Array, weights.Array,
    vectors.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS };
}

PrescribedDirections DirectionsOnSurface(
  const ConstraintArrays& arrays, vtkPolyData* input, const SurfaceNumbering& surface)
{
  PrescribedDirections directions;
  if (!arrays.Vectors)
  {
    return directions;
  }
  if (arrays.OnPoints)
  {
    VisitPrescribed(
      arrays, input->GetNumberOfPoints(), "point",
      [&surface](vtkIdType point) { return surface.VertexOf(point); },
      [&directions](int vertex, const Vector3& vector, double weight, const std::string&) {
        directions.AtVertices.push_back({ vertex, vector, weight });
      });
  }
  else
  {
    VisitPrescribed(
      arrays, input->GetNumberOfCells(), "cell",
      [&surface](vtkIdType cell) { return surface.FaceOf(cell); },
      [&directions](int face, const Vector3& vector, double weight, const std::string&) {
        directions.OnFaces.push_back({ face, vector, weight });
      });
  }
  return directions;
}

std::vector<PrescribedDirection> DirectionsFromPoints(const ConstraintArrays& arrays,
  vtkDataSet* points, vtkPolyData* input, const FramedMesh& framed,
  const SurfaceNumbering& numbering)
{
  std::vector<PrescribedDirection> directions;
  if (!arrays.Vectors)
  {
    return directions;
  }
  if (!arrays.OnPoints)
  {
    throw InvalidInput("array '" + NameOf(arrays.Vectors) +
      "' prescribes directions on cells of the second input; convert it with "
      "vtkCellDataToPointData, or choose a point array");
  }
  vtkNew<vtkPolyData> triangles; // its cells are the polygons
  triangles->SetPoints(input->GetPoints());
  triangles->SetPolys(input->GetPolys());
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(triangles);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  VisitPrescribed(
    arrays, points->GetNumberOfPoints(), "point", [](vtkIdType point) { return point; },
    [&directions, &framed, &numbering, &locator, &cell, points](
      vtkIdType point, const Vector3& vector, double weight, const std::string& name)
    {
      double position[3], closest[3], squaredDistance;
      points->GetPoint(point, position);
      vtkIdType polygon = -1;
      int subId;
      locator->FindClosestPoint(position, closest, cell, polygon, subId, squaredDistance);
      if (polygon < 0)
      {
        throw InvalidInput(name + " of the second input has no nearest triangle; is it finite?");
      }
      const int face = numbering.Faces[polygon];
      const Complex direction = framed.Faces.ToComplex(face, vector);
      if (std::abs(direction) <= SmallestTangentialPart * vector.norm())
      {
        throw InvalidInput("the direction prescribed at " + name +
          " of the second input is perpendicular to the nearest triangle, cell " +
          std::to_string(numbering.CellOf(face)) +
          "; turn it or take it out of the mask");
      }
      directions.push_back({ face, vector, weight });
    });
  return directions;
}

}

PrescribedDirections ChosenDirections(
  vtkAlgorithm* algorithm, vtkPolyData* surface, vtkDataSet* points, const FramedMesh& framed,
  const SurfaceNumbering& numbering)
{
  PrescribedDirections directions = DirectionsOnSurface(
    ChosenConstraints(algorithm, 0, surface, nullptr, "the surface"), surface,
    numbering);
  if (points)
  {
    const ConstraintArrays arrays = ChosenConstraints(
      algorithm, 3, points, points->GetPointData()->GetVectors(), "the second input");
    const auto more = DirectionsFromPoints(arrays, points, surface, framed, numbering);
    directions.OnFaces.insert(directions.OnFaces.end(), more.begin(), more.end());
  }
  if (directions.OnFaces.empty() && directions.AtVertices.empty())
  {
    throw InvalidInput("no direction is prescribed; choose an array of vectors on the surface "
                       "(SetInputArrayToProcess, index 1) or on the second input (index 4), and a "
                       "mask, if any, that is not zero everywhere");
  }
  return directions;
}

}
