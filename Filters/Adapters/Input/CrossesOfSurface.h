#ifndef dmgCrossesOfSurface_h
#define dmgCrossesOfSurface_h

#include "Adapters/Surface/PreparedDataSet.h"
#include "Quads/QuadOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>

class vtkAlgorithm;
class vtkDataSet;

namespace dmg
{

/// A surface with a cross field on its faces.
struct CrossesOfSurface
{
  std::shared_ptr<const PreparedDataSet> Surface;
  Vector<Complex> Powers; ///< fourth powers of the directions of faces, 0 where there is none
};

/// The cross field of a surface: the one in its arrays (ReadField), where an array is chosen with SetInputArrayToProcess, index 0, or the
/// surface has Direction0; else the smoothest one that follows boundary and sharp edges as far as the options align edges to these.
/// \param N of the field in the arrays; see ReadField.
/// \throw WrongChoice as ReadField; the field has another number of directions than 1, 2 or 4.
/// \throw InvalidInput as ReadField, and FieldSolver::Solve.
CrossesOfSurface CrossesOf(
  vtkAlgorithm* algorithm, vtkDataSet* surface, int N, const QuadOptions& options, const ExecutionContext& context);

}

#endif
