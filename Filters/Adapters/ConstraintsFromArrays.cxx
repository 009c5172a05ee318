#include "Adapters/ConstraintsFromArrays.h"

#include "Support/Errors.h"

#include "vtkPolyData.h"

namespace dmg
{

namespace
{

PrescribedDirections DirectionsOnSurface(const ConstraintArrays& arrays, const SurfaceMesh& surface)
{
  PrescribedDirections directions;
  if (arrays.OnPoints)
  {
    VisitPrescribed(
      arrays, [&surface](vtkIdType point) { return surface.VertexOf(point) >= 0; },
      [&directions, &surface](const ElementDirection& given)
      {
        directions.AtVertices.push_back(
          { surface.VertexOf(given.Element), given.Vector, given.Weight });
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

}

Prescription ChosenDirections(const ConstraintChoices& onSurface, vtkPolyData* surface,
  const Guides& guides, const FramedSurface& framed, const ExecutionContext& context)
{
  PrescribedDirections directions =
    DirectionsOnSurface(FindArrays(onSurface, surface, "the surface"), framed.Surface);
  const GuidesOnSurface followed = BringToSurface(guides, surface, framed, context);
  directions.OnFaces.insert(
    directions.OnFaces.end(), followed.Directions.begin(), followed.Directions.end());
  if (directions.OnFaces.empty() && directions.AtVertices.empty())
  {
    const std::string leftOut = followed.Report.LeftOut();
    throw InvalidInput("no direction is prescribed; " +
      (leftOut.empty()
          ? "choose an array of vectors on the surface for Directions and a Mask, if any, that is "
            "not zero everywhere, or connect lines or points with vectors to Guides"
          : leftOut));
  }
  return { std::move(directions), followed.Report };
}

}
