#ifndef dmgPermutations_h
#define dmgPermutations_h

#include <cstddef>
#include <numeric>
#include <vector>

namespace dmg
{

inline std::vector<int> Inverse(const std::vector<int>& permutation)
{
  std::vector<int> inverse(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i)
  {
    inverse[permutation[i]] = static_cast<int>(i);
  }
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
