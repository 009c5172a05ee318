#ifndef dmgFieldStages_h
#define dmgFieldStages_h

#include "FieldOptions.h"
#include "Levels/ProlongationOperators.h"
#include "SolvedField.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/PrescribedSystem.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>

namespace dmg
{

/// The stages of a solve on one surface, and a cache of all that a change leaves valid: set-up, system and solve, as
/// FieldSolver.h tells. Constraints come as they are: what fields follow besides is found by FieldSolver.
///
/// Levels that were built for a surface are all kept, and so is what the set-up makes of them for a discretisation, while there
/// is room (SetMemoryLimit): going back to a former N costs no set-up. A stage that throws leaves those before it as they are.
class FieldStages : public SolvedField
{
public:
  /// Cost: O(#F).
  explicit FieldStages(TriangleMesh mesh, const ExecutionContext& context = SerialContext());
  ~FieldStages() override;

  const FramedMesh& Surface() const override;

  /// Operators of this surface that were built before, in place of those that solvers would build for themselves.
  /// \param operators null: none.
  void SetOperators(std::shared_ptr<const ProlongationOperators> operators);

  /// Set-ups of former discretisations and N are kept, too, up to so many bytes of all; by default
  /// 1 GiB, some dozen set-ups of power fields on a quarter of a million triangles. What is in use is always kept.
  void SetMemoryLimit(long long bytes);

  /// The discretisation that these options name, made where it is not the last one.
  /// \throw InvalidInput an option is out of range.
  const Discretisation& DiscretisationFor(const DiscretisationOptions& options);

  /// Brings all stages up to date. A solve starts from the solution before.
  /// \param names says how messages call vertices and faces.
  /// \return the unknowns: Field().UnknownsPerElement() for each element. Not converged: the best that was reached;
  ///   see Report().
  /// \throw InvalidInput an option is out of range, a prescription is wrong, nothing is prescribed, hard constraints
  ///   leave nothing to solve for, or operators lack those that are needed.
  /// \throw SolverFailure the system could not be factored.
  /// \throw Cancelled
  const Vector<double>& Solve(const dmg::Constraints& directions, const FieldOptions& options,
    const StoppingCriteria& stop = {}, const ExecutionContext& context = SerialContext(),
    const ElementNames& names = {});

  // Results of the last solve. \pre there was one.

  const Discretisation& Field() const override;
  const FieldOptions& Options() const;
  const FieldConstraints& Constraints() const override;
  const Vector<double>& Unknowns() const override;
  const SolveReport& Report() const override;
  /// The linear equations of Unknowns, as a matrix and a right-hand side for a solver of the caller's own. See
  /// HarmonicProblem::Equations.
  LinearSystem Equations(const ExecutionContext& context = SerialContext()) const;
  Eigen::MatrixXd HarmonicFields() const override;
  const StageCounts& Counts() const override;
  double SetupSeconds() const override;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
