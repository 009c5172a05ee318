#ifndef dmgHarmonicField_h
#define dmgHarmonicField_h

#include "HarmonicProblem.h"
#include "Hierarchy/HierarchyOptions.h"
#include "RoughnessProblem.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/ExecutionContext.h"
#include "SurfaceHierarchy.h"
#include "Systems/AlignmentConstraints.h"
#include "Systems/OneFormConstraints.h"

#include <memory>
#include <optional>
#include <variant>
#include <vector>

/// The straight line from a mesh to the smoothest field that follows prescribed directions:
///
///   mesh -> ProlongationOperators (set-up) -> HarmonicProblem (system) -> Solve (solve).
///
/// Each stage keeps what the later ones do not change: a moved constraint only solves again, another
/// set of constraints or other weights redo the system, and only another mesh redoes the set-up.
namespace dmg
{

/// Which prolongations multigrid's coarse spaces come from.
enum class CoarseSpaceKind
{
  /// Vectors at the vertices of the coarse levels, whatever the fine level holds; the fast one.
  Nodal,
  /// The thesis's, which keep structure: S1, SX or SP.
  StructurePreserving,
};

/// What the unknowns of a field are.
enum class Discretisation
{
  /// The N-th power of N directions per face: one complex number in the face's frame. Thesis, 6.3.
  PowerField,
  /// A vector per face: two numbers in the face's frame. Thesis, 6.2.
  FaceField,
  /// A number per edge, the integral of a 1-form. Thesis, 6.1.
  OneForm,
};

struct FieldOptions
{
  Discretisation Kind = Discretisation::PowerField;
  /// Power fields have N directions per point, 2 pi / N apart; 1 to 8. The others have one.
  int N = 4;
  /// Weight of the roughness, > 0.
  double Smoothness = 1.0;
  /// Weight of soft constraints, > 0. At 1, a prescribed face of mean area pulls a power field as hard
  /// as one of its edges does.
  double Alignment = 1.0;
  ConstraintKind Constraints = ConstraintKind::Soft;
  CoarseSpaceKind CoarseSpace = CoarseSpaceKind::Nodal;
  /// Of 1-forms: the star of 0-forms.
  VertexAreas Areas = VertexAreas::MixedVoronoi;
  /// LargestForCholesky is that of the discretisation; and on nodal levels the finest gets the sweeps and
  /// the smoothed interpolation that suit it; whatever is said here.
  SolverOptions Solver;

  /// Directions per point.
  int NumberOfDirections() const { return this->Kind == Discretisation::PowerField ? this->N : 1; }
};

/// Power fields. Unknowns and values are those of MakePowerFieldSystem, in their order.
/// \param operators of this mesh; may be null for SolverKind::Cholesky and Automatic. Used during the
///   call only. Where they have one level the system is factored, whatever solver is asked for.
/// \throw InvalidInput options out of range, nothing prescribed, nothing left to solve for, or operators
///   that lack those of the discretisation.
/// \throw SolverFailure the factorisation failed.
HarmonicProblem<Complex> MakePowerFieldProblem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const PrescribedFaces& prescribed, const FieldOptions& options,
  const ExecutionContext& context);

/// Directions prescribed on faces, as a discretisation takes them.
struct FieldConstraints
{
  // Key of the system.
  std::vector<int> Elements;   ///< faces, or edges for 1-forms; ascending, each once
  std::vector<double> Weights; ///< one per element, > 0
  // Key of the solution.
  Vector<double> Values; ///< two per face: the N-th power or the vector, in its frame; one per edge
};

/// Directions on faces and at vertices. See MakePowerConstraints, with N = 1 for face fields, which get
/// those at vertices on the faces around (CarriedIntoFaces); for 1-forms OneFormConstraintsOnFaces,
/// OneFormConstraintsAtVertices and Joined.
FieldConstraints MakeFieldConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const PrescribedDirections& directions,
  const FieldOptions& options, const ElementNames& names = {});

/// The same with directions on faces only.
FieldConstraints MakeFieldConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<PrescribedDirection>& directions, const FieldOptions& options,
  const ElementNames& names = {});

