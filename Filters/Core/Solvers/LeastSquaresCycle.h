#ifndef dmgLeastSquaresCycle_h
#define dmgLeastSquaresCycle_h

#include "Solvers/BlockSmoother.h"
#include "Solvers/GalerkinCycle.h"
#include "Solvers/LeastSquaresHierarchy.h"
#include "Solvers/RoughnessHierarchy.h"
#include "Solvers/YieldingUnknowns.h"

#include <memory>
#include <vector>

namespace dmg
{

/// One V-cycle for A = B^T B + D, as a linear operator that is symmetric positive definite: blocks are
/// smoothed on the fine level, the smoothed prolongation of the hierarchy leads to plane vectors on the
/// next, and a GalerkinCycle serves the levels below, to which what D pulls yields (YieldingUnknowns).
class LeastSquaresCycle : public RoughnessCycle
{
public:
  /// \param hierarchy is borrowed: it must stay where it is. Several cycles may share it.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// \throw as GalerkinHierarchy.
  LeastSquaresCycle(const LeastSquaresHierarchy& hierarchy, const Vector<double>& D,
    const RoughnessCycleOptions& options, const ExecutionContext& context);

  /// Inverts blocks where D is not zero.
  void Update(const Vector<double>& D, const ExecutionContext& context) override;

  void Apply(
    const Vector<double>& r, Vector<double>& x, const ExecutionContext& context) override;

  std::vector<LevelReport> Levels() const override;
  long long Bytes() const override;

private:
  /// Of the smoothers, and who yields.
  void SetDiagonal(const Vector<double>& scaledD, const ExecutionContext& context);
  /// D of the scaled unknowns.
  Vector<double> Scaled(const Vector<double>& D) const;
  /// P^T B^T B P and the springs of what is pulled.
  SparseMatrix<double> CoarseMatrix(const ExecutionContext& context) const;

  const LeastSquaresHierarchy& Fine;
  BlockSmoother Smoother;
  YieldingUnknowns<double> Pulled;
  std::unique_ptr<GalerkinCycle<double>> Coarse;
  Vector<double> b; ///< of the scaled unknowns
  Vector<double> Residual;
  Vector<double> CoarseResidual;
  Vector<double> CoarseCorrection;
  Vector<double> SumsOfParts; ///< room for SingleProlongation
};

}

#endif
