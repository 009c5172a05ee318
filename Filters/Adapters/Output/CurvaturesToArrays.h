#ifndef dmgCurvaturesToArrays_h
#define dmgCurvaturesToArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Directions/PrincipalDirections.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// Adds the arrays of vtkPrincipalDirections to the output of a view.
void AddCurvatures(const SurfaceView& view, const PrincipalDirections& curvatures, const ExecutionContext& context);

}

#endif
