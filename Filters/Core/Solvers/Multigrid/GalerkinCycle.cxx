#include "Solvers/Multigrid/GalerkinCycle.h"

#include <utility>

namespace dmg
{

template <class Scalar>
GalerkinCycle<Scalar>::GalerkinCycle(SparseMatrix<Scalar>&& matrix, std::vector<SparseMatrix<Scalar>> prolongations,
  const GalerkinOptions& coarsening, const CycleOptions& cycle, const ExecutionContext& context)
  : Hierarchy(std::move(matrix), std::move(prolongations), coarsening, PartOfContext(context, 0.0, 0.7))
  , Cycle(this->Hierarchy, cycle, PartOfContext(context, 0.7, 1.0))
{
  this->Hierarchy.ForgetMatrices();
}

template <class Scalar>
void GalerkinCycle<Scalar>::Update(SparseMatrix<Scalar>&& matrix, const ExecutionContext& context)
{
  this->Hierarchy.Update(std::move(matrix), PartOfContext(context, 0.0, 0.7));
  this->Cycle.Update(PartOfContext(context, 0.7, 1.0));
  this->Hierarchy.ForgetMatrices();
}

template class GalerkinCycle<double>;
template class GalerkinCycle<Complex>;

}