/// Whether the solver that is asked for, or chosen, needs levels of the surface.
bool NeedsLevels(const TriangleMesh& mesh, const FieldOptions& options);

/// The levels that suit a solver, where none are at hand: samples for cycles, which need nothing that
/// samples do not give, and take a fifth of the time; the thesis's where these are asked for.
HierarchyOptions LevelsFor(const FieldOptions& options);

/// Whether cycles solve this from a RoughnessSurface.
/// \param operators of this mesh; null if there are none: LevelsFor count.
bool UsesRoughnessSurface(
  const TriangleMesh& mesh, const ProlongationOperators* operators, const FieldOptions& options);

/// The last part of the set-up: what cycles on nodal levels need, whatever is prescribed.
/// \param operators of this mesh; used during the call only. Null: samples are taken (LevelsFor), and
///   forgotten as soon as possible; they are much memory, and made in less time than what is made of them.
/// \param options Kind, N, Areas and the choice of the solver count.
/// \return null where UsesRoughnessSurface says no, or there are too few faces for samples.
/// Cost: several products of sparse matrices; 8 to 12 us per face with two threads, 2 for power fields.
std::shared_ptr<const RoughnessSurface> MakeRoughnessSurface(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const FieldOptions& options, const ExecutionContext& context);

/// The smoothest field that follows prescribed directions, whatever its discretisation: one mesh, one
/// set of prescribed elements and weights. A component of the surface that holds none of them gets the
/// zero field.
class FieldProblem
{
public:
  /// System. Unknowns and values are those of MakePowerFieldSystem, MakeFaceFieldSystem and
  /// MakeOneFormSystem, in their order; errors as above. The values of the constraints are not looked
  /// at.
  /// \param operators null: samples, where these do.
  /// \param surface of this mesh and these options, if it is at hand; else it is made if needed.
  /// \throw InvalidInput the surface was set up for another discretisation or another N.
  FieldProblem(const TriangleMesh& mesh, const TangentFrames& faceFrames,
    const ProlongationOperators* operators, const FieldConstraints& constraints,
    const FieldOptions& options, const ExecutionContext& context,
    std::shared_ptr<const RoughnessSurface> surface = nullptr);

  /// System, where only the prescribed elements, their weights or those of options differ: numbers
  /// only, no pattern changes.
  /// \return false if the solver cannot do so; then nothing has happened. After an error the problem
  ///   must not be used.
  bool Update(const TriangleMesh& mesh, const TangentFrames& faceFrames,
    const FieldConstraints& constraints, const FieldOptions& options,
    const ExecutionContext& context);

  /// Solve.
  /// \param values of the constraints.
  /// \param start unknowns to start from, or empty.
  /// \return the unknowns: two per face, or one per edge.
  /// \throw Cancelled
  Vector<double> Solve(const Vector<double>& values, const Vector<double>& start,
    const StoppingCriteria& stop, const ExecutionContext& context);

  /// The harmonic face fields or 1-forms that the problem knows of: any basis, a column each. None where it has
  /// not needed them, or there are too many to hold.
  Eigen::MatrixXd HarmonicFields() const;

  const SolveReport& Report() const;

private:
  /// Harmonic face fields or 1-forms, as soon as an assembled system has needed them: they do not depend on what is
  /// prescribed.
  std::optional<Eigen::MatrixXd> Kernel;
  std::variant<HarmonicProblem<Complex>, HarmonicProblem<double>, RoughnessProblem> Problem;
  std::unique_ptr<FieldProblem> Reference; ///< factors what RoughnessProblem solves, or null
};

/// A field as N-th powers, to be drawn: of the faces in their frames and of the vertices in theirs.
struct FieldPowers
{
  Vector<Complex> Faces;
  Vector<Complex> Vertices;
};

/// \param unknowns as FieldProblem::Solve returns them. A 1-form becomes the vectors of its Whitney
///   interpolant.
FieldPowers PowersOfField(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Unfilled<Corner>& corners,
  const Vector<double>& unknowns, const FieldOptions& options, const ExecutionContext& context);

}

#endif
