#include "Solvers/Kernels/Packs.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <array>

using namespace dmg;

namespace
{

/// a b + a, by packs.
template <class Pack, class Number, std::size_t Lanes>
std::array<Number, Lanes> ByPacks(const std::array<Number, Lanes>& a, const std::array<Number, Lanes>& b)
{
  auto sum = LoadPack<Pack>(a.data());
  sum += LoadPack<Pack>(a.data()) * LoadPack<Pack>(b.data());
  std::array<Number, Lanes> result;
  StorePack(sum, result.data());
  return result;
}

template <class Pack, class Number, int Lanes>
void ExpectPlainPacksComputeAlike()
{
  test::Random random(7);
  for (int round = 0; round < 100; ++round)
  {
    std::array<Number, Lanes> a;
    std::array<Number, Lanes> b;
    std::array<Number, Lanes> expected;
    for (int lane = 0; lane < Lanes; ++lane)
    {
      a[lane] = static_cast<Number>(random.Index(1000));
      b[lane] = static_cast<Number>(random.Index(1000));
      expected[lane] = a[lane] + a[lane] * b[lane]; // exact, as of whole numbers
    }
    EXPECT_EQ((ByPacks<Pack>(a, b)), expected);
    EXPECT_EQ((ByPacks<PlainPack<Number, Lanes>>(a, b)), expected);
  }
}

}

TEST(Packs, ComputeAsNumbersDoWithAndWithoutVectorTypes)
{
  ExpectPlainPacksComputeAlike<FloatPack, float, 4>();
  ExpectPlainPacksComputeAlike<FloatPair, float, 2>();
  ExpectPlainPacksComputeAlike<DoublePack, double, 2>();
}

TEST(Packs, RoundAndWidenAsNumbersDo)
{
  const DoublePack numbers = { 1.0 / 3.0, -1e-300 };
  const PlainPack<double, 2> plain = { 1.0 / 3.0, -1e-300 };
  for (int lane = 0; lane < 2; ++lane)
  {
    const double rounded = static_cast<float>(plain[lane]);
    EXPECT_EQ(Widened(Rounded(numbers))[lane], rounded);
    EXPECT_EQ((static_cast<PlainPack<double, 2>>(static_cast<PlainPack<float, 2>>(plain)))[lane], rounded);
  }
}
