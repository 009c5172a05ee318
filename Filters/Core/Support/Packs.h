#ifndef dmgPacks_h
#define dmgPacks_h

#include <cstdint>
#include <cstring>

namespace dmg
{

/// As many numbers as one instruction of every processor takes. A loop over packs is written like one
/// over numbers; a float is a pack of one.
using FloatPack = float __attribute__((vector_size(4 * sizeof(float))));
using IntegerPack = std::int32_t __attribute__((vector_size(4 * sizeof(std::int32_t))));
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
  std::memcpy(to, &pack, sizeof(Pack));
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

/// The same from two places, which count pairs.
inline FloatPack GatherPairs(const float* from, int first, int second)
{
  return LoadPairs(from + 2 * first, from + 2 * second);
}

/// Adds to pairs of numbers at two places, which may be the same.
inline void AddPairs(FloatPack pairs, float* to, int first, int second)
{
  using Pair = float __attribute__((vector_size(2 * sizeof(float))));
  const Pair low = __builtin_shufflevector(pairs, pairs, 0, 1);
  const Pair high = __builtin_shufflevector(pairs, pairs, 2, 3);
  StorePack(LoadPack<Pair>(to + 2 * first) + low, to + 2 * first);
  StorePack(LoadPack<Pair>(to + 2 * second) + high, to + 2 * second);
}

inline FloatPack SwapPairs(FloatPack pack)
{
  return __builtin_shufflevector(pack, pack, 1, 0, 3, 2);
}

/// Eight integers.
inline void LoadIntegers(const std::int16_t* from, IntegerPack& first, IntegerPack& last)
{
  using Short = std::int16_t __attribute__((vector_size(8 * sizeof(std::int16_t))));
  const auto integers = LoadPack<Short>(from);
  const Short low = __builtin_shufflevector(integers, integers, 0, 0, 1, 1, 2, 2, 3, 3);
  const Short high = __builtin_shufflevector(integers, integers, 4, 4, 5, 5, 6, 6, 7, 7);
  // The upper halves, with their signs.
  first = LoadPack<IntegerPack>(&low) >> 16;
  last = LoadPack<IntegerPack>(&high) >> 16;
}

inline FloatPack ToFloats(IntegerPack integers)
{
  return __builtin_convertvector(integers, FloatPack);
}

inline void ToDoubles(IntegerPack integers, DoublePack& first, DoublePack& last)
{
  using Four = double __attribute__((vector_size(4 * sizeof(double))));
  const Four numbers = __builtin_convertvector(integers, Four);
  first = __builtin_shufflevector(numbers, numbers, 0, 1);
  last = __builtin_shufflevector(numbers, numbers, 2, 3);
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
