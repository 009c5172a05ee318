#ifndef dmgHarmonicForms_h
#define dmgHarmonicForms_h

#include "Levels/ProlongationOperators.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

/// Harmonic fields: curl-free and divergence-free. They span the kernel of the energy. On a closed surface of genus g there are 2 g
/// of them, around its handles. With b > 0 boundary loops there are 2 g + b - 1, none of which crosses the boundary.
namespace dmg
{

/// The number of homology generators: 2 g + b - 1 for a component of genus g with b > 0 boundary loops, 2 g for a closed
/// one, summed over the components. Cost: O(#E).
int NumberOfGenerators(const TriangleMesh& mesh);

/// Whether the harmonic fields of all generators take too much memory, as on noisy scans, which have handles by the hundred.
bool AreTooManyToHold(int generators, const TriangleMesh& mesh);

/// Closed 1-forms that are no gradients, one per homology generator, #E x (2 g + b - 1): a basis of the first cohomology by integers.
/// Tree and cotree (Eppstein 2003): the edges of a spanning tree of the vertices are contracted, and the faces are merged along a
/// spanning tree of theirs. One vertex, one face and the loops are left, where any numbers are closed and none is a gradient. Undone, the
/// contractions give their edges 0, and every face, from the leaves on, closes its sum by the edge to its parent. Each component has
/// trees of its own. Cost: O(#E) and O(#E) per form.
Eigen::MatrixXd ClosedForms(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// Closed forms by the hierarchy: those of its coarsest level (ProlongationOperators::ClosedForms),
/// prolonged by S1, which keeps their integrals around loops: the same classes, closed to rounding and as
/// smooth as the coarse level. Thesis, section 4.2.
/// \pre operators has both.
/// Cost: O(#E) per form.
Eigen::MatrixXd ProlongedClosedForms(const ProlongationOperators& operators, const ExecutionContext& context);

/// A basis of the harmonic 1-forms, the kernel of OneFormLaplacianFactor, #E x (2 g + b - 1): closed forms
/// less the gradients of u with d0^T star1 d0 u = d0^T star1 w. Columns are orthogonal and of length 1
/// for the Euclidean product.
/// \param operators of this mesh: where they have S1 and the forms of the coarsest level, the closed forms are
///   ProlongedClosedForms. Levels of samples, and what was stored, do not; there, and where it is null,
///   they are ClosedForms of the mesh itself.
/// \throw SolverFailure the scalar Laplacian could not be factored.
/// \throw Cancelled
/// Cost: one Cholesky factorisation for the vertices, if there is a loop at all, and three solves for all forms
/// at once; the closed forms cost little beside these.
Eigen::MatrixXd HarmonicForms(
  const TriangleMesh& mesh, const ExecutionContext& context, const ProlongationOperators* operators = nullptr);

/// A basis of the harmonic face fields, the kernel of FaceFieldSmoothnessFactor, 2 #F x (2 g + b - 1): the
/// vectors whose integrals along the sides of a face are those of the harmonic 1-forms. Columns are
/// orthogonal and of length 1.
Eigen::MatrixXd HarmonicFaceFields(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ExecutionContext& context, const ProlongationOperators* operators = nullptr);

}

#endif
