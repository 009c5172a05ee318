#ifndef dmgBasisToArrays_h
#define dmgBasisToArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Discretisations/Discretisation.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>

namespace dmg
{

/// The arrays of harmonic fields on the cells and edges of a surface. Kept as long as the surface
/// stands.
struct BasisArrays
{
  std::string Fields;                  ///< whose they are: the discretisation's name
  int NumberOfFields;                  ///< how many harmonic fields there are
  bool TooMany;                        ///< to hold (AreTooManyToHold): then there are no arrays
  vtkSmartPointer<vtkFieldData> Cells; ///< vectors, one array per field
  vtkSmartPointer<vtkFieldData> Edges; ///< numbers on edges, one array per field, of discretisations that have such
};

/// \pre discretisation.HasHarmonicFields()
/// \param known harmonic fields of this discretisation (FieldSolver::HarmonicFields); without columns they are computed.
/// \param input the surface as a dataset.
/// \throw SolverFailure as HarmonicForms and HarmonicBasisOfForms.
/// \throw Cancelled
BasisArrays MakeBasisArrays(const FramedMesh& framed, const SurfaceRelation& surface,
  const Discretisation& discretisation, Eigen::MatrixXd known, vtkDataSet* input, const ExecutionContext& context);

/// Adds the arrays to the cells of the surface and of its edges.
void AddBasisArrays(const BasisArrays& arrays, vtkDataSet* surface, vtkPolyData* edges);

/// Adds the number of arrays to \p fieldData.
void AddBasisSize(const BasisArrays& arrays, vtkFieldData* fieldData);

/// Takes away the basis that an earlier solver left, of any size.
void RemoveBasis(vtkDataSet* surface);

}

#endif
