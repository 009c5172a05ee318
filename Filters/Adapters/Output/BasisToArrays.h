#ifndef dmgBasisToArrays_h
#define dmgBasisToArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Discretisations/Discretisation.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace dmg
{

/// The arrays of harmonic fields on the cells and edges of a surface. Kept as long as the surface
/// stands.
struct BasisArrays
{
  vtkSmartPointer<vtkFieldData> Cells; ///< vectors, one array per field
  vtkSmartPointer<vtkFieldData> Edges; ///< numbers on edges, one array per field, of discretisations that have such
};

/// \param basis of the discretisation's harmonic fields, a column each.
/// \param input the surface as a dataset.
/// \throw Cancelled
BasisArrays MakeBasisArrays(const FramedMesh& framed, const SurfaceRelation& surface,
  const Discretisation& discretisation, const Eigen::MatrixXd& basis, vtkDataSet* input,
  const ExecutionContext& context);

/// Adds the arrays to the cells of the surface and of its edges.
void AddBasisArrays(const BasisArrays& arrays, vtkDataSet* surface, vtkPolyData* edges);

/// Adds the number of arrays to \p fieldData.
void AddBasisSize(const BasisArrays& arrays, vtkFieldData* fieldData);

/// Takes away the basis that an earlier solver left, of any size.
void RemoveBasis(vtkDataSet* surface);

}

#endif
