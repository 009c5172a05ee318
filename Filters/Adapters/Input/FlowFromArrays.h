#ifndef dmgFlowFromArrays_h
#define dmgFlowFromArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

class vtkAlgorithm;
class vtkDataSet;

namespace dmg
{

/// A flow by faces.
struct FaceFlow
{
  Vector<Complex> Tangential; ///< in the frames of the faces
  Vector<double> Normal;      ///< components along the normals; empty where there are none
};

/// The flow that was chosen with SetInputArrayToProcess: vectors (index 0) or, where index 1 is chosen, eastward (1) and northward
/// components (2) about an axis through the origin. Of points, the mean over the corners.
/// \throw WrongChoice nothing is chosen, or vectors of 2 numbers on a surface that is not in a plane of constant z.
/// \throw InvalidInput as FindArray; a number is not finite; the axis is zero where it is needed. Cost: linear.
FaceFlow FlowFromArrays(vtkAlgorithm* algorithm, vtkDataSet* input, const FramedSurface& surface, const Vector3& axis,
  const ExecutionContext& context);

}

#endif
