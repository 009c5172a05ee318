#ifndef dmgFlowFromArrays_h
#define dmgFlowFromArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Support/Types.h"

class vtkAlgorithm;
class vtkDataSet;

namespace dmg
{

/// The flow that was chosen with SetInputArrayToProcess, a vector for each face: vectors (index 0) or, where index 1 is chosen,
/// eastward (1) and northward components (2) about an axis through the origin. Of points, the mean over the corners.
/// \throw InvalidInput nothing is chosen, or as FindArray; a number is not finite; the axis is zero where it is needed. Cost: linear.
Points FlowVectors(vtkAlgorithm* algorithm, vtkDataSet* input, const FramedSurface& surface, const Vector3& axis);

}

#endif
