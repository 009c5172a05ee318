#ifndef dmgPowerFieldOperators_h
#define dmgPowerFieldOperators_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// z^N, N >= 1.
inline Complex Power(Complex z, int N)
{
  Complex power = z;
  for (int n = 1; n < N; ++n)
  {
    power *= z;
  }
  return power;
}

/// The rotation e^{i angle} that carries a direction across an edge, from the frame of one face into that of the other: both
/// are unfolded into one plane along the edge.
/// \param side, sideOfTwin SideDirections of the edge in the two faces, which run along it in opposite directions.
inline Complex TransportOfSides(Complex side, Complex sideOfTwin)
{
  return -sideOfTwin * std::conj(side);
}

/// Weight of the edge of a halfedge in the smoothness energy, 3 |e|^2 / (A_f + A_g), dimensionless; 0 on the boundary. As in the
/// thesis; on equilateral triangles twice the consistent two-point flux. Elsewhere it is not consistent: on a grid with all
/// diagonals alike, a linear field of slope p has 3 |p|^2 along one diagonal and 1.5 |p|^2 along the other. A_f + A_g of slivers
/// is raised to 1e-6 |e|^2 so that zero-area faces keep a finite weight; an edge of no length has none.
double PowerEdgeWeight(const TriangleMesh& mesh, int halfedge);

/// The Laplacian of N-power fields: X^H L X = sum over interior edges of
///   w_e |X_f conj(e_f)^N - X_g conj(e_g)^N|^2,
/// e_f the unit edge in the frame of f. #F x #F, at most four entries per row, Hermitian, positive
/// semi-definite. On a flat patch its kernel are the parallel fields. Cost: O(#F).
/// Thesis, section 6.3.
SparseMatrix<Complex> PowerLaplacian(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, int N, const ExecutionContext& context = SerialContext());

/// The same, rows and columns in another order.
/// \param order [i] is the face of row i; a permutation. Faster where neighbours follow each other.
SparseMatrix<Complex> PowerLaplacian(const TriangleMesh& mesh, const TangentFrames& faceFrames, int N,
  const std::vector<int>& order, const ExecutionContext& context);

}

#endif
