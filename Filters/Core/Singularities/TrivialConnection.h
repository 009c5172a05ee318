#ifndef dmgTrivialConnection_h
#define dmgTrivialConnection_h

#include "Analysis/TreeCotree.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

/// Fields whose singularities are prescribed, by trivial connections (Crane, Desbrun and Schroeder 2010).
///
/// A field that turns by t_e across each edge e, from the face of HalfedgeOf(e) to that of its twin, besides the parallel
/// transport, has the singularities k_v / N if and only if
///
///   the rotations around each inner vertex v, counter-clockwise, sum to 2 pi k_v / N less the angle defect there, and
///   along each loop over faces, rotations and transports sum to a multiple of 2 pi / N.
///
/// The rotation with the least t^T star1^-1 t is t = star1 (d0 psi + sum_k c_k w_k). psi, a number per vertex, is zero on
/// the boundary and solves L0 psi = 2 pi k / N - defect at inner vertices, L0 = d0^T star1 d0. w_k = l_k - d0 u_k are harmonic
/// 1-forms that vanish on the boundary, made of the loops l_k (GeneratorsOverFaces) by L0 u_k = d0^T star1 l_k. They turn
/// nothing around vertices, and w_k turns loop j by l_j^T star1 w_k = w_j^T star1 w_k: a symmetric positive definite
/// matrix, whose inverse gives c for any multiples of 2 pi / N around the loops.
namespace dmg
{

/// 2 pi less the angles around each inner vertex; 0 on the boundary. Over a closed component they sum to 2 pi times its Euler
/// characteristic. Cost: O(#F).
Vector<double> AngleDefects(
  const TriangleMesh& mesh, const Unfilled<Corner>& corners, const ExecutionContext& context = SerialContext());

/// The rotation of parallel transport along each loop.
/// \param sides SideDirections of all faces.
/// \param loops as GeneratorsOverFaces.
/// Cost: their length, and O(#E).
Vector<double> RotationOfTransport(
  const TriangleMesh& mesh, const Unfilled<Complex>& sides, const SparseMatrix<double>& loops);

/// Integers n near to x: of least (n - x)^T E (n - x) among all that differ from them in one number.
/// \param energy E, symmetric positive definite.
Vector<double> NearestIntegers(const Eigen::MatrixXd& energy, const Vector<double>& x);

/// Turns faces, each as a whole, until no edge with two faces is turned across by more than \p limit: else the directions of
/// the two, which are all that is left in the end, would be matched in another way, and show other singularities. Turning a
/// face changes no sum around a vertex or along a loop. The faces beside the edges are turned as little as is enough, and
/// those around them where that is not. Edges stay as they are at vertices where the sum is more than they can share: at
/// singularities of many turns, and at spikes.
/// Cost: O(#E), and a few steps for each such edge.
void LimitRotation(const TriangleMesh& mesh, double limit, Vector<double>& rotation);

/// N-th powers of length 1 in the frames of the faces: 1 at the root of each component, and carried along the faces' tree
/// by parallel transport and \p rotation. Cost: O(#F).
Vector<Complex> PowersOfConnection(const TriangleMesh& mesh, const Unfilled<Complex>& sides, const TreeCotree& trees,
  const Vector<double>& rotation, int N);

}

#endif
