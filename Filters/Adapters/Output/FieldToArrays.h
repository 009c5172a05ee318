#ifndef dmgFieldToArrays_h
#define dmgFieldToArrays_h

#include "Adapters/Surface/MeshFromPolyData.h"
#include "Discretisations/Discretisation.h"
#include "Support/ExecutionContext.h"

#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace dmg
{

/// The directions of a field, whatever length they are shown with.
struct ShownField
{
  bool Combing = false; ///< see vtkHarmonicFieldSolver.h
  int N = 1;
  FieldPowers Powers;
  Vector<Complex> OnFaces;              ///< first directions, in the frames of faces
  Vector<Complex> AtVertices;           ///< the same of vertices
  bool AreSingularitiesOnFaces = false; ///< rather than at vertices; the turning is then along edges, not across
  Vector<double> Indices;               ///< of these elements
  vtkSmartPointer<vtkPolyData> Edges;   ///< with their turning, without points
};

/// \param unknowns of the field, as FieldSolver::Solve returns them.
/// \param former of the same surface, whose first directions the new ones stay near to, if they are combed and of the
///   same N; or null.
/// Checkpoints: three, up to half a second per million faces apart.
ShownField ShowField(const FramedMesh& framed, const SurfaceNumbering& surface, const Discretisation& discretisation,
  const Vector<double>& unknowns, bool combing, const ShownField* former, const ExecutionContext& context);

/// The arrays of a field on the cells, points and edges of a surface. Kept as long as the field stands,
/// so that other arrays on the surface cost nothing.
struct FieldArrays
{
  bool UnitLength; ///< see vtkHarmonicFieldSolver.h
  vtkSmartPointer<vtkFieldData> Cells;
  vtkSmartPointer<vtkFieldData> Points;
  vtkSmartPointer<vtkPolyData> Edges; ///< without points
};

/// \param input the surface as vtkPolyData.
FieldArrays MakeFieldArrays(const FramedMesh& framed, const SurfaceNumbering& surface,
  const Discretisation& discretisation, const Vector<double>& unknowns, const ShownField& shown, bool unitLength,
  vtkPolyData* input, const ExecutionContext& context);

/// Adds the arrays of cells and points to \p surface and makes its first direction the active
/// vectors; arrays that an earlier solver left there are removed. Makes \p edges its edges.
void AddFieldArrays(const FieldArrays& arrays, vtkPolyData* surface, vtkPolyData* edges);

/// Adds the weights of the prescribed elements to \p surface, or, where these are edges, to \p edges.
void AddPrescribed(const SurfaceNumbering& numbering, const FieldConstraints& constraints, ElementKind elements,
  vtkPolyData* surface, vtkPolyData* edges);

}

#endif
