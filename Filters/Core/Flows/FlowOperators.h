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

/// The vectors of a 1-form, which has the integral of a flow for each edge, from its smaller vertex to its larger one; #F. On each face
/// the vector whose integrals along its sides are nearest to those of the form, which is that of the form's Whitney interpolant at
/// the centre. Exact where the form is closed, so that differences of a function give its gradient.
Vector<Complex> FlowOfForm(
  const FramedMesh& surface, const Vector<double>& form, const ExecutionContext& context = SerialContext());

/// Derivatives of a flow X, integrated with the function lambda_v that is 1 at vertex v and 0 at all others.
struct FlowDerivatives
{
  /// (D X)_v = - sum over faces f around v of A_f X_f . grad lambda_v , #V. It sums to zero. At boundary vertices it also holds, with a
  /// minus, the flux out of the surface.
  Vector<double> Divergence;
  /// D (-i X). At boundary vertices it also holds, with a minus, the circulation along the boundary.
  Vector<double> Vorticity;
};
FlowDerivatives IntegratedDerivatives(
  const FramedMesh& surface, const Vector<Complex>& X, const ExecutionContext& context = SerialContext());

/// Shares of the flow out of the surface (real part) and along the boundary with the surface to the left (imaginary part) around a boundary vertex:
/// those of the boundary edges before and after it. Both sum to -(D X)_v and -(D (-i X))_v. Each edge has the half that is
/// nearer to the vertex, and half of the rest, which is the divergence between the faces around: so a constant flow is exact in a plane.
struct SharesOfEdges
{
  Complex Before;
  Complex After;
};
SharesOfEdges BoundaryFlowAt(int vertex, const FramedMesh& surface, const Vector<Complex>& X);

/// The integral of <X, Y> over the surface.
double FlowProduct(const Vector<double>& areas, const Vector<Complex>& X, const Vector<Complex>& Y);

}

#endif
