#include "Solvers/CoarseCycle.h"

#include <complex>
#include <type_traits>
#include <utility>

namespace dmg
{
namespace
{

template <class Scalar>
GalerkinOptions CoarseningOf(const SparseMatrix<Scalar>& coarse, const RoughnessCycleOptions& options)
{
  constexpr int RealUnknownsPerRow = std::is_same<Scalar, Complex>::value ? 2 : 1;
  GalerkinOptions coarsening;
  if (RealUnknownsPerRow * coarse.rows() <= options.LargestFactor)
  {
    coarsening.CoarsestLevel = 0;
  }
  return coarsening;
}

}

template <class Scalar>
CoarseCycle<Scalar>::CoarseCycle(SparseMatrix<Scalar>&& coarse,
  const std::vector<SparseMatrix<Scalar>>& coarser, const RoughnessCycleOptions& options,
  const ExecutionContext& context)
  : Hierarchy(std::move(coarse), coarser, CoarseningOf(coarse, options),
      PartOfContext(context, 0.0, 0.7))
  , Cycle(this->Hierarchy, options.Coarse, PartOfContext(context, 0.7, 1.0))
{
  this->Hierarchy.ForgetMatrices();
}

template <class Scalar>
void CoarseCycle<Scalar>::Update(SparseMatrix<Scalar>&& coarse, const ExecutionContext& context)
{
  this->Hierarchy.Update(std::move(coarse), PartOfContext(context, 0.0, 0.7));
  this->Cycle.Update(PartOfContext(context, 0.7, 1.0));
  this->Hierarchy.ForgetMatrices();
}

template <class Scalar>
std::vector<LevelReport> CoarseCycle<Scalar>::LevelsBelow(const LevelReport& finest) const
{
  std::vector<LevelReport> levels = { finest };
  levels.insert(levels.end(), this->Hierarchy.Levels().begin(), this->Hierarchy.Levels().end());
  return levels;
}

template class CoarseCycle<double>;
template class CoarseCycle<Complex>;

}
