#ifndef dmgFieldToArrays_h
#define dmgFieldToArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Field.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"

namespace dmg
{

/// Adds the arrays of a field to the output of a view, and makes its first direction the active vectors. Makes \p edges the edges of
/// the surface, with the angle by which the field rotates across each.
/// \param allDirections whether all N directions are added, rather than Direction0 alone.
void AddField(
  const SurfaceView& view, const Field& field, bool allDirections, vtkPolyData* edges, const ExecutionContext& context);

/// Adds the weights of the prescribed elements to the output of a view or, where these are edges, to \p edges.
void AddPrescribed(
  const SurfaceView& view, const FieldConstraints& constraints, ElementKind elements, vtkPolyData* edges);

/// Adds both principal values of the tensors that directions of the surface are taken from, if they are tensors.
/// \param choices of arrays of the surface.
void AddPrincipalValues(const SurfaceView& view, const ConstraintArrays& choices);

}

#endif
