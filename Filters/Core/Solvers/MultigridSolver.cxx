#include "Solvers/MultigridSolver.h"

#include "Solvers/ConjugateGradient.h"
#include "Solvers/StationaryIteration.h"
#include "Support/Errors.h"

namespace dmg
{

template <class Scalar>
MultigridSolver<Scalar>::MultigridSolver(const SparseMatrix<Scalar>& A,
  std::vector<SparseMatrix<Scalar>> prolongations, const MultigridOptions& options,
  const ExecutionContext& context)
  : Hierarchy(A, std::move(prolongations), options.Coarsening, PartOfContext(context, 0.0, 0.7))
  , Cycle(this->Hierarchy, options.Cycle, PartOfContext(context, 0.7, 1.0))
{
}

template <class Scalar>
void MultigridSolver<Scalar>::Update(const SparseMatrix<Scalar>& A, const ExecutionContext& context)
{
  this->Hierarchy.Update(A, PartOfContext(context, 0.0, 0.7));
  this->Cycle.Update(PartOfContext(context, 0.7, 1.0));
}

template <class Scalar>
void MultigridSolver<Scalar>::SolveByConjugateGradients(const Vector<Scalar>& b,
  const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report,
  const ExecutionContext& context)
{
  this->Solve(ConjugateGradient<Scalar>, b, stop, x, report, context);
}

template <class Scalar>
void MultigridSolver<Scalar>::SolveByCycles(const Vector<Scalar>& b, const StoppingCriteria& stop,
  Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context)
{
  this->Solve(StationaryIteration<Scalar>, b, stop, x, report, context);
}

template <class Scalar>
template <class Iterate>
void MultigridSolver<Scalar>::Solve(const Iterate& iterate, const Vector<Scalar>& b,
  const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report,
  const ExecutionContext& context)
{
  const int size = this->Hierarchy.NumberOfUnknowns(0);
  if (b.size() != size || (x.size() != 0 && x.size() != size))
  {
    throw InvalidInput("the right-hand side and the start must have " + std::to_string(size) +
      " values, one per unknown");
  }
  Vector<Scalar> bInOrder;
  Vector<Scalar> xInOrder;
  this->Hierarchy.ToOrder(b, bInOrder, context);
  if (x.size() != 0)
  {
    this->Hierarchy.ToOrder(x, xInOrder, context);
  }
  iterate(this->Hierarchy.Matrix(0), this->Cycle, bInOrder, stop, xInOrder, report, context);
  this->Hierarchy.FromOrder(xInOrder, x, context);
}

template class MultigridSolver<double>;
template class MultigridSolver<Complex>;

}
