#ifndef dmgLaplacianCycle_h
#define dmgLaplacianCycle_h

#include "Solvers/GalerkinHierarchy.h"
#include "Solvers/LaplacianHierarchy.h"
#include "Solvers/MultigridCycle.h"
#include "Solvers/RoughnessHierarchy.h"
#include "Solvers/Smoother.h"

#include <memory>
#include <vector>

namespace dmg
{

/// The V-cycle of a LaplacianHierarchy: Gauss-Seidel by colours on the finest level, its smoothed
/// prolongation, and a MultigridCycle for the levels below.
///
/// An unknown that D pulls does not follow its neighbours, but yields to them by L_ii / (L_ii + D_i): so much of
/// the coarse correction it takes, and of its residual it gives. To a coarse function it is a spring behind a
/// spring, D_i L_ii / (L_ii + D_i), which the coarse matrix has in place of D_i. With D_i itself and a
/// correction that it follows, pulls of a hundred times L_ii took up to five iterations more.
class LaplacianCycle : public RoughnessCycle
{
public:
  /// See LaplacianHierarchy::Cycle.
  LaplacianCycle(const LaplacianHierarchy& hierarchy, const Vector<double>& D,
    const RoughnessCycleOptions& options, const ExecutionContext& context);

  void Update(const Vector<double>& D, const ExecutionContext& context) override;
  void Apply(
    const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override;
  std::vector<LevelReport> Levels() const override;
  long long Bytes() const override;

private:
  using Single = LaplacianHierarchy::Single;

  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context);
  /// P^H L P and the springs of what is pulled.
  SparseMatrix<Complex> CoarseMatrix(const ExecutionContext& context) const;
  /// Of the prolongation.
  SparseMatrix<Complex> Rows(const std::vector<int>& rows, const ExecutionContext& context) const;
  /// P^H L P where unknowns are held at zero.
  SparseMatrix<Complex> CoarseMatrixOfFree(const ExecutionContext& context) const;

  const LaplacianHierarchy& Fine;
  Vector<float> InverseDiagonal; ///< of L + D; 0 where an unknown is held
  std::vector<int> Pulled;       ///< unknowns with finite entries of D
  Vector<double> Pull;           ///< D_i L_ii / (L_ii + D_i) of those
  Vector<float> Yielded;         ///< L_ii / (L_ii + D_i)
  Vector<Single> Smoothed;       ///< before the coarse correction
  std::vector<int> Held;         ///< at zero
  std::unique_ptr<Smoother<Single>> FineSmoother;
  std::unique_ptr<GalerkinHierarchy<Complex>> Hierarchy; ///< of the coarse levels
  std::unique_ptr<MultigridCycle<Complex>> Coarse;
  Vector<Single> b;
  Vector<Single> x;
  Vector<Complex> CoarseResidual;
  Vector<Complex> CoarseCorrection;
  Vector<float> SumsOfTiles; ///< room for CompactProlongation
};

}

#endif
