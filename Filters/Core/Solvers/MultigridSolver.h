#ifndef dmgMultigridSolver_h
#define dmgMultigridSolver_h

#include "Solvers/GalerkinHierarchy.h"
#include "Solvers/MultigridCycle.h"
#include "Solvers/SolveReport.h"
#include "Solvers/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

struct MultigridOptions
{
  GalerkinOptions Coarsening;
  CycleOptions Cycle;
};

/// A Galerkin hierarchy, a V-cycle on it and the iterations around the cycle, for vectors in the
/// order of the caller. Built once per matrix, asked for many right-hand sides.
template <class Scalar>
class MultigridSolver
{
public:
  /// \param A, prolongations see GalerkinHierarchy; nothing is borrowed.
  /// \throw as GalerkinHierarchy and MultigridCycle.
  MultigridSolver(const SparseMatrix<Scalar>& A, std::vector<SparseMatrix<Scalar>> prolongations,
    const MultigridOptions& options, const ExecutionContext& context);
  MultigridSolver(const MultigridSolver&) = delete; // the cycle refers to the hierarchy
  MultigridSolver& operator=(const MultigridSolver&) = delete;

  /// Takes other values in the same pattern. After an error the solver must not be used.
  void Update(const SparseMatrix<Scalar>& A, const ExecutionContext& context);

  /// Conjugate gradients, one V-cycle as preconditioner; see ConjugateGradient.
  void SolveByConjugateGradients(const Vector<Scalar>& b, const StoppingCriteria& stop,
    Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context);

  /// V-cycles alone; see StationaryIteration.
  void SolveByCycles(const Vector<Scalar>& b, const StoppingCriteria& stop, Vector<Scalar>& x,
    SolveReport& report, const ExecutionContext& context);

  const GalerkinHierarchy<Scalar>& Levels() const { return this->Hierarchy; }
  /// Held by this object.
  long long Bytes() const { return this->Hierarchy.Bytes() + this->Cycle.Bytes(); }

private:
  template <class Iterate>
  void Solve(const Iterate& iterate, const Vector<Scalar>& b, const StoppingCriteria& stop,
    Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context);

  GalerkinHierarchy<Scalar> Hierarchy;
  MultigridCycle<Scalar> Cycle;
};

}

#endif
