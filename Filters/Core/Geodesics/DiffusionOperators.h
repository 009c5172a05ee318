#ifndef dmgDiffusionOperators_h
#define dmgDiffusionOperators_h

#include "Geodesics/IntrinsicTriangulation.h"
#include "Support/Types.h"

namespace dmg
{

/// The matrices M / t + L of diffusion for a time t on an intrinsic Delaunay triangulation, M the lumped mass, and L the Laplacian
/// of functions or the connection Laplacian of vectors that weighs edges by cotangents:
///
///   x^H L x = sum over edges w_ij |x_j - r_ij x_i|^2,   r_ij = 1 of functions, the transport along the edge of vectors.
///
/// Both are dimensionless and Hermitian positive definite. The first is an M-matrix, so heat is positive everywhere; and the heat of a vector is
/// nowhere longer than that of its length. Only the lower triangles are stored, for factors.
/// Sharp, Soliman and Crane 2019, section 5.
///
/// \param times t at each vertex, the same for all of a component.
/// Cost: O(#F).
SparseMatrix<double> DiffusionOfFunctions(const IntrinsicTriangulation& surface, const Vector<double>& times);
SparseMatrix<Complex> DiffusionOfVectors(const IntrinsicTriangulation& surface, const Vector<double>& times);

/// sum_j w_ij e_ij u_j at each vertex i, where the vector e_ij leads to its neighbour j. With heat u of a vertex s it is the
/// source of vectors v = u p, p the position of s as each vertex sees it: (p, 1) is parallel in the affine connection, which
/// also carries points (Soliman and Sharp 2025).
Vector<Complex> SourceOfPositions(const IntrinsicTriangulation& surface, const Vector<double>& u);

}

#endif
