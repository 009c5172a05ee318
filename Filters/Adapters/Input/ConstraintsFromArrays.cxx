#include "Adapters/Input/ConstraintsFromArrays.h"

#include "Adapters/Input/GuideDataSets.h"
#include "Support/Errors.h"

#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <cmath>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

Constraints DirectionsOnSurface(const ConstraintArrays& arrays, const SurfaceNumbering& surface)
{
  Constraints directions;
  if (arrays.OnPoints)
  {
    VisitPrescribed(
      arrays, [&surface](vtkIdType point) { return surface.VertexOf(point) >= 0; },
      [&directions, &surface](const ElementDirection& given) {
        directions.AtVertices.push_back({ surface.VertexOf(given.Element), given.Vector, given.Weight });
      });
  }
  else
  {
    VisitPrescribed(
      arrays, [&surface](vtkIdType cell) { return surface.FaceOf(cell) >= 0; },
      [&directions, &surface](const ElementDirection& given) {
        directions.OnFaces.push_back({ surface.FaceOf(given.Element), given.Vector, given.Weight });
      });
  }
  return directions;
}

/// Values at points: where the mask is not zero, or, without a mask, where they are numbers; with weights, where those are
/// not zero, too.
std::vector<ValueConstraint> ValuesOnSurface(
  const ConstraintChoices& choices, vtkPolyData* surface, const SurfaceNumbering& numbering)
{
  std::vector<ValueConstraint> prescribed;
  const ChosenArray values = FindArray(choices.Values, surface, 1, "values", "the surface");
  if (!values.Array)
  {
    return prescribed;
  }
  const ChosenArray mask = FindArray(choices.Mask, surface, 1, "mask", "the surface");
  const ChosenArray weights = FindArray(choices.Weights, surface, 1, "weights", "the surface");
  for (const ChosenArray& array : { values, mask, weights })
  {
    if (array.Array && !array.OnPoints)
    {
      throw InvalidInput("values are prescribed at points, and an array of cells is chosen for "
                         "Values, Mask or Weights; choose arrays of points");
    }
  }
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    const int vertex = numbering.VertexOf(point);
    const double value = values.Array->GetComponent(point, 0);
    const double weight = weights.Array ? weights.Array->GetComponent(point, 0) : 1.0;
    if (vertex >= 0 && weight != 0.0 && (mask.Array ? mask.Array->GetComponent(point, 0) != 0.0 : !std::isnan(value)))
    {
      prescribed.push_back({ vertex, value, weight });
    }
  }
  return prescribed;
}

}

Prescription ChosenDirections(const ConstraintChoices& onSurface, vtkPolyData* surface, const GuideInput& guides,
  const SurfaceNumbering& numbering, const std::function<const NearestPlaces&()>& places,
  const ExecutionContext& context)
{
  Constraints directions;
  const auto values = ValuesOnSurface(onSurface, surface, numbering);
  // Mask and weights are those of the values otherwise.
  if (!HasArray(onSurface.Values, surface) || HasArray(onSurface.Vectors, surface))
  {
    directions = DirectionsOnSurface(FindArrays(onSurface, surface, "the surface"), numbering);
  }
  directions.Values = values;
  const Guides given = GuidesFrom(guides);
  const FollowedGuides followed = given.AreEmpty() ? FollowedGuides() : FollowGuides(given, places(), context);
  directions.OnFaces.insert(directions.OnFaces.end(), followed.Directions.begin(), followed.Directions.end());
  const bool isEmpty = directions.AreEmpty();
  if (isEmpty && !followed.Report.IsAllTaken())
  {
    throw InvalidInput("no direction is prescribed; " + followed.Report.LeftOut());
  }
  if (isEmpty && HasArray(onSurface.Vectors, surface))
  {
    throw InvalidInput(
      "no direction is prescribed: the directions of the surface are zero, or its mask or weights are; "
      "choose other arrays for Directions, Mask and Weights, or none for the smoothest field");
  }
  if (isEmpty && !DataSetsOf(guides.Data).empty())
  {
    throw InvalidInput(
      "no direction is prescribed: the lines of the guides have no length or their vectors are zero, or "
      "their mask or weights are; choose others, or clear Guides for the smoothest field");
  }
  return { std::move(directions), followed.Report };
}

}
