#ifndef dmgHash_h
#define dmgHash_h

#include <cstdint>

namespace dmg
{

/// Takes one more word into a multiplicative hash, by 2^64 over the golden ratio. The same on all machines.
constexpr std::uint64_t MixHash(std::uint64_t hash, std::uint64_t word)
{
  const std::uint64_t product = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
  return product ^ (product >> 29);
}

/// A number in [-1, 1) for each index, by SplitMix64 (Steele et al. 2014): starts of iterations that are the same in each run.
inline double PseudoRandom(std::uint64_t index)
{
  std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>(static_cast<std::int64_t>(z ^ (z >> 31))) * 0x1p-63;
}

}

#endif
