#ifndef dmgConstraintsFromArrays_h
#define dmgConstraintsFromArrays_h

#include "Adapters/FieldToArrays.h"
#include "Systems/AlignmentConstraints.h"

#include <vector>

class vtkAlgorithm;
class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// The directions that were chosen with SetInputArrayToProcess, on the surface (indices 0 mask,
/// 1 vectors, 2 weights) and on another dataset (3, 4, 5); the rules are those of
/// vtkHarmonicFieldSolver.h.
///
/// On the surface, a direction at a point lies in the tangent plane of the point and is carried
/// from it to each of the faces around; cells and points without a triangle take no part. A point
/// of the other dataset prescribes the face that is nearest to it.
///
/// \param surface that \p framed was made from.
/// \param points the other dataset, may be null.
/// \throw InvalidInput a chosen array that does not exist or has another form; nothing is
/// prescribed; an element whose vector is not finite or not tangential or whose weight is not
/// positive. Cost: linear; with points, a locator over the surface and logarithmic time per point.
std::vector<PrescribedDirection> ChosenDirections(
  vtkAlgorithm* algorithm, vtkPolyData* surface, vtkDataSet* points, const FramedSurface& framed);

}

#endif
