#ifndef dmgComplexPairs_h
#define dmgComplexPairs_h

#include "Support/Types.h"

/// Complex numbers are pairs of real ones in memory, by the standard.
namespace dmg
{

inline Eigen::Map<const Vector<double>> AsPairs(const Vector<Complex>& numbers)
{
  return { reinterpret_cast<const double*>(numbers.data()), 2 * numbers.size() };
}

inline Eigen::Map<const Vector<Complex>> AsComplex(const Vector<double>& pairs)
{
  return { reinterpret_cast<const Complex*>(pairs.data()), pairs.size() / 2 };
}

}

#endif
