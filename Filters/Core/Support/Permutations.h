#ifndef dmgPermutations_h
#define dmgPermutations_h

#include "Support/ExecutionContext.h"

#include <numeric>
#include <vector>

namespace dmg
{

inline std::vector<int> Inverse(
  const std::vector<int>& permutation, const ExecutionContext& context = SerialContext())
{
  constexpr int Grain = 8192;
  std::vector<int> inverse(permutation.size());
  context.ParallelFor(0, static_cast<int>(permutation.size()), Grain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      inverse[permutation[i]] = i;
    }
  });
  return inverse;
}

inline std::vector<int> Identity(int size)
{
  std::vector<int> identity(size);
  std::iota(identity.begin(), identity.end(), 0);
  return identity;
}

}

#endif
