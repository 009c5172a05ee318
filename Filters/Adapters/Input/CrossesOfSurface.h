#ifndef dmgCrossesOfSurface_h
#define dmgCrossesOfSurface_h

#include "Adapters/View/SurfaceView.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <optional>

class vtkAlgorithm;

namespace dmg
{

/// The cross field in the arrays of a surface (ReadField), where an array is chosen with SetInputArrayToProcess, index 0, or the surface has
/// Direction0; else none.
/// \param view becomes the surface that the filter before has prepared, or is prepared here. \param N of the field in the arrays; see ReadField.
/// \return fourth powers of the directions of faces, 0 where there is none.
/// \throw WrongChoice as ReadField; the field has another number of directions than 1, 2 or 4.
/// \throw InvalidInput as ReadField.
std::optional<Vector<Complex>> CrossesOf(
  vtkAlgorithm* algorithm, SurfaceView& view, int N, const ExecutionContext& context);

}

#endif
