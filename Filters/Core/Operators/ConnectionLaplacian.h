#ifndef dmgConnectionLaplacian_h
#define dmgConnectionLaplacian_h

#include "Mesh/VertexConnection.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The integrals of linear elements on a triangle over which curvature is spread evenly. Element j is the barycentric
/// coordinate of corner j times its unit section, which is carried from the corner along straight lines; it turns
/// against that of corner k by s times the coordinate of the third corner i. With m = 1 - t and the weight e^{i s t} for t
/// from 0 to 1 these are the integrals of
///
///   OfSquares   -i s (m^2 / 2 - m^3 / 3) - s^2 (m^4 / 12 - m^5 / 20)
///   OfProduct   m - i s m^3 / 3 - s^2 (m^3 / 6 - m^4 / 6 + m^5 / 15)
///
/// and with p_j, p_k the sides from corner i to j and k, A the area, r the transport from j to k, to the N-th power
///
///   stiffness jk = conj(r) / (2 A) (OfSquares (|p_j|^2 + |p_k|^2) - OfProduct <p_j, p_k>)
///   stiffness ii = 1 / (4 A) (|p_k - p_j|^2 + s^2 / 90 (|p_j|^2 + |p_k|^2 + <p_j, p_k>))
///
/// as in the appendix of Knoeppel et al. 2013. A flat triangle has 0 and 1/2.
struct CurvedElementIntegrals
{
  /// \param s N times the curvature of the triangle, in radians. Any; all digits hold near 0, too.
  explicit CurvedElementIntegrals(double s);

  Complex OfSquares;
  Complex OfProduct;
};

/// The connection Laplacian of linear elements: X^H L X is the Dirichlet energy, the integral of |grad X|^2, of the
/// section of the N-th power of the tangent bundle with values X at the vertices. #V x #V, dimensionless, Hermitian,
/// positive semi-definite on any triangles, since it is an integral of squares; where the surface is flat it is the
/// cotangent Laplacian. Its entries have the signs of cotangents. On the unit sphere its lowest eigenvalue tends to N.
/// Areas of slivers are raised to 1e-6 times the square of their longest side.
/// Cost: O(#F). Knoeppel et al. 2013, section 4.
SparseMatrix<Complex> ConnectionLaplacian(const TriangleMesh& mesh, const VertexConnection& connection, int N,
  const ExecutionContext& context = SerialContext());

/// The same, rows and columns in another order.
/// \param order [i] is the vertex of row i; a permutation.
SparseMatrix<Complex> ConnectionLaplacian(const TriangleMesh& mesh, const VertexConnection& connection, int N,
  const std::vector<int>& order, const ExecutionContext& context);

/// The mass of linear elements on flat triangles, lumped: a third of the area of the faces around each vertex; #V.
Vector<double> LumpedMass(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

}

#endif
