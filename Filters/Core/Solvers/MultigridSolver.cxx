#include "Solvers/MultigridSolver.h"

#include "Solvers/ConjugateGradient.h"
#include "Solvers/StationaryIteration.h"

namespace dmg
{
namespace
{

GalerkinOptions Coarsening(const MultigridOptions& options)
{
  GalerkinOptions coarsening = options.Coarsening;
  coarsening.RoundProlongations = options.MayUpdate;
  return coarsening;
}

}

template <class Scalar>
MultigridSolver<Scalar>::MultigridSolver(const SparseMatrix<Scalar>& matrix,
  std::vector<SparseMatrix<Scalar>> prolongations, const MultigridOptions& options,
  const ExecutionContext& context)
  : A(&matrix)
  , Hierarchy(
      matrix, std::move(prolongations), Coarsening(options), PartOfContext(context, 0.0, 0.7))
  , Cycle(this->Hierarchy, options.Cycle, PartOfContext(context, 0.7, 1.0))
{
  this->Hierarchy.ForgetMatrices();
  options.MayUpdate ? this->Hierarchy.ShelveProlongations() : this->Hierarchy.ForgetProlongations();
}

template <class Scalar>
void MultigridSolver<Scalar>::Update(
  const SparseMatrix<Scalar>& matrix, const ExecutionContext& context)
{
  this->A = &matrix;
  this->Hierarchy.Update(matrix, PartOfContext(context, 0.0, 0.7));
  this->Cycle.Update(PartOfContext(context, 0.7, 1.0));
  this->Hierarchy.ForgetMatrices();
  this->Hierarchy.ShelveProlongations();
}

template <class Scalar>
void MultigridSolver<Scalar>::SolveByConjugateGradients(const Vector<Scalar>& b,
  const StoppingCriteria& stop, Vector<Scalar>& x, SolveReport& report,
  const ExecutionContext& context, const ConvergenceMeasure<Scalar>* measure)
{
  ConjugateGradient<Scalar>(MatrixOperator<Scalar>(*this->A), this->Cycle, b, stop, x, report, context, measure);
}

template <class Scalar>
void MultigridSolver<Scalar>::SolveByCycles(const Vector<Scalar>& b, const StoppingCriteria& stop,
  Vector<Scalar>& x, SolveReport& report, const ExecutionContext& context,
  const ConvergenceMeasure<Scalar>* measure)
{
  StationaryIteration<Scalar>(MatrixOperator<Scalar>(*this->A), this->Cycle, b, stop, x, report, context, measure);
}

template class MultigridSolver<double>;
template class MultigridSolver<Complex>;

}
