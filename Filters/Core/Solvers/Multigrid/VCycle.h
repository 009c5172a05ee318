#ifndef dmgVCycle_h
#define dmgVCycle_h

#include "Solvers/Multigrid/ScaledHierarchy.h"
#include "Solvers/Multigrid/Smoother.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <vector>

namespace dmg
{

/// One V-cycle from a level down, which solves A x = b approximately from x = 0. Right-hand sides of coarser levels are
/// overwritten.
/// \param smoothers one per level but the coarsest.
template <class Scalar, class Value>
void VCycle(ScaledHierarchy<Scalar, Value>& levels, const std::vector<std::unique_ptr<Smoother<Value>>>& smoothers,
  int level, const ExecutionContext& context)
{
  const int coarsest = levels.NumberOfLevels() - 1;
  for (int l = level; l < coarsest; ++l)
  {
    levels.Restrict(l, smoothers[l]->PreSmooth(levels[l].b, levels[l].x, context), context);
  }
  levels.SolveCoarsest();
  for (int l = coarsest; l-- > level;)
  {
    levels.Correct(l, context);
    smoothers[l]->PostSmooth(levels[l].b, levels[l].x, context);
  }
}

}

#endif
