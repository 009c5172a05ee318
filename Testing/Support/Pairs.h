#ifndef dmgTestPairs_h
#define dmgTestPairs_h

#include "Support/Types.h"

/// Complex numbers as pairs of real ones, as face fields hold vectors in the frames of faces.
/// (Complex numbers are such pairs in memory, by the standard.)
namespace dmg::test
{

inline Vector<double> AsPairs(const Vector<Complex>& numbers)
{
  return Eigen::Map<const Vector<double>>(reinterpret_cast<const double*>(numbers.data()), 2 * numbers.size());
}

inline Vector<Complex> AsComplex(const Vector<double>& pairs)
{
  return Eigen::Map<const Vector<Complex>>(reinterpret_cast<const Complex*>(pairs.data()), pairs.size() / 2);
}

}

#endif
