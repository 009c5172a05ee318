#ifndef dmgFieldToArrays_h
#define dmgFieldToArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Field.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"

namespace dmg
{

/// Adds the arrays of a field to the cells and points of \p surface, in place of those that an earlier solver left there, and makes
/// its first direction the active vectors. Makes \p edges the edges of the surface, with the angle by which the field rotates across
/// each.
/// \param allDirections whether all N directions are added, rather than Direction0 alone.
void AddField(const FramedSurface& on, const Field& field, bool allDirections, vtkDataSet* surface, vtkPolyData* edges,
  const ExecutionContext& context);

/// Adds the weights of the prescribed elements to \p surface, or, where these are edges, to \p edges.
void AddPrescribed(const SurfaceRelation& relation, const FieldConstraints& constraints, ElementKind elements,
  vtkDataSet* surface, vtkPolyData* edges);

}

#endif
