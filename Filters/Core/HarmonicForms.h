#ifndef dmgHarmonicForms_h
#define dmgHarmonicForms_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

/// The fields without curl and divergence: what a most harmonic field is free to be where nothing is
/// prescribed. On a closed surface of genus g there are 2 g of them, around its handles; with b > 0
/// boundary loops 2 g + b - 1, none of which crosses the boundary.
namespace dmg
{

/// How many independent loops the surface has, 2 g + b - 1 summed over its components (2 g where b is
/// zero). Cost: O(#E).
int NumberOfLoops(const TriangleMesh& mesh);

/// Scans have handles by the hundred where they are noisy; what all of their harmonic fields have to
/// say is not worth gigabytes. \return whether the fields of so many loops are more than that.
bool AreTooManyToHold(int loops, const TriangleMesh& mesh);

/// Closed 1-forms that are no gradients, one per independent loop, #E x (2 g + b - 1): a basis of
/// the first cohomology by integers. Tree and cotree (Eppstein 2003): edges of a spanning tree of the
/// vertices get 0, one of the edges that neither tree holds gets 1, and every face, from the leaves of
/// a spanning tree of the faces, closes its sum by the edge to its parent. Components one by one.
/// Cost: O(#E) and O(#E) per form.
Eigen::MatrixXd ClosedForms(
  const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// A basis of the harmonic 1-forms, the kernel of OneFormLaplacian, #E x (2 g + b - 1): closed forms
/// less the gradients of u with d0^T star1 d0 u = d0^T star1 w. (The kernel of a coarse level, prolonged by S1, has
/// the same classes. But levels of samples have no meshes and no S1, integers are exact, and the scalar solve, most
/// of the work, is the same.) Columns are orthogonal and of length 1
/// for the Euclidean product.
/// \throw SolverFailure the scalar Laplacian could not be factored.
/// \throw Cancelled
/// Cost: one Cholesky factorisation for the vertices, if there is a loop at all, and three solves for all forms
/// at once.
Eigen::MatrixXd HarmonicForms(const TriangleMesh& mesh, const ExecutionContext& context);

/// A basis of the harmonic face fields, the kernel of FaceFieldSmoothness, 2 #F x (2 g + b - 1): the
/// vectors whose integrals along the sides of a face are those of the harmonic 1-forms. Columns are
/// orthogonal and of length 1.
Eigen::MatrixXd HarmonicFaceFields(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context);

}

#endif
