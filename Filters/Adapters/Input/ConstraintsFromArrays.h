#ifndef dmgConstraintsFromArrays_h
#define dmgConstraintsFromArrays_h

#include "Adapters/Input/GuidesFromDataSets.h"
#include "Adapters/Surface/MeshFromPolyData.h"

#include <functional>
#include <string>

namespace dmg
{

/// All that is prescribed.
struct Prescription
{
  Constraints Directions;
  GuidesReport Report;
  UnusableDirections Unusable; ///< of the surface and the guides; left out

  /// What is unusable, and what helps, in one sentence.
  std::string UnusableText() const;
};

/// The directions that were chosen on the surface and those of guides; the rules are those of
/// vtkHarmonicFieldSolver.h.
///
/// On the surface, cells prescribe faces and points vertices; cells and points without a triangle
/// take no part. Guides prescribe faces.
///
/// Directions that are not finite, zero or perpendicular to the surface are left out. Of tensors counts the direction of the
/// largest eigenvalue in the tangent plane.
///
/// \param places of the surface, made where there are guides.
/// \return without directions where nothing is chosen and guides are empty.
/// \throw InvalidInput as FindArrays, VisitPrescribed and GuidesFrom, FollowGuides; what is chosen prescribes nothing.
/// \throw Cancelled
/// Cost: linear, besides the guides.
Prescription ChosenDirections(const ConstraintChoices& onSurface, vtkPolyData* surface, const GuideInput& guides,
  const FramedSurface& on, const std::function<const NearestPlaces&()>& places, const ExecutionContext& context);

}

#endif
