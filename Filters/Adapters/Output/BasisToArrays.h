#ifndef dmgBasisToArrays_h
#define dmgBasisToArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Field.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"

namespace dmg
{

/// Adds the basis of harmonic fields that a field comes with to the cells of \p surface and, where the field is one of numbers on
/// edges, to \p edges. Removes the basis that an earlier solver left, of any size.
/// \throw Cancelled
void AddBasis(const FramedSurface& on, const Field& field, vtkDataSet* surface, vtkPolyData* edges,
  const ExecutionContext& context);

}

#endif
