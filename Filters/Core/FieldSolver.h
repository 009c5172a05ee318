#ifndef dmgFieldSolver_h
#define dmgFieldSolver_h

#include "Field.h"
#include "FieldProblem.h"
#include "Levels/ProlongationOperators.h"
#include "Places/NearestPlaces.h"
#include "Setup/StageCounts.h"
#include "Solvers/PrescribedSystem.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <vector>

namespace dmg
{

/// Finds the smoothest fields on one surface that satisfy constraints, guides and features, or have prescribed singularities. Keeps what
/// a change leaves valid:
///
///   stage       is redone when this changes
///   set-up      discretisation (with N and areas), operators, or what asks for other levels
///   system      which elements are prescribed, weights, solver options
///   solve       prescribed values, tolerance, iteration limit
///   directions  the solution, Combing
///
///   dmg::FieldSolver solver(dmg::TriangleMesh(points, triangles));
///   dmg::FieldProblem problem;
///   problem.Constraints.OnFaces = { { face, direction, weight } };
///   problem.Features.SharpEdgesWeight = 1.0;
///   const dmg::Field& field = solver.Solve(problem);
///   const dmg::Points vectors = solver.Directions(0);
///
/// With singularities, both kinds of power fields give the one on faces, since a vertex cannot be singular where the field has a
/// value at it: the field of a vertex is the mean of the faces around, and zero where it is singular. The solve then depends on the
/// singularities only. Constraints rotate each component rigidly, by least squares.
///
/// Set-ups of former discretisations are kept while there is room (SetMemoryLimit). A stage that throws leaves those before it as they
/// are.
class FieldSolver
{
public:
  /// Cost: O(#F).
  explicit FieldSolver(TriangleMesh mesh, const ExecutionContext& context = SerialContext());
  /// Shares a surface with others. \pre not null.
  explicit FieldSolver(std::shared_ptr<const FramedMesh> surface);
  /// The same in the metric of the surface over the squares of lengths, in which quads with sides of these lengths are unit squares: the smoothest
  /// field is another one (VertexConnection::SetLengths). Of power fields at points without prescribed singularities; others do not heed it.
  /// \param lengths by vertex, > 0. \throw InvalidInput they are others.
  FieldSolver(std::shared_ptr<const FramedMesh> surface, const std::vector<double>& lengths);
  ~FieldSolver();

  const FramedMesh& Surface() const;
  /// The search for nearest places, made at the first call.
  const NearestPlaces& Places();

  /// Operators of this surface that were built before, in place of those that solvers would build for themselves.
  /// \param operators null: none.
  void SetOperators(std::shared_ptr<const ProlongationOperators> operators);
  /// See SetupCache::SetMemoryLimit.
  void SetMemoryLimit(long long bytes);

  /// Brings all stages up to date. A solve starts from the solution before.
  /// \param names says how messages call vertices and faces.
  /// \return the field, which belongs to the solver and is another one after the next call. Not converged: the best that
  ///   was reached; see its Report.
  /// \throw InvalidInput an option is out of range, a constraint, guide or singularity is wrong, hard constraints leave nothing
  ///   to solve for, guides are given and none of them is near, or operators lack those that are needed.
  /// \throw SolverFailure the system could not be factored.
  /// \throw Cancelled
  const Field& Solve(
    const FieldProblem& problem, const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

  /// Direction k of each face of the last field as a vector in space, #F x 3.
  /// \pre there was a solve.
  Points Directions(int k) const;

  /// The linear equations of the last field without singularities, for a solver of the caller's own; see
  /// HarmonicProblem::Equations. \pre there was one.
  LinearSystem Equations(const ExecutionContext& context = SerialContext()) const;

  StageCounts Counts() const;
  /// The memory of the last solver.
  long long Bytes() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
