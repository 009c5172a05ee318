#ifndef dmgSolverMethod_h
#define dmgSolverMethod_h

#include "Solvers/Krylov/ConvergenceMeasure.h"
#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Solvers/MultigridSetup.h"
#include "Solvers/SolverOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <memory>
#include <string>

namespace dmg
{

/// A way to solve the equations (R + D) x = b of a set-up.
///
/// A method has up to three roles. Its preconditioner is close to the inverse of R + D, and serves its iteration and the
/// eigenproblem (UnprescribedComponents). Its iteration improves x until it has converged. Its approximation gives x at
/// once, in place of an iteration.
///
/// A new method is a file that makes its preconditioner or approximation, a value of SolverKind, and a row of the table in
/// SolverMethods.cxx.
struct SolverMethod
{
  /// \param D one entry per unknown, >= 0, in the order of the hierarchy. Infinite: the unknown is zero.
  using PreconditionerMaker = std::unique_ptr<StiffnessCycle>(const MultigridSetup& setup, const Vector<double>& D,
    const SolverOptions& options, const ExecutionContext& context);
  /// Parameters are those of ConjugateGradient.
  using Iteration = void(const LinearOperator<double>& A, Preconditioner<double>& inverse, const Vector<double>& b,
    const StoppingCriteria& stop, Vector<double>& x, SolveReport& report, const ExecutionContext& context,
    const ConvergenceMeasure<double>* measure);
  /// Parameters are those of a PreconditionerMaker.
  using ApproximationMaker = std::unique_ptr<StiffnessNestedIteration>(const MultigridSetup& setup,
    const Vector<double>& D, const SolverOptions& options, const ExecutionContext& context);

  std::string Name; ///< in words

  // Needs.
  bool NeedsLevels = true;  ///< coarse levels
  bool NeedsMatrix = false; ///< R as a matrix (AssembledHierarchy); else R and D may stay apart

  // Roles.
  PreconditionerMaker* MakePreconditioner = nullptr;
  Iteration* Iterate = nullptr;                    ///< or null
  ApproximationMaker* MakeApproximation = nullptr; ///< or null

  /// Whether the preconditioner is the inverse but for rounding. Then a first guess is no help, and a residual is measured by
  /// one more application, which is cheap beside the factor.
  bool IsDirect = false;
  /// Whether conjugate gradients with a factor take over where the iteration stagnates.
  bool HasFallback = false;
  /// Whether the approximation sweeps on each level (SolverOptions::Nested).
  bool HasSweeps = false;

  bool IsApproximation() const { return this->MakeApproximation != nullptr; }
};

/// The row of the table for a kind of solver. Automatic: the row of conjugate gradients, which run unless a factor is better
/// (ChooseSolver).
const SolverMethod& MethodOf(SolverKind kind);

}

#endif
