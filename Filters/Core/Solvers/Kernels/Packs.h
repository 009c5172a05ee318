#ifndef dmgPacks_h
#define dmgPacks_h

#include <cstring>

namespace dmg
{

/// Four numbers, as one instruction of every processor takes. A loop over packs is written like one
/// over numbers; a float is a pack of one.
using FloatPack = float __attribute__((vector_size(4 * sizeof(float))));
using DoublePack = double __attribute__((vector_size(2 * sizeof(double))));

template <class Pack>
constexpr int LanesOf = sizeof(Pack) / sizeof(float);

/// Consecutive numbers.
template <class Pack, class Number>
Pack LoadPack(const Number* from)
{
  Pack pack;
  std::memcpy(&pack, from, sizeof(Pack));
  return pack;
}

template <class Pack, class Number>
void StorePack(Pack pack, Number* to)
{
  std::memcpy(static_cast<void*>(to), &pack, sizeof(Pack)); // complex numbers are pairs, by the standard
}

/// Asks for numbers that will be read soon, by lines of the cache. Inlined in any case: GCC 12 takes a
/// function of prefetches for one without effect, and drops its calls.
template <class Number>
[[gnu::always_inline]] inline void Prefetch(const Number* from, int count)
{
  constexpr int line = 64 / sizeof(Number);
  for (int k = 0; k < count; k += line)
  {
    __builtin_prefetch(from + k);
  }
}

template <class Pack>
float SumOfLanes(Pack pack)
{
  if constexpr (LanesOf<Pack> == 4)
  {
    return (pack[0] + pack[2]) + (pack[1] + pack[3]);
  }
  else
  {
    return pack;
  }
}

/// Numbers from one place for each lane. Written out: set one by one, they would go through memory.
template <class Pack>
Pack GatherPack(const float* from, const int* places)
{
  if constexpr (LanesOf<Pack> == 4)
  {
    return Pack{ from[places[0]], from[places[1]], from[places[2]], from[places[3]] };
  }
  else
  {
    return from[places[0]];
  }
}

/// Two pairs of numbers.
inline FloatPack LoadPairs(const float* first, const float* second)
{
  using Pair = double; // of the same size
  const DoublePack pairs = { LoadPack<Pair>(first), LoadPack<Pair>(second) };
  return LoadPack<FloatPack>(&pairs);
}

/// GatherPack the other way round. Where places are the same, the last lane's number stays.
template <class Pack>
void ScatterPack(Pack pack, float* to, const int* places)
{
  if constexpr (LanesOf<Pack> == 4)
  {
    to[places[0]] = pack[0];
    to[places[1]] = pack[1];
    to[places[2]] = pack[2];
    to[places[3]] = pack[3];
  }
  else
  {
    to[places[0]] = pack;
  }
}

}

#endif
