#ifndef dmgLeastSquaresCycle_h
#define dmgLeastSquaresCycle_h

#include "Solvers/BlockSmoother.h"
#include "Solvers/GalerkinHierarchy.h"
#include "Solvers/LeastSquaresHierarchy.h"
#include "Solvers/MultigridCycle.h"
#include "Solvers/Preconditioner.h"

#include <memory>
#include <vector>

namespace dmg
{

struct LeastSquaresCycleOptions
{
  /// Sweeps over the blocks before and after the coarse correction, >= 1.
  int Sweeps = 4;
  /// The first coarse level is factored if it has at most so many unknowns.
  int LargestFactor = 10000;
  /// Of the levels below.
  CycleOptions Coarse;
};

/// One V-cycle for A = B^T B + D, as a linear operator that is symmetric positive definite: blocks are
/// smoothed on the fine level, the smoothed prolongation of the hierarchy leads to plane vectors on the
/// next, and a MultigridCycle serves the levels below.
///
/// Unknowns are in the order of the hierarchy, and not scaled.
class LeastSquaresCycle : public Preconditioner<double>
{
public:
  /// \param hierarchy is borrowed: it must stay where it is. Several cycles may share it.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// \throw as GalerkinHierarchy.
  LeastSquaresCycle(const LeastSquaresHierarchy& hierarchy, const Vector<double>& D,
    const LeastSquaresCycleOptions& options, const ExecutionContext& context);

  /// Takes another D. No pattern changes: inverses of blocks where D is not zero, the coarse matrices
  /// and the factor of the coarsest are computed anew. After an error the cycle must not be used.
  void Update(const Vector<double>& D, const ExecutionContext& context);

  void Apply(
    const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override;

  /// Unknowns and non-zeros, finest first.
  std::vector<LevelReport> Levels() const;
  /// Held by this object, without the hierarchy.
  long long Bytes() const;

private:
  /// D of the scaled unknowns.
  Vector<double> Scaled(const Vector<double>& D) const;
  /// P^T (B^T B + D) P.
  SparseMatrix<double> CoarseMatrix(
    const Vector<double>& scaledD, const ExecutionContext& context) const;
  void Restrict(const ExecutionContext& context);
  void Correct(const ExecutionContext& context);

  const LeastSquaresHierarchy& Fine;
  BlockSmoother Smoother;
  std::unique_ptr<GalerkinHierarchy<double>> Hierarchy; ///< of the coarse levels
  std::unique_ptr<MultigridCycle<double>> Coarse;
  Vector<double> b; ///< of the scaled unknowns
  Vector<double> x;
  Vector<double> Residual;
  Vector<double> CoarseResidual;
  Vector<double> CoarseCorrection;
};

}

#endif
