#ifndef dmgLimitedPenalty_h
#define dmgLimitedPenalty_h

#include <algorithm>

namespace dmg
{

/// At most 1e13 times the diagonal of R, if that is not zero: such a penalty holds its unknown to rounding, and a stronger
/// one would drown the rest of the system in rounding errors.
inline double LimitedPenalty(double penalty, double diagonalOfR)
{
  constexpr double Strongest = 1e13;
  return diagonalOfR > 0.0 ? std::min(penalty, Strongest * diagonalOfR) : penalty;
}

}

#endif
