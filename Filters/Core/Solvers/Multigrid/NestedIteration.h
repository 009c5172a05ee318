#ifndef dmgNestedIteration_h
#define dmgNestedIteration_h

#include "Solvers/Krylov/ConvergenceMeasure.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Multigrid/GalerkinHierarchy.h"
#include "Solvers/Multigrid/LevelStack.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <tuple>
#include <vector>

namespace dmg
{

/// The work of full multigrid on each level but the coarsest.
struct SweepOptions
{
  int Sweeps = 10; ///< Gauss-Seidel sweeps, >= 0
  /// Steps of conjugate gradients before the sweeps, preconditioned by a V(1,1)-cycle from the level down, >= 0. Sweeps alone, as
  /// in the thesis, leave the errors of the coarser levels.
  int Cycles = 0;

  friend bool operator==(const SweepOptions& a, const SweepOptions& b)
  {
    const auto members = [](const SweepOptions& options)
    {
      const auto& [sweeps, cycles] = options; // all of them, or it does not compile
      return std::tie(sweeps, cycles);
    };
    return members(a) == members(b);
  }
};

struct NestedOptions
{
  /// Its CoarsestLevel is where the iterations start: a finer one costs a larger factor, and saves
  /// sweeps (thesis, section 7.2.2).
  GalerkinOptions Coarsening;
  bool MaySweep = true; ///< false: coarse prolongation whatever the sweeps; no matrices are kept
};

/// Full multigrid; the thesis calls it nested iterations (sections 3.4.2 and 6.5.2). The coarsest system is solved exactly. The
/// solution goes up level by level, improved by V-cycles and smoothed by Gauss-Seidel sweeps on each.
/// Without either this is coarse prolongation (3.4.3 and 6.5.1), x = P (P^H A P)^-1 P^H b, P the product of all
/// prolongations. The result is an approximation at the price of a few cycles, to be looked at or to start from.
///
/// Galerkin matrices A_{l+1} = P_l^H A_l P_l, right-hand sides b_{l+1} = P_l^H b_l. Sweeps go down
/// in the order of each level (SweepOrder), in double precision. Built once per matrix, asked for many right-hand sides.
///
/// Cost: one product with every matrix per sweep, five per cycle and two cycles more to measure what they reach, and two with every
/// prolongation.
template <class Scalar>
class NestedIteration
{
public:
  /// \param A, prolongations see GalerkinHierarchy. A is borrowed: it must stay where it is.
  /// \throw as GalerkinHierarchy.
  NestedIteration(const SparseMatrix<Scalar>& A, std::vector<SparseMatrix<Scalar>> prolongations,
    const NestedOptions& options, const ExecutionContext& context);
  NestedIteration(const NestedIteration&) = delete; // the stack refers to the hierarchy
  NestedIteration& operator=(const NestedIteration&) = delete;

  /// \param x on exit the solution, zero for inactive unknowns.
  /// \param report gets Iterations, SolveSeconds and Converged anew. The history begins with x = 0
  ///   and ends with the solution. With a measure, it has a row for the coarsest solution, one for
  ///   each level in between after its last sweep, both prolonged to the finest level, one for the steps of conjugate gradients on
  ///   the finest level, and one for each sweep there. Residuals are relative to |b|.
  /// \param measure may be null. Its cost, that of its errors after sweeps included, does not count in Seconds.
  /// \return the sweeps on each level, finest first; 0 for the coarsest.
  /// \throw InvalidInput sizes differ, b is not finite, or a number of sweeps is negative.
  /// \throw Cancelled
  /// Checkpoints: every sweep.
  std::vector<int> Solve(const Vector<Scalar>& b, const SweepOptions& sweeps, Vector<Scalar>& x, SolveReport& report,
    const ExecutionContext& context, const ConvergenceMeasure<Scalar>* measure = nullptr);

  /// Unknowns and non-zeros, finest first.
  const std::vector<LevelReport>& Levels() const { return this->Hierarchy.Levels(); }
  /// Held by this object.
  long long Bytes() const { return this->Hierarchy.Bytes() + this->Stack.Bytes(); }

private:
  class Run;

  const SparseMatrix<Scalar>* A;
  const bool MaySweep;
  GalerkinHierarchy<Scalar> Hierarchy;
  LevelStack<Scalar, Scalar> Stack;
};

}

#endif
