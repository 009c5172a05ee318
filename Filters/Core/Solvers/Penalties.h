#ifndef dmgPenalties_h
#define dmgPenalties_h

#include "Support/Types.h"

#include <algorithm>
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

/// At most 1e13 times the diagonal of R, if that is not zero: such a penalty holds its unknown to rounding, and a stronger
/// one would drown the rest of the system in rounding errors.
inline double LimitedPenalty(double penalty, double diagonalOfR)
{
  constexpr double Strongest = 1e13;
  return diagonalOfR > 0.0 ? std::min(penalty, Strongest * diagonalOfR) : penalty;
}

}

#endif
