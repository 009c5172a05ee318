#ifndef dmgCoarseCycle_h
#define dmgCoarseCycle_h

#include "Solvers/GalerkinHierarchy.h"
#include "Solvers/MultigridCycle.h"
#include "Solvers/RoughnessHierarchy.h"

#include <vector>

namespace dmg
{

/// What a RoughnessCycle corrects its finest level by: a cycle for its coarse matrix and the levels below, or
/// the factor of that matrix where it is small.
template <class Scalar>
class CoarseCycle
{
public:
  /// \param coarser prolongations to the coarse matrix and between the levels below, finest first.
  /// \throw as GalerkinHierarchy.
  CoarseCycle(SparseMatrix<Scalar>&& coarse, const std::vector<SparseMatrix<Scalar>>& coarser,
    const RoughnessCycleOptions& options, const ExecutionContext& context);

  /// Takes other values in the same pattern.
  void Update(SparseMatrix<Scalar>&& coarse, const ExecutionContext& context);

  /// \param residual is restricted already; \param correction is to be prolonged.
  void Apply(const Vector<Scalar>& residual, Vector<Scalar>& correction, const ExecutionContext& context)
  {
    this->Cycle.Apply(residual, correction, context);
  }

  /// \param finest stands before the levels of this cycle.
  std::vector<LevelReport> LevelsBelow(const LevelReport& finest) const;
  /// Held by this object.
  long long Bytes() const { return this->Hierarchy.Bytes() + this->Cycle.Bytes(); }

private:
  GalerkinHierarchy<Scalar> Hierarchy;
  MultigridCycle<Scalar> Cycle;
};

}

#endif
