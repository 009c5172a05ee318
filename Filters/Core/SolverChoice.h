#ifndef dmgSolverChoice_h
#define dmgSolverChoice_h

#include "Solvers/NestedIteration.h"

#include <limits>
#include <string>

namespace dmg
{

enum class SolverKind
{
  /// Cholesky for small systems and for many solves, else conjugate gradients; see SolverOptions.
  Automatic,
  /// Supernodal sparse Cholesky of the fine system (CHOLMOD).
  Cholesky,
  /// Stationary V-cycles.
  VCycles,
  /// Conjugate gradients, one V-cycle as preconditioner.
  ConjugateGradients,
  /// Nested iterations: a rough solution for the price of a few cycles.
  NestedIterations,
  /// Nested iterations without sweeps: a sketch.
  CoarseProlongation,
};

/// How a system is solved, whatever its unknowns mean.
struct SolverOptions
{
  SolverKind Kind = SolverKind::Automatic;
  /// Automatic factors systems of at most so many unknowns.
  int LargestForCholesky = 20000;
  /// How many solves with the same prescribed places are expected, >= 1.
  int ExpectedSolves = 1;
  /// Automatic factors where at least so many are expected, whatever the size.
  int SolvesForCholesky = std::numeric_limits<int>::max();
  /// Automatic factors where this is not empty; the rest of a sentence for the report (FactorChoice).
  std::string WhyFactor;
  /// Gauss-Seidel sweeps before and after the coarse correction of each coarse level, >= 1.
  int Sweeps = 2;
  /// The finest level gets so many times as many sweeps, >= 1.
  int FinestSweepsFactor = 1;
  /// V-cycles on the first coarse level that stand in for its solution, >= 1; where roughness and
  /// prescriptions are kept apart (RoughnessProblem).
  int CoarseCycles = 1;
  /// The first coarse level is factored instead if it has at most so many unknowns; there as well.
  int LargestCoarseFactor = 0;
  /// How often the finest prolongation is smoothed before use; see GalerkinOptions.
  int FinestProlongationSteps = 0;
  /// Of nested iterations.
  SweepOptions Nested;
  /// The level that is solved exactly; negative or beyond the coarsest: the coarsest.
  int StartingLevel = -1;
  /// Factors the fine system as well, for the Error of every row of the history.
  bool CompareWithCholesky = false;
};

/// The solver that runs, and why if it is not the one asked for.
struct SolverChoice
{
  SolverKind Kind;
  std::string Reason; ///< the rest of a sentence, or empty
};

/// \param hasLevels whether there are coarse levels. Where there are none the system is factored,
///   whatever is asked for.
SolverChoice ChooseSolver(const SolverOptions& options, int numberOfUnknowns, bool hasLevels);

/// In words.
std::string NameOf(SolverKind kind);

}

#endif
