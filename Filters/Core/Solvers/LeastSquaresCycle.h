#ifndef dmgLeastSquaresCycle_h
#define dmgLeastSquaresCycle_h

#include "Solvers/BlockSmoother.h"
#include "Solvers/GalerkinHierarchy.h"
#include "Solvers/MultigridCycle.h"
#include "Solvers/PlanarProlongation.h"
#include "Solvers/Preconditioner.h"

#include <memory>
#include <vector>

namespace dmg
{

struct LeastSquaresCycleOptions
{
  /// Sweeps over the blocks before and after the coarse correction, >= 1.
  int Sweeps = 4;
  /// Degree of the polynomial that smooths the prolongation, >= 0.
  int ProlongationDegree = 2;
  /// Entries of the prolongation below so many times the largest of their row are left out.
  double Dropped = 0.007;
  /// The first coarse level is factored if it has at most so many unknowns.
  int LargestFactor = 25000;
  /// Of the levels below.
  CycleOptions Coarse;
};

/// Where the levels of a LeastSquaresCycle come from.
struct LeastSquaresLevels
{
  UnknownBlocks Blocks;                       ///< of the fine level
  PlanarProlongation Prolongation;            ///< to the fine level
  std::vector<SparseMatrix<double>> Coarser;  ///< between the levels below, finest first
};

/// One V-cycle for a sum of squares A = B^T B, as a linear operator that is symmetric positive definite:
/// blocks are smoothed on the fine level, a smoothed prolongation leads to plane vectors on the next,
/// and a MultigridCycle serves the levels below.
///
/// The fine level costs most, so it is coarsened fast: the prolongation may skip a level, as the
/// polynomial that smooths it reaches far.
class LeastSquaresCycle : public Preconditioner<double>
{
public:
  /// \param B m x n.
  /// \param levels Prolongation is n x N_1; Coarser [0] has 2 N_1 rows.
  /// \throw as GalerkinHierarchy.
  LeastSquaresCycle(const SparseMatrix<double>& B, LeastSquaresLevels levels,
    const LeastSquaresCycleOptions& options, const ExecutionContext& context);
  ~LeastSquaresCycle() override;

  void Apply(
    const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override;

  /// Unknowns and non-zeros, finest first; of the finest those of B.
  const std::vector<LevelReport>& Levels() const { return this->Reports; }
  /// Held by this object.
  long long Bytes() const;

private:
  class FineLevel;
  template <class Value>
  class FineLevelOf;

  std::vector<LevelReport> Reports;
  std::unique_ptr<FineLevel> Fine;
  std::unique_ptr<GalerkinHierarchy<double>> Hierarchy;
  std::unique_ptr<MultigridCycle<double>> Coarse;
  Vector<double> CoarseResidual;
  Vector<double> CoarseCorrection;
};

}

#endif
