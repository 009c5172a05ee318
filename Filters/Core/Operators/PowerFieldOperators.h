#ifndef dmgPowerFieldOperators_h
#define dmgPowerFieldOperators_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Angle that carries a direction across an interior edge, from the frame of the face of
/// \p halfedge into the frame of the face of its twin: unfold both faces into one plane along the
/// edge.
/// \pre the halfedge has a twin.
double TransportAcrossEdge(const TriangleMesh& mesh, const TangentFrames& faceFrames, int halfedge);

/// Weight of each interior edge in the smoothness energy, 3 |e|^2 / (A_f + A_g); #E, dimensionless,
/// 0 on the boundary. Twice the consistent two-point flux, as in the thesis. A_f + A_g of slivers
/// is raised to 1e-6 |e|^2 so that zero-area faces keep a finite weight; an edge of no length has
/// none.
Vector<double> PowerEdgeWeights(const TriangleMesh& mesh);

/// The Laplacian of N-power fields: X^H L X = sum over interior edges of
///   w_e |X_f conj(e_f)^N - X_g conj(e_g)^N|^2,
/// e_f the unit edge in the frame of f. #F x #F, at most four entries per row, Hermitian, positive
/// semi-definite. On a flat patch its kernel are the parallel fields. Cost: O(#F).
/// Thesis, section 6.3.
SparseMatrix<Complex> PowerLaplacian(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  int N, const ExecutionContext& context = SerialContext());

/// The same, rows and columns in another order.
/// \param order [i] is the face of row i; a permutation. Faster where neighbours follow each other.
SparseMatrix<Complex> PowerLaplacian(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  int N, const std::vector<int>& order, const ExecutionContext& context);

/// The N directions of a power field per element: result[k] is # x 3, the k-th root, of the power's
/// magnitude or of unit length (zero where the power is zero). Directions are 2 pi / N apart and
/// counter-clockwise.
/// \param labels which root comes first, per element; empty for the principal one.
std::vector<Points> DirectionsFromPowers(const TangentFrames& frames, const Vector<Complex>& powers,
  int N, bool unitLength, const std::vector<int>& labels = {});

/// Which root of each face continues direction 0 of its neighbour, along a tree over the faces that
/// crosses the edges of least turning first: direction 0 is then continuous but for a cut, which
/// vanishes on a disc without singularities. Cost: O(#F).
std::vector<int> CombingLabels(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& powers, int N);

/// Powers at the vertices: the mean of the faces around, by corner angle, each carried into the
/// tangent plane of the vertex by the shortest rotation between the normals.
Vector<Complex> PowersAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Vector<Complex>& powers, int N);

/// Which root at each vertex is nearest to direction 0 of the faces around it (combed by
/// \p faceLabels).
std::vector<int> VertexLabels(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Vector<Complex>& facePowers,
  const std::vector<int>& faceLabels, const Vector<Complex>& vertexPowers, int N);

/// Index of the singularity at each vertex, a multiple of 1/N, 0 at regular and at boundary
/// vertices: (angle defect + turning of the field around the vertex) / 2 pi, where the field turns
/// between two faces by the smallest angle that matches their directions. On a closed surface they
/// sum to the Euler characteristic. A vertex beside a zero power has no well-defined index; any
/// multiple may result, the sum still holds.
Vector<double> SingularityIndices(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& powers, int N);

}

#endif
