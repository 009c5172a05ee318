#ifndef dmgTrivialConnection_h
#define dmgTrivialConnection_h

#include "Analysis/TreeCotree.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

/// Fields whose singularities are prescribed, by trivial connections (Crane, Desbrun and Schroeder 2010).
///
/// A field that rotates by t_e across each edge e, from the face of HalfedgeOf(e) to that of its twin, besides the parallel
/// transport, has the singularities k_v / N if and only if
///
///   the rotations around each inner vertex v, counter-clockwise, sum to 2 pi k_v / N less the angle defect there, and
///   along each homology generator, rotations and transports sum to a multiple of 2 pi / N.
///
/// The rotation with the least t^T star1^-1 t is t = star1 (d0 psi + sum_k c_k w_k). psi, a number per vertex, is zero on
/// the boundary and solves L0 psi = 2 pi k / N - defect at inner vertices, L0 = d0^T star1 d0. w_k = l_k - d0 u_k are harmonic
/// 1-forms that vanish on the boundary, made of the generators l_k (GeneratorsOverFaces) by L0 u_k = d0^T star1 l_k. The rotations
/// star1 w_k sum to zero around vertices, and along generator j to l_j^T star1 w_k = w_j^T star1 w_k. This matrix is symmetric positive
/// definite. Its inverse gives c for any multiples of 2 pi / N along the generators.
namespace dmg
{

/// 2 pi less the angles around each inner vertex; 0 on the boundary. Over a closed component they sum to 2 pi times its Euler
/// characteristic. Cost: O(#F).
Vector<double> AngleDefects(
  const TriangleMesh& mesh, const Unfilled<Corner>& corners, const ExecutionContext& context = SerialContext());

/// The rotation of parallel transport along each homology generator.
/// \param sides SideDirections of all faces.
/// \param generators as GeneratorsOverFaces.
/// Cost: their length, and O(#E).
Vector<double> RotationOfTransport(
  const TriangleMesh& mesh, const Unfilled<Complex>& sides, const SparseMatrix<double>& generators);

/// Integers n near to x: of least (n - x)^T E (n - x) among all that differ from them in one number.
/// \param energy E, symmetric positive definite.
Vector<double> NearestIntegers(const Eigen::MatrixXd& energy, const Vector<double>& x);

/// Rotates the frames of faces until no rotation across an inner edge exceeds \p limit. Beyond pi / N, the directions of two faces match
/// another way and show other singularities. Rotating a face changes no sum around a vertex or along a generator.
///
/// The faces beside such an edge are rotated as little as is enough, and where that fails, those around them, too. Edges stay as they
/// are at vertices whose sum is more than they can share: at singularities of large index, and at spikes.
/// Cost: O(#E), and a few steps for each such edge.
void LimitRotation(const TriangleMesh& mesh, double limit, Vector<double>& rotation);

/// N-th powers of length 1 in the frames of the faces: 1 at the root of each component, and carried along the faces' tree
/// by parallel transport and \p rotation. Cost: O(#F).
Vector<Complex> PowersOfConnection(const TriangleMesh& mesh, const Unfilled<Complex>& sides, const TreeCotree& trees,
  const Vector<double>& rotation, int N);

}

#endif
