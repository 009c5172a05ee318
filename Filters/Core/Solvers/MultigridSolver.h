#ifndef dmgMultigridSolver_h
#define dmgMultigridSolver_h

#include "Solvers/ConvergenceMeasure.h"
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
  /// Keeps what Update needs: the prolongations, in single precision, to which they are rounded.
  bool MayUpdate = false;
};

/// A Galerkin hierarchy, a V-cycle on it and the iterations around the cycle. Built once per matrix,
/// asked for many right-hand sides.
template <class Scalar>
class MultigridSolver
{
public:
  /// \param A, prolongations see GalerkinHierarchy. A is borrowed: it must stay where it is.
  /// \throw as GalerkinHierarchy and MultigridCycle.
  MultigridSolver(const SparseMatrix<Scalar>& A, std::vector<SparseMatrix<Scalar>> prolongations,
    const MultigridOptions& options, const ExecutionContext& context);
  MultigridSolver(const MultigridSolver&) = delete; // the cycle refers to the hierarchy
  MultigridSolver& operator=(const MultigridSolver&) = delete;

  /// Takes other values in the same pattern; borrows A in place of the former one. After an error
  /// the solver must not be used.
  /// \pre the solver was built with MayUpdate.
  void Update(const SparseMatrix<Scalar>& A, const ExecutionContext& context);

  /// Conjugate gradients, one V-cycle as preconditioner; see ConjugateGradient.
  void SolveByConjugateGradients(const Vector<Scalar>& b, const StoppingCriteria& stop,
    Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
    const ConvergenceMeasure<Scalar>* measure = nullptr);

  /// V-cycles alone; see StationaryIteration.
  void SolveByCycles(const Vector<Scalar>& b, const StoppingCriteria& stop, Vector<Scalar>& x,
    SolveReport& report, const ExecutionContext& context,
    const ConvergenceMeasure<Scalar>* measure = nullptr);

  /// Unknowns and non-zeros, finest first.
  const std::vector<LevelReport>& Levels() const { return this->Hierarchy.Levels(); }
  /// Held by this object.
  long long Bytes() const { return this->Hierarchy.Bytes() + this->Cycle.Bytes(); }

private:
  const SparseMatrix<Scalar>* A;
  GalerkinHierarchy<Scalar> Hierarchy;
  MultigridCycle<Scalar> Cycle;
};

}

#endif
