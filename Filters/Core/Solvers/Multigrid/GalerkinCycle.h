#ifndef dmgGalerkinCycle_h
#define dmgGalerkinCycle_h

#include "Solvers/Krylov/Preconditioner.h"
#include "Solvers/Multigrid/GalerkinHierarchy.h"
#include "Solvers/Multigrid/MultigridCycle.h"

#include <vector>

namespace dmg
{

/// A Galerkin hierarchy of a matrix and a V-cycle on it; the factor of the matrix where the hierarchy has one level.
/// It preconditions an assembled system, and stands in for the solution of the coarse equations of cycles whose
/// finest level is something else (LaplacianCycle, LeastSquaresCycle).
template <class Scalar>
class GalerkinCycle : public Preconditioner<Scalar>
{
public:
  /// \param matrix, prolongations see GalerkinHierarchy. The matrix comes back empty.
  /// \throw as GalerkinHierarchy and MultigridCycle.
  GalerkinCycle(SparseMatrix<Scalar>&& matrix, std::vector<SparseMatrix<Scalar>> prolongations,
    const GalerkinOptions& coarsening, const CycleOptions& cycle, const ExecutionContext& context);
  GalerkinCycle(const GalerkinCycle&) = delete; // the cycle refers to the hierarchy
  GalerkinCycle& operator=(const GalerkinCycle&) = delete;

  /// Takes other values in the same pattern. After an error the cycle must not be used.
  void Update(SparseMatrix<Scalar>&& matrix, const ExecutionContext& context);

  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) override
  {
    this->Cycle.Apply(r, z, context);
  }

  /// Unknowns and non-zeros, finest first.
  const std::vector<LevelReport>& Levels() const { return this->Hierarchy.Levels(); }
  /// Held by this object.
  long long Bytes() const { return this->Hierarchy.Bytes() + this->Cycle.Bytes(); }

private:
  GalerkinHierarchy<Scalar> Hierarchy;
  MultigridCycle<Scalar> Cycle;
};

}

#endif
