#ifndef dmgConstraintsFromArrays_h
#define dmgConstraintsFromArrays_h

#include "Adapters/MeshFromPolyData.h"
#include "Discretisations/Prescriptions.h"

class vtkAlgorithm;
class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// The directions that were chosen with SetInputArrayToProcess, on the surface (indices 0 mask,
/// 1 vectors, 2 weights) and on another dataset (3, 4, 5); the rules are those of
/// vtkHarmonicFieldSolver.h.
///
/// On the surface, cells prescribe faces and points vertices; cells and points without a triangle
/// take no part. A point of the other dataset prescribes the face that is nearest to it.
///
/// \param surface that \p framed was made from.
/// \param points the other dataset, may be null.
/// \throw InvalidInput a chosen array that does not exist or has another form; nothing is
/// prescribed; an element whose vector is not finite or whose weight is not positive; a point of
/// the other dataset whose vector is not tangential. Cost: linear; with points, a locator over the
/// surface and logarithmic time per point.
PrescribedDirections ChosenDirections(
  vtkAlgorithm* algorithm, vtkPolyData* surface, vtkDataSet* points, const FramedMesh& framed,
  const SurfaceNumbering& numbering);

}

#endif
