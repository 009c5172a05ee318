#ifndef dmgPenalties_h
#define dmgPenalties_h

#include "Support/Types.h"

#include <vector>

namespace dmg
{

enum class ConstraintKind
{
  Soft, ///< a penalty with a weight; constraints may disagree
  Hard, ///< holds exactly
};

/// Constraints as solvers see them: some unknowns, and how strongly each is held.
struct Penalties
{
  ConstraintKind Kind = ConstraintKind::Soft;
  std::vector<int> Unknowns; ///< ascending, each once
  Vector<double> Alignment;  ///< soft: m_b, one per unknown, >= 0, its weight included
};

}

#endif
