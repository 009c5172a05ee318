#ifndef dmgHarmonicBasis_h
#define dmgHarmonicBasis_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

#include <Eigen/Core>

/// The harmonic fields of a surface as a basis to look at and to expand in: the integral of
/// <v, w> over the surface is 1 for a field with itself and 0 for two of them. (HarmonicForms has
/// the same spaces; there the numbers are orthonormal, whatever the size of their edges and faces.)
namespace dmg
{

/// Harmonic 1-forms, #E x (2 g + b - 1), whose vectors at the faces (WhitneyAtFaces) are
/// orthonormal in the product that is weighted by the areas of the faces. That is the integral: a
/// closed form is a gradient in each face, and its interpolant constant there. The vectors have the
/// unit 1 / length, the numbers none.
/// \param forms any basis of them: HarmonicForms, or what a solver takes out (FieldSolver::HarmonicFields).
/// \throw SolverFailure forms differ only in faces without area.
/// \throw Cancelled
/// Cost: O(#F (2 g + b - 1)^2). Memory: besides the result, two numbers per face and form.
Eigen::MatrixXd HarmonicBasisOfForms(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, Eigen::MatrixXd forms, const ExecutionContext& context);

/// Harmonic face fields, 2 #F x (2 g + b - 1), orthonormal in the product that is weighted by the
/// areas of the faces, from any basis of them (HarmonicFaceFields). Errors and cost as above.
Eigen::MatrixXd HarmonicBasisOfFaceFields(
  const TriangleMesh& mesh, Eigen::MatrixXd fields, const ExecutionContext& context);

}

#endif
