#ifndef dmgFittedDerivatives_h
#define dmgFittedDerivatives_h

#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceRelation.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <string>
#include <vector>

/// Divergence and vorticity of flows as they were given, before they are averaged to vectors on triangles. Around each vertex the
/// derivatives are those of the linear flow that is nearest to the data of the cells there, in the sense of least squares. So linear flows
/// in a plane are exact, on any triangles, quadrilaterals and polygons, and at boundaries. On smooth surfaces errors are at most of the order
/// of the cells. Cells beyond those around a vertex take part where these do not determine a linear flow, as at most boundary vertices. Where
/// those three cells away do not, either, both derivatives are NaN: so they are in strips one cell wide, of whose flow cells or edges know
/// nothing across.
/// All functions cost O(#F).
namespace dmg
{

/// NaN where the data do not determine them.
struct DerivativesAtVertices
{
  Vector<double> Divergence; ///< #V, flow over length
  /// #V, counter-clockwise as the corners of the faces are. Times SidesOfSurface::OfVertices it is as seen from the positive side.
  Vector<double> Vorticity;
};

/// The warning that derivatives are NaN, with their number and the reason; empty where none are.
std::string WarningOfUndetermined(const DerivativesAtVertices& derivatives);

/// The means of the corners of the cells, #F x 3: row f is that of the cell of face f. A corner counts as often as it was written, as the pole in
/// a quadrilateral of a globe (SurfaceRelation::CentreOf).
Points CellCentres(const TriangleMesh& mesh, const SurfaceRelation& relation);

/// \param vectors in space at the vertices, #V x 3; their tangential parts count, without those along normals (WithoutNormalParts).
DerivativesAtVertices DerivativesOfVertexVectors(const FramedMesh& surface, const SurfaceRelation& relation,
  const Points& vectors, const ExecutionContext& context = SerialContext());

/// \param vectors in space, #F x 3: row f is that of the cell of face f; their tangential parts count, without those along normals
/// (WithoutNormalPartsOfCells). \param places where these vectors stand, such as the CellCentres.
DerivativesAtVertices DerivativesOfCellVectors(const FramedMesh& surface, const SurfaceRelation& relation,
  const Points& vectors, const Points& places, const ExecutionContext& context = SerialContext());

/// The vorticity is the circulation of the faces around over their area, so that of a closed form is zero.
/// \param form integrals along the edges of the mesh, each from its smaller vertex to its larger one (FillDiagonals).
/// \param isGiven by edge; others, as diagonals of polygons, do not count for the divergence.
DerivativesAtVertices DerivativesOfForm(const FramedMesh& surface, const SurfaceRelation& relation,
  const Vector<double>& form, const std::vector<char>& isGiven, const ExecutionContext& context = SerialContext());

}

#endif
