#ifndef dmgLinearProlongation_h
#define dmgLinearProlongation_h

#include "Levels/TransportOperator.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The rotations from the polar coordinates of a vertex into the frames of the faces around it:
/// per halfedge, for the vertex at its tail and its face. Polar angles at a vertex count from its
/// outgoing halfedge, counter-clockwise, and are stretched such that an inner vertex has 2 pi of
/// them, whatever its angles sum to (Knoeppel et al. 2013).
std::vector<Complex> CornerTurns(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context);

/// Prolongation of directions from the vertices of level 1 to the faces of level 0. Weights are the
/// mean of the rows of S0 at the corners of a face, so that the interpolant is linear where S0's is:
/// that makes power fields converge in a number of cycles that does not grow with the mesh, which
/// face-to-face injection does not. Turns follow SP from the fine face to the coarse faces around
/// the vertex: they belong to the conformal maps that tracked the levels, of all maps those that
/// spread the curvature most evenly. (The rotation between normals in space would carry the
/// smoothness energy of the fine surface into the coarse functions.)
/// \return #F_0 x #V_1, in face frames and in polar coordinates of the vertices.
TransportOperator FacesFromVertices(const TriangleMesh& fine, const SparseMatrix<double>& S0,
  const TransportOperator& SP, const TriangleMesh& coarse, const std::vector<Complex>& coarseCornerTurns,
  const ExecutionContext& context);

/// Prolongation of directions from the vertices of a coarse level to those of the next finer one:
/// weights of S0, turns as above, averaged over the faces around the fine vertex.
/// \return #V_l x #V_{l+1}, in polar coordinates.
TransportOperator VerticesFromVertices(const TriangleMesh& fine, const std::vector<Complex>& fineCornerTurns,
  const SparseMatrix<double>& S0, const TransportOperator& SP, const TriangleMesh& coarse,
  const std::vector<Complex>& coarseCornerTurns, const ExecutionContext& context);

}

#endif
