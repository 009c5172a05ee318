#ifndef dmgPacks_h
#define dmgPacks_h

#include <cstring>

namespace dmg
{

/// A pack of numbers in plain C++, with the operators that the loops of solvers need.
template <class Number, int Lanes>
struct PlainPack
{
  Number Numbers[Lanes];

  Number operator[](int lane) const { return this->Numbers[lane]; }
  PlainPack& operator+=(const PlainPack& other)
  {
    for (int lane = 0; lane < Lanes; ++lane)
    {
      this->Numbers[lane] += other[lane];
    }
    return *this;
  }
  PlainPack& operator*=(const PlainPack& other)
  {
    for (int lane = 0; lane < Lanes; ++lane)
    {
      this->Numbers[lane] *= other[lane];
    }
    return *this;
  }
  friend PlainPack operator+(PlainPack a, const PlainPack& b) { return a += b; }
  friend PlainPack operator*(PlainPack a, const PlainPack& b) { return a *= b; }

  /// The numbers, rounded or widened.
  template <class Other>
  explicit operator PlainPack<Other, Lanes>() const
  {
    PlainPack<Other, Lanes> others;
    for (int lane = 0; lane < Lanes; ++lane)
    {
      others.Numbers[lane] = static_cast<Other>(this->Numbers[lane]);
    }
    return others;
  }
};

/// Four floats, two doubles, two floats: as one instruction of every processor takes them. A loop over packs is written like one over
/// numbers; a float is a pack of one.
#ifdef __GNUC__ // and Clang: vector types
using FloatPack = float __attribute__((vector_size(4 * sizeof(float))));
using DoublePack = double __attribute__((vector_size(2 * sizeof(double))));
using FloatPair = float __attribute__((vector_size(2 * sizeof(float))));

inline DoublePack Widened(FloatPair pair)
{
  return __builtin_convertvector(pair, DoublePack);
}
inline FloatPair Rounded(DoublePack pair)
{
  return __builtin_convertvector(pair, FloatPair);
}
#else
using FloatPack = PlainPack<float, 4>;
using DoublePack = PlainPack<double, 2>;
using FloatPair = PlainPack<float, 2>;

inline DoublePack Widened(FloatPair pair)
{
  return static_cast<DoublePack>(pair);
}
inline FloatPair Rounded(DoublePack pair)
{
  return static_cast<FloatPair>(pair);
}
#endif

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

/// Two pairs of numbers.
inline FloatPack LoadPairs(const float* first, const float* second)
{
  using Pair = double; // of the same size
  const DoublePack pairs = { LoadPack<Pair>(first), LoadPack<Pair>(second) };
  return LoadPack<FloatPack>(&pairs);
}

}

#endif
