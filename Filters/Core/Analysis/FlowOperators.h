#ifndef dmgFlowOperators_h
#define dmgFlowOperators_h

#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

/// Derivatives of flows: tangent vectors that are constant on each face, as complex numbers in the face's frame, so that i X is X
/// after a quarter turn counter-clockwise. Nothing is solved for. All functions cost O(#F).
namespace dmg
{

/// The gradient of a function that is linear on faces, #F. In a degenerate face, the part along its longest side.
Vector<Complex> GradientOnFaces(
  const FramedMesh& surface, const Vector<double>& u, const ExecutionContext& context = SerialContext());

/// The divergence, integrated with the function lambda_v that is 1 at vertex v and 0 at all others; #V:
///   (D X)_v = - sum over faces f around v of A_f X_f . grad lambda_v .
/// It sums to zero. At boundary vertices it also holds, with a minus, the flux out of the surface. That of -i X is the vorticity,
/// and holds the circulation along the boundary.
Vector<double> IntegratedDivergence(
  const FramedMesh& surface, const Vector<Complex>& X, const ExecutionContext& context = SerialContext());

/// Integrals around vertices divided by a third of the area of the faces around, #V. A boundary vertex has the mean of its
/// inner neighbours, as its own integral holds what crosses or follows the boundary, and zero where it has none.
Vector<double> DensityAtVertices(
  const TriangleMesh& mesh, const Vector<double>& integrals, const ExecutionContext& context = SerialContext());

/// The integral of <X, Y> over the surface.
double FlowProduct(const Vector<double>& areas, const Vector<Complex>& X, const Vector<Complex>& Y);

}

#endif
