#ifndef dmgSolverOptions_h
#define dmgSolverOptions_h

#include "Solvers/Multigrid/NestedIteration.h"

#include <limits>
#include <tuple>

namespace dmg
{

/// The methods that a user may ask for; SolverMethods.cxx has a row for each.
enum class SolverKind
{
  /// Cholesky for small systems, for many solves, and where thin triangles, handles or holes are many; else conjugate
  /// gradients. See ChooseSolver.
  Automatic,
  /// Sparse Cholesky of the fine system (CHOLMOD).
  Cholesky,
  /// Stationary V-cycles.
  VCycles,
  /// Conjugate gradients, one V-cycle as preconditioner.
  ConjugateGradients,
  /// Full multigrid: a rough solution for the price of a few cycles.
  NestedIterations,
  /// Full multigrid without sweeps: a sketch.
  CoarseProlongation,
};

/// The choices of a user for the solution of a system, whatever its unknowns mean.
struct SolverOptions
{
  SolverKind Kind = SolverKind::Automatic;
  /// The expected number of solves with the same prescribed places, >= 1.
  int ExpectedSolves = 1;
  /// Gauss-Seidel sweeps before and after the coarse correction of each coarse level, >= 1.
  int Sweeps = 2;
  /// The sweeps and cycles of nested iterations.
  SweepOptions Nested;
  /// The level that is solved exactly; negative or beyond the coarsest: the coarsest.
  int StartingLevel = -1;

  friend bool operator==(const SolverOptions& a, const SolverOptions& b)
  {
    const auto members = [](const SolverOptions& options)
    {
      // A member that is forgotten here does not compile.
      const auto& [kind, solves, sweeps, nested, level] = options;
      return std::tie(kind, solves, sweeps, nested, level);
    };
    return members(a) == members(b);
  }
};

/// Options that measurements chose for a discretisation (its file names them); not for users.
struct SolverTuning
{
  /// The largest system that Automatic factors, in unknowns.
  int LargestForCholesky = 20000;
  /// Automatic factors larger systems of n unknowns from SolvesForFactor times sqrt(n) expected solves on. The time to make a factor grows
  /// like n^1.5 (George 1973), and what back-substitutions save against further solves by cycles grows like n.
  double SolvesForFactor = std::numeric_limits<double>::infinity();
  /// A factor holds about BytesOfFactor times n log2(n) bytes (George 1973).
  double BytesOfFactor = 50.0;
  /// Sweeps on the finest level over sweeps on a coarse level, >= 1.
  int FinestSweepsFactor = 1;
  /// V-cycles that replace the solution on the first coarse level, >= 1. They count where R and D are kept apart.
  int CoarseCycles = 1;
  /// The largest first coarse level that is factored instead, in unknowns.
  int LargestCoarseFactor = 0;
  /// V-cycles of an assembled matrix that count as one (CycleOptions::Repetitions), >= 1.
  int CyclesInARow = 1;
  /// The number of times that the finest prolongation is smoothed before use; see GalerkinOptions.
  int FinestProlongationSteps = 0;
};

}

#endif
