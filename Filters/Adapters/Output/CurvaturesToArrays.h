#ifndef dmgCurvaturesToArrays_h
#define dmgCurvaturesToArrays_h

#include "Adapters/Surface/MeshFromPolyData.h"
#include "Operators/PrincipalDirections.h"
#include "Support/ExecutionContext.h"

class vtkPolyData;

namespace dmg
{

/// Adds the arrays of vtkPrincipalDirections to the cells and points of \p output, a copy of the \p input that \p surface
/// was made from.
void AddCurvatures(const FramedSurface& surface, const PrincipalDirections& curvatures, vtkPolyData* input,
  vtkPolyData* output, const ExecutionContext& context);

}

#endif
