#ifndef dmgRoughnessProblem_h
#define dmgRoughnessProblem_h

#include "SolverChoice.h"
#include "Solvers/RoughnessHierarchy.h"
#include "Solvers/SolveReport.h"
#include "Solvers/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Systems/HarmonicSystem.h"

#include <memory>
#include <string>

namespace dmg
{

/// What cycles need of a surface, whatever is prescribed: the last part of the set-up. All in the order of
/// the hierarchy.
struct RoughnessSurface
{
  std::string Fields; ///< whose roughness it is: their discretisation and, of powers, N
  std::string Name;   ///< says in reports what the coarse levels hold
  std::unique_ptr<const RoughnessHierarchy> Hierarchy;
  /// Of the inner product that errors are measured in; see ConvergenceMeasure.
  Vector<double> Mass;
  /// Harmonic fields, a column each, orthonormal. Cycles hold them only nearly.
  Eigen::MatrixXd Kernel;
  std::string KernelNote; ///< for reports: why Kernel is left out, or empty

  /// Kernel in the caller's order.
  Eigen::MatrixXd HarmonicFields() const;
};

/// The problem of HarmonicSystem by cycles that keep roughness and prescriptions apart: the system stage,
/// and the solve stage on top of it. Unknowns are real; those of power fields are pairs.
class RoughnessProblem
{
public:
  /// System.
  /// \param smoothness weight of the roughness, > 0.
  /// \param options of cycles; Kind does not count.
  /// \param choice VCycles or ConjugateGradients, and why.
  /// \throw SolverFailure, Cancelled
  RoughnessProblem(std::shared_ptr<const RoughnessSurface> surface,
    PrescribedUnknowns prescribed, double smoothness, const SolverOptions& options,
    const SolverChoice& choice, const ExecutionContext& context);
  ~RoughnessProblem();
  RoughnessProblem(RoughnessProblem&&) noexcept;

  /// Takes other prescribed unknowns or weights: numbers only, no pattern changes. After an error the
  /// problem must not be used.
  void Update(PrescribedUnknowns prescribed, double smoothness, const ExecutionContext& context);

  int NumberOfFree() const;

  /// Solve for the prescribed values.
  /// \param values one per prescribed unknown.
  /// \param start first guess, one per unknown, or empty for zero.
  /// \param reference the solution, for the Error of every row of the history, or empty.
  /// \return one per unknown. Not converged: the best vector reached; see Report().
  /// \throw Cancelled
  Vector<double> Solve(const Vector<double>& values, const Vector<double>& start,
    const Vector<double>& reference, const StoppingCriteria& stop, const ExecutionContext& context);

  const RoughnessSurface& Surface() const;

  /// Of the system stage and of the last solve.
  const SolveReport& Report() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
