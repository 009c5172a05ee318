#ifndef dmgSingularFieldSolver_h
#define dmgSingularFieldSolver_h

#include "Analysis/PrescribedSingularities.h"
#include "FieldOptions.h"
#include "SolvedField.h"
#include "Solvers/Krylov/StoppingCriteria.h"

#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// \throw InvalidInput fields of this kind have no singularities: all but power fields.
void CheckTakesSingularities(const DiscretisationOptions& field);

/// Finds the power fields of magnitude 1 on one surface that have prescribed singularities and no others, and turn as little
/// as is possible then (TrivialConnection.h), and keeps what a change leaves valid:
///
///   stage   is redone when this changes
///   set-up  solver options
///   system  solver options
///   solve   singularities, N, tolerance, iteration limit; if only prescribed directions change, nothing is solved for
///
///   dmg::SingularFieldSolver solver(surface);
///   solver.Solve({ { vertex, 1 }, { other, -1 } }, {}, options);
///   const dmg::Points vectors = solver.Directions(0);
///
/// The set-up are the levels of functions, or a factor, and a solve for each handle and hole. Prescribed directions turn the
/// field on each component as a whole, to where it is nearest to them in the mean of squares; where there are none,
/// direction 0 of some face of the component runs along its first side.
class SingularFieldSolver : public SolvedField
{
public:
  /// \param surface is borrowed.
  explicit SingularFieldSolver(const FramedMesh& surface);
  ~SingularFieldSolver() override;

  /// Brings all stages up to date. A solve starts from the solution before.
  /// \param options of its solver: Cholesky, V-cycles and conjugate gradients as asked for; for all others, Automatic. There are
  ///   no operators of the surface but its own; constraints are neither soft nor hard.
  /// \param stop tolerances above 1e-6 are taken as that.
  /// \param names says how messages call vertices and faces.
  /// \return the unknowns of Field(), a power field. Not converged: the best that was reached; see Report().
  /// \throw InvalidInput no power field is asked for; a vertex is out of range or on the boundary; singularities on a closed
  ///   component do not sum to its Euler characteristic; a prescribed direction is wrong; too many loops.
  /// \throw SolverFailure, Cancelled
  const Vector<double>& Solve(const std::vector<PrescribedSingularity>& singularities,
    const dmg::Constraints& directions, const FieldOptions& options, const StoppingCriteria& stop = {},
    const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

  const FramedMesh& Surface() const override;

  // Results of the last solve. \pre there was one.

  const Discretisation& Field() const override;
  const FieldConstraints& Constraints() const override;
  const Vector<double>& Unknowns() const override;
  const SolveReport& Report() const override;
  /// Power fields have none.
  Eigen::MatrixXd HarmonicFields() const override;
  const StageCounts& Counts() const override;
  double SetupSeconds() const override;
  /// The rotation of the field across each edge, from the face of HalfedgeOf(edge) to that of its twin, besides parallel
  /// transport; #E.
  const Vector<double>& Rotation() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
