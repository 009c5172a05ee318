#ifndef dmgFieldToArrays_h
#define dmgFieldToArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Discretisations/Discretisation.h"
#include "Field.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace dmg
{

/// The arrays of a field on the cells, points and edges of a surface. Kept as long as the field stands,
/// so that other arrays on the surface cost nothing.
struct FieldArrays
{
  vtkSmartPointer<vtkFieldData> Cells;
  vtkSmartPointer<vtkFieldData> Points;
  vtkSmartPointer<vtkPolyData> Edges; ///< without points
};

/// \param input the surface as a dataset.
FieldArrays MakeFieldArrays(const FramedMesh& framed, const SurfaceRelation& surface,
  const Discretisation& discretisation, const Vector<double>& unknowns, const Field& field, vtkDataSet* input,
  const ExecutionContext& context);

/// Adds the arrays of cells and points to \p surface and makes its first direction the active
/// vectors; arrays that an earlier solver left there are removed. Makes \p edges its edges.
void AddFieldArrays(const FieldArrays& arrays, vtkDataSet* surface, vtkPolyData* edges);

/// Adds the weights of the prescribed elements to \p surface, or, where these are edges, to \p edges.
void AddPrescribed(const SurfaceRelation& relation, const FieldConstraints& constraints, ElementKind elements,
  vtkDataSet* surface, vtkPolyData* edges);

}

#endif
