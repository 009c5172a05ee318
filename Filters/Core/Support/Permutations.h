#ifndef dmgPermutations_h
#define dmgPermutations_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <numeric>
#include <vector>

namespace dmg
{

inline std::vector<int> Inverse(const std::vector<int>& permutation, const ExecutionContext& context = SerialContext())
{
  constexpr int Grain = 8192;
  std::vector<int> inverse(permutation.size());
  context.ParallelFor(0, static_cast<int>(permutation.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        inverse[permutation[i]] = i;
      }
    });
  return inverse;
}

/// [k] is all[order[k]]. \param all may be empty.
inline Vector<double> Gathered(
  const Vector<double>& all, const std::vector<int>& order, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  Vector<double> x(all.size());
  context.ParallelFor(0, static_cast<int>(all.size()), Grain,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        x[k] = all[order[k]];
      }
    });
  return x;
}

/// The way back: [order[k]] is x[k].
inline Vector<double> Scattered(const Vector<double>& x, const std::vector<int>& order, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  Vector<double> all(x.size());
  context.ParallelFor(0, static_cast<int>(x.size()), Grain,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        all[order[k]] = x[k];
      }
    });
  return all;
}

inline std::vector<int> Identity(int size)
{
  std::vector<int> identity(size);
  std::iota(identity.begin(), identity.end(), 0);
  return identity;
}

}

#endif
