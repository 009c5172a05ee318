#ifndef dmgHarmonicField_h
#define dmgHarmonicField_h

#include "HarmonicProblem.h"
#include "Hierarchy/HierarchyOptions.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Prolongation/ProlongationOperators.h"
#include "Support/ExecutionContext.h"
#include "Systems/AlignmentConstraints.h"

#include <vector>

/// The straight line from a mesh to the smoothest field that follows prescribed directions:
///
///   mesh -> ProlongationOperators (set-up) -> HarmonicProblem (system) -> Solve (solve).
///
/// Each stage keeps what the later ones do not change: a moved constraint only solves again, another
/// set of constraints or other weights redo the system, and only another mesh redoes the set-up.
namespace dmg
{

/// A hierarchy of a mesh and the prolongations between its levels.
struct SurfaceHierarchy
{
  /// The levels above the finest, level 1 first.
  std::vector<TriangleMesh> CoarseLevels;
  ProlongationOperators Operators;
};

/// Set-up. The only stage that decimates.
/// \throw Cancelled
/// Checkpoints: every round of collapses.
SurfaceHierarchy BuildSurfaceHierarchy(
  const TriangleMesh& mesh, const HierarchyOptions& options, const ExecutionContext& context);

/// Which prolongations the V-cycle's coarse spaces come from.
enum class CoarseSpaceKind
{
  /// Directions at the vertices of the coarse levels; Galerkin. The fast one.
  Nodal,
  /// The thesis's SP, face to face; Galerkin.
  FacePowers,
};

struct PowerFieldOptions
{
  /// The field has N directions per point, 2 pi / N apart; 1 to 8.
  int N = 4;
  /// Weight lambda_S of the smoothness energy, > 0.
  double Smoothness = 1.0;
  /// Weight lambda_A of soft constraints, > 0. At 1, a prescribed face of mean area pulls as hard as
  /// one of its edges does.
  double Alignment = 1.0;
  ConstraintKind Constraints = ConstraintKind::Soft;
  CoarseSpaceKind CoarseSpace = CoarseSpaceKind::Nodal;
  SolverKind Solver = SolverKind::Automatic;
  /// Gauss-Seidel sweeps before and after the coarse correction of each coarse level, >= 1. On nodal
  /// levels the finest level gets twice as many.
  int Sweeps = 2;
};

/// The smoothest N-direction field that follows prescribed directions, on one mesh, for one set of
/// prescribed faces and weights. Thesis, section 6.3, as
///   argmin  Smoothness X^H L X + Alignment sum_b w_b (A_b / mean A) |X_b - Y_b|^2   (soft)
///   argmin  X^H L X  subject to  X_b = Y_b                                          (hard)
/// A component of the surface that holds no prescribed face gets the zero field.
/// Unknowns are #F powers in the face frames, values one power per prescribed face.
/// \param operators of this mesh; may be null for SolverKind::Cholesky. Copied where needed.
/// \throw InvalidInput options out of range, no prescribed face, every face prescribed hard.
/// \throw SolverFailure the factorisation failed.
HarmonicProblem<Complex> MakePowerFieldProblem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const PrescribedFaces& prescribed, const PowerFieldOptions& options,
  const ExecutionContext& context);

}

#endif
