#ifndef dmgBasisToArrays_h
#define dmgBasisToArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Field.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"

namespace dmg
{

/// Adds the basis of harmonic fields that a field comes with to the cells of a view's output and, where the field is one of numbers on
/// edges, to \p edges.
/// \throw Cancelled
void AddBasis(const SurfaceView& view, const Field& field, vtkPolyData* edges, const ExecutionContext& context);

}

#endif
