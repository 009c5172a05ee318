#ifndef dmgLeastSquaresCycle_h
#define dmgLeastSquaresCycle_h

#include "Solvers/LeastSquares/BlockSmoother.h"
#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"
#include "Solvers/Multigrid/GalerkinCycle.h"
#include "Solvers/Multigrid/PenalisedUnknowns.h"
#include "Solvers/Multigrid/StiffnessHierarchy.h"

#include <memory>
#include <vector>

namespace dmg
{

/// One V-cycle for A = B^T B + D, as a linear operator that is symmetric positive definite: blocks are
/// smoothed on the fine level, the smoothed prolongation of the hierarchy leads to plane vectors on the
/// next, and a GalerkinCycle serves the levels below, of whose
/// correction penalised unknowns take a share (PenalisedUnknowns).
class LeastSquaresCycle : public StiffnessCycle
{
public:
  /// \param hierarchy is borrowed: it must stay where it is. Several cycles may share it.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// \throw as GalerkinHierarchy.
  LeastSquaresCycle(const LeastSquaresHierarchy& hierarchy, const Vector<double>& D,
    const StiffnessCycleOptions& options, const ExecutionContext& context);

  /// Inverts blocks where D is not zero.
  void Update(const Vector<double>& D, const ExecutionContext& context) override;

  void Apply(const Vector<double>& r, Vector<double>& x, const ExecutionContext& context) override;

  std::vector<LevelReport> Levels() const override;
  long long Bytes() const override;

private:
  PenalisedUnknowns<double> PenalisedBy(const Vector<double>& scaledD, const ExecutionContext& context) const;
  /// D of the scaled unknowns.
  Vector<double> Scaled(const Vector<double>& D) const;
  /// P^T B^T B P and the coarse penalties.
  SparseMatrix<double> CoarseMatrix(const ExecutionContext& context) const;

  const LeastSquaresHierarchy& Fine;
  BlockSmoother Smoother;
  PenalisedUnknowns<double> Penalised;
  std::unique_ptr<GalerkinCycle<double>> Coarse;
  Vector<double> b; ///< of the scaled unknowns
  Vector<double> Residual;
  Vector<double> CoarseResidual;
  Vector<double> CoarseCorrection;
  Vector<double> SumsOfParts; ///< room for SingleProlongation
};

}

#endif
