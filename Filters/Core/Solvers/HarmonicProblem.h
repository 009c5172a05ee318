#ifndef dmgHarmonicProblem_h
#define dmgHarmonicProblem_h

#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/MultigridSetup.h"
#include "Solvers/Penalties.h"
#include "Solvers/PrescribedSystem.h"
#include "Solvers/SolverChoice.h"
#include "Solvers/SolverOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>

namespace dmg
{

/// A solution by other means, with which benchmarks and tests compare iterates. See ConvergenceMeasure.
struct ReferenceSolution
{
  Vector<double> Unknowns; ///< one per unknown; empty: none
  double LeastImprovement = 0.0;
};

/// The linear system of a smoothest field, and its solver: the stages system and solve.
///
///   soft  argmin  s x^T R x + sum_b m_b |x_b - y_b|^2
///   hard  argmin  x^T R x  subject to  x_b = y_b
///
/// over all unknowns x, with prescribed values y_b for some of them; R is the smoothness energy of the set-up, s the
/// smoothness weight. With a diagonal D, which is m_b / s where a soft prescription is, infinite where a hard one
/// is, and zero elsewhere, both are (R + D) x = D y, divided by s. Where no prescription reaches through R, x is
/// the lowest eigenvector (UnprescribedComponents) or, where the set-up has none, zero. The part in the harmonic fields of
/// the set-up that no prescription determines is zero.
///
/// Under strong penalties x equals the prescribed value up to O(R / D). The initial guess is the diagonal solution
/// x_0 = D y / (R + D), with the diagonal of R. Solvers are given the equations of x - x_0, by whose energy they judge
/// residuals. D is cut at 1e13 times the diagonal of R, where it holds to rounding.
///
/// Unknowns are real; those of power fields are pairs.
class HarmonicProblem
{
public:
  /// System.
  /// \param smoothness s > 0.
  /// \param choice the method that runs, and why; one that needs no levels where the set-up has none. options.Kind does not
  ///   count. The method must outlive this object.
  /// \throw InvalidInput the penalties hold nothing.
  /// \throw SolverFailure the system could not be factored.
  /// \throw Cancelled
  HarmonicProblem(std::shared_ptr<const MultigridSetup> setup, Penalties prescribed, double smoothness,
    const SolverOptions& options, const SolverChoice& choice, const ExecutionContext& context);
  ~HarmonicProblem();
  HarmonicProblem(HarmonicProblem&&) noexcept;

  /// Takes other prescribed unknowns or weights: orders, patterns and analyses are kept where they can be. After
  /// an error the problem must not be used.
  void Update(Penalties prescribed, double smoothness, const ExecutionContext& context);

  /// Solve for the prescribed values.
  /// \param values y, one per prescribed unknown.
  /// \param start first guess, one per unknown, or empty for zero; not of factorisations and full multigrid.
  /// \param reference for the Error of every row of the history.
  /// \param source what is minimised loses 2 source^T x; one per unknown, or empty for zero. Not of full multigrid.
  /// \return one per unknown. Not converged: the best vector reached; see Report(). Full multigrid approximates, and
  ///   not to converge is no warning.
  /// \throw Cancelled
  Vector<double> Solve(const Vector<double>& values, const Vector<double>& start, const ReferenceSolution& reference,
    const StoppingCriteria& stop, const ExecutionContext& context, const Vector<double>& source = {});

  /// The equations (R + D) x = D y, divided by s, that Solve solves: a matrix for the caller's own solver. See
  /// PrescribedSystem::Equations.
  /// \param values, source see Solve.
  LinearSystem Equations(
    const Vector<double>& values, const ExecutionContext& context, const Vector<double>& source = {}) const;

  const MultigridSetup& Setup() const;

  /// The report of the system stage and of the last solve.
  const SolveReport& Report() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
