#ifndef dmgSolveReport_h
#define dmgSolveReport_h

#include <limits>
#include <string>
#include <vector>

namespace dmg
{

/// One level of a multigrid hierarchy, or the whole system for a direct solver.
struct LevelReport
{
  long long Unknowns = 0;
  long long NonZeros = 0;
};

/// One iteration; the first row of a history is the start.
struct IterationReport
{
  int Iteration = 0;
  double Seconds = 0.0; ///< since the solve began, without measuring
  /// An estimate of the relative error in the energy norm: the residual in the norm of the preconditioner over the energy
  /// norm of x, measured as IterationMonitor says. In full multigrid |b - A x| / |b|.
  double RelativeResidual = 0.0;

  // Measures of x on the finest level; NaN unless the caller handed over a ConvergenceMeasure.
  /// The energy that the solution minimises.
  double Energy = std::numeric_limits<double>::quiet_NaN();
  /// |b - A x|_M / |b|_M
  double MassResidual = std::numeric_limits<double>::quiet_NaN();
  /// |x - reference|_M / |reference|_M
  double Error = std::numeric_limits<double>::quiet_NaN();

  int Level = 0; ///< whose unknowns the iteration changed
};

/// The report of a solver: sizes, cost and convergence.
struct SolveReport
{
  std::string Solver; ///< what ran, in words, and why if it was chosen automatically
  std::vector<LevelReport> Levels;
  long long Bytes = 0;         ///< held by matrices, transfers and factors
  double PrepareSeconds = 0.0; ///< system stage: assembly, Galerkin products, factorisation
  double SolveSeconds = 0.0;
  std::vector<IterationReport> Iterations;
  int Returned = 0; ///< the iteration whose x is the result
  bool Converged = false;
  /// The eigenvalue of the smoothest field of unit norm on each component without constraints.
  std::vector<double> Eigenvalues;
  bool EndedByRounding = false;      ///< not converged, and no residual could be smaller
  std::vector<std::string> Warnings; ///< one sentence each, for the user

  /// Non-zeros of all levels over those of the finest; 1 for a direct solver.
  double OperatorComplexity() const;
};

}

#endif
