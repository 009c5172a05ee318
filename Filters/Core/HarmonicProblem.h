#ifndef dmgHarmonicProblem_h
#define dmgHarmonicProblem_h

#include "SolverChoice.h"
#include "Solvers/SolveReport.h"
#include "Solvers/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Systems/HarmonicSystem.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// A harmonic system with its solver, ready to solve for prescribed values: the system stage, and
/// the solve stage on top of it.
template <class Scalar>
class HarmonicProblem
{
public:
  using MakeSystem = std::function<HarmonicSystem<Scalar>(const ExecutionContext&)>;
  using MakeProlongations =
    std::function<std::vector<SparseMatrix<Scalar>>(const ExecutionContext&)>;

  /// Where coarse levels come from, on all unknowns of the system; called only where a solver needs
  /// them.
  struct CoarseSpaces
  {
    /// Says in the report what the coarse levels hold.
    std::string Name;
    /// Finest first. Empty: there are no coarse levels.
    MakeProlongations Prolongations;
  };

  /// System: assembles, coarsens or factors; the expensive part that new values do not repeat.
  /// Where there are no coarse levels the system is factored, whatever solver is asked for; the
  /// report says so.
  /// \throw InvalidInput what makeSystem and the makers of levels refuse.
  /// \throw SolverFailure the factorisation failed.
  HarmonicProblem(const MakeSystem& makeSystem, const CoarseSpaces& coarseSpaces,
    const SolverOptions& options, const ExecutionContext& context);
  ~HarmonicProblem();
  HarmonicProblem(HarmonicProblem&&) noexcept;

  /// System, where only the prescribed unknowns or weights differ. Orders, patterns and analyses are
  /// kept.
  /// \return false if the pattern of the matrix changes, as hard constraints let it, or the solver
  ///   cannot do so; then nothing has happened.
  bool Update(const MakeSystem& makeSystem, const ExecutionContext& context);

  /// Solve for the prescribed values.
  /// \param values one per prescribed unknown.
  /// \param start first guess, one per unknown, or empty for zero; used by cycles and conjugate
  ///   gradients.
  /// \return one per unknown. Not converged: the best vector reached; see Report().
  /// \throw InvalidInput nested iterations while the error falls, without CompareWithCholesky.
  /// \throw Cancelled
  Vector<Scalar> Solve(const Vector<Scalar>& values, const Vector<Scalar>& start,
    const StoppingCriteria& stop, const ExecutionContext& context);

  /// Of the system stage and of the last solve.
  const SolveReport& Report() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

extern template class HarmonicProblem<double>;
extern template class HarmonicProblem<Complex>;

}

#endif
