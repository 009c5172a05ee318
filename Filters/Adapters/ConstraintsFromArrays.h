#ifndef dmgConstraintsFromArrays_h
#define dmgConstraintsFromArrays_h

#include "Adapters/ChosenArrays.h"
#include "Adapters/FieldToArrays.h"
#include "Systems/AlignmentConstraints.h"

class vtkDataObject;
class vtkPolyData;

namespace dmg
{

/// The directions that were chosen on the surface and on another dataset; the rules are those of
/// vtkHarmonicFieldSolver.h.
///
/// On the surface, cells prescribe faces and points vertices; cells and points without a triangle
/// take no part. A point of the other dataset prescribes the face that is nearest to it.
///
/// \param surface that \p framed was made from.
/// \param source the other dataset, or several of them as a composite one; may be null.
/// \throw InvalidInput as FindArrays and VisitPrescribed; \p source is something else; nothing is
/// prescribed; a point of \p source that prescribes a direction is not finite, or the direction is
/// not tangential. Cost: linear; with \p source, a locator over the surface and logarithmic time
/// per point.
PrescribedDirections ChosenDirections(const ConstraintChoices& onSurface, vtkPolyData* surface,
  const ConstraintChoices& onSource, vtkDataObject* source, const FramedSurface& framed);

}

#endif
