#ifndef dmgPacks_h
#define dmgPacks_h

#include <cstring>

namespace dmg
{

/// As many numbers as one instruction of every processor takes. A loop over packs is written like one
/// over numbers; a float is a pack of one.
#if defined(__GNUC__)
using FloatPack = float __attribute__((vector_size(4 * sizeof(float))));
#else
using FloatPack = float;
#endif

template <class Pack>
constexpr int LanesOf = sizeof(Pack) / sizeof(float);

/// Consecutive numbers.
template <class Pack>
Pack LoadPack(const float* from)
{
  Pack pack;
  std::memcpy(&pack, from, sizeof(Pack));
  return pack;
}

template <class Pack>
void StorePack(Pack pack, float* to)
{
  std::memcpy(to, &pack, sizeof(Pack));
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

/// The other way round. Where places are the same, the last lane's number stays.
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
