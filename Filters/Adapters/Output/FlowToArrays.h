#ifndef dmgFlowToArrays_h
#define dmgFlowToArrays_h

#include "Adapters/Input/FlowFromArrays.h"
#include "Adapters/View/SurfaceView.h"
#include "Flows/HodgeDecomposition.h"
#include "Support/ExecutionContext.h"

#include <string>

class vtkPolyData;

namespace dmg
{

/// The arrays of a decomposed flow that somebody wants.
struct FlowOptions
{
  FlowParts Parts;
  bool Derivatives = true;
  double LengthScale = 1.0;  ///< the length of the unit of the points
  int NumberOfContours = 0;  ///< of the stream function
  int ReferenceBoundary = 0; ///< against which transports of boundaries are measured
  double Lift = 0.0;         ///< of these lines off the surface, relative to the diagonal of its bounding box
  bool IsOfCentres = false;  ///< the surface ends at the centres of cells, half a cell before its boundary
};

/// Adds the arrays of vtkHodgeDecomposition to the output of a view.
/// \param streamlines, boundaries empty outputs; become the contours of the stream function, and the boundaries of the surface.
/// \return a warning of what is NaN, empty where nothing is.
/// \throw InvalidInput there is no boundary of the number ReferenceBoundary.
std::string WriteFlow(const DecomposedFlow& parts, HodgeDecomposition& decomposition, const FaceFlow& flow,
  const FlowOptions& options, const SurfaceView& view, vtkPolyData* streamlines, vtkPolyData* boundaries,
  const ExecutionContext& context);

}

#endif
