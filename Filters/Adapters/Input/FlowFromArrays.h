#ifndef dmgFlowFromArrays_h
#define dmgFlowFromArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Flows/FittedDerivatives.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <functional>
#include <string>

class vtkAlgorithm;
class vtkDataSet;

namespace dmg
{

/// A flow by faces.
struct FaceFlow
{
  Vector<Complex> Tangential; ///< in the frames of the faces
  Vector<double> Normal;      ///< components along the normals; empty where there are none
  /// Its divergence and vorticity, from what was given.
  std::function<DerivativesAtVertices(const ExecutionContext&)> Derivatives;
  std::string Warning = {}; ///< empty where there is none
};

/// The flow of a dataset that was chosen with SetInputArrayToProcess: vectors (index 0) or, where index 1 is chosen, eastward (1) and
/// northward components (2) about an axis of any length through the origin.
/// \throw WrongChoice nothing is chosen.
/// \throw InvalidInput as VectorArrays.
VectorArrays ArraysOfFlow(vtkAlgorithm* algorithm, vtkDataSet* dataset, const Vector3& axis);

/// The flow that arrays hold (SurfaceView::Vectors), of tangential parts (VectorsOnSurface::TakeOutNormalParts). Of points, a face has the mean over
/// its corners. There is a warning where parts along the normal spoil derivatives at the boundary.
/// \throw WrongChoice as SurfaceView::Vectors. Cost: linear.
FaceFlow FlowFromArrays(const SurfaceView& view, const VectorArrays& arrays, const ExecutionContext& context);

}

#endif
