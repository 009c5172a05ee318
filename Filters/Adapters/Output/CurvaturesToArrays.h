#ifndef dmgCurvaturesToArrays_h
#define dmgCurvaturesToArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Directions/PrincipalDirections.h"
#include "Support/ExecutionContext.h"

class vtkDataSet;

namespace dmg
{

/// Adds the arrays of vtkPrincipalDirections to the cells and points of \p output, a copy of the \p input that \p surface
/// was made from.
void AddCurvatures(const FramedSurface& surface, const PrincipalDirections& curvatures, vtkDataSet* input,
  vtkDataSet* output, const ExecutionContext& context);

}

#endif
