#ifndef dmgLaplacianCycle_h
#define dmgLaplacianCycle_h

#include "Solvers/Laplacian/LaplacianHierarchy.h"
#include "Solvers/Multigrid/GalerkinCycle.h"
#include "Solvers/Multigrid/PenalisedUnknowns.h"
#include "Solvers/Multigrid/Smoother.h"
#include "Solvers/Multigrid/StiffnessHierarchy.h"

#include <memory>
#include <vector>

namespace dmg
{

/// The V-cycle of a LaplacianHierarchy: Gauss-Seidel by colours on the finest level, its smoothed
/// prolongation, and a GalerkinCycle for the levels below. Penalised unknowns take a share of its correction
/// (PenalisedUnknowns).
class LaplacianCycle : public StiffnessCycle
{
public:
  /// See LaplacianHierarchy::Cycle.
  LaplacianCycle(const LaplacianHierarchy& hierarchy, const Vector<double>& D, const StiffnessCycleOptions& options,
    const ExecutionContext& context);

  void Update(const Vector<double>& D, const ExecutionContext& context) override;
  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override;
  Vector<double> CoarseEigenvectors(const ShiftedParts& parts, const ExecutionContext& context) override;
  std::vector<LevelReport> Levels() const override;
  long long Bytes() const override;

private:
  using Single = LaplacianHierarchy::Single;

  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context);
  /// P^H L P and the coarse penalties.
  SparseMatrix<Complex> CoarseMatrix(const ExecutionContext& context) const;
  /// Rows of the prolongation.
  SparseMatrix<Complex> Rows(const std::vector<int>& rows, const ExecutionContext& context) const;
  /// P^H L P where unknowns are held at zero.
  SparseMatrix<Complex> CoarseMatrixOfFree(const ExecutionContext& context) const;

  const LaplacianHierarchy& Fine;
  Vector<float> InverseDiagonal; ///< of L + D; 0 where an unknown is held
  PenalisedUnknowns<Single> Penalised;
  std::vector<int> HeldUnknowns; ///< at zero
  std::unique_ptr<Smoother<Single>> FineSmoother;
  std::unique_ptr<GalerkinCycle<Complex>> Coarse;
  Vector<Single> b;
  Vector<Single> x;
  Vector<Complex> CoarseResidual;
  Vector<Complex> CoarseCorrection;
  Vector<float> SumsOfParts; ///< room for SingleProlongation
};

}

#endif
