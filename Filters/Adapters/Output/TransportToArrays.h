#ifndef dmgTransportToArrays_h
#define dmgTransportToArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Geodesics/ParallelTransport.h"
#include "Support/ExecutionContext.h"

class vtkPolyData;

namespace dmg
{

/// Adds TransportedVectors to the output of a view.
void WriteTransported(const TransportedField& field, const SurfaceView& view, const ExecutionContext& context);

/// Adds the arrays of the logarithmic map.
/// \param textureSize the side of the square that a texture covers; 0: twice the largest distance.
/// \param circles an empty output; becomes \p numberOfCircles lines of equal distance, evenly spaced.
void WriteMap(const LogarithmicMap& map, int vertex, const SidesOfSurface& sides, double textureSize,
  int numberOfCircles, const SurfaceView& view, vtkPolyData* circles, const ExecutionContext& context);

}

#endif
