#ifndef dmgCrossesOfSurface_h
#define dmgCrossesOfSurface_h

#include "Adapters/View/SurfaceView.h"
#include "Quads/QuadOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

class vtkAlgorithm;

namespace dmg
{

/// The cross field of a surface: the one in its arrays (ReadField), where an array is chosen with SetInputArrayToProcess, index 0, or the
/// surface has Direction0; else the smoothest one that follows boundary and sharp edges as far as the options align edges to these.
/// \param view becomes the surface that the filter before has prepared. \param N of the field in the arrays; see ReadField.
/// Where the field of the arrays has gaps, as masked data have, it goes on as the smoothest one.
/// \return fourth powers of the directions of faces.
/// \throw WrongChoice as ReadField; the field has another number of directions than 1, 2 or 4.
/// \throw InvalidInput as ReadField, and FieldSolver::Solve.
Vector<Complex> CrossesOf(
  vtkAlgorithm* algorithm, SurfaceView& view, int N, const QuadOptions& options, const ExecutionContext& context);

}

#endif
