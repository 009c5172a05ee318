#include "Support/Types.h"
#include "Support/Unfilled.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>

using namespace dmg;

TEST(Unfilled, VectorsKeepWhatIsWritten)
{
  Unfilled<Complex> numbers(3);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  numbers.resize(1000);
  numbers.push_back({ 0.0, 7.0 });
  EXPECT_EQ(numbers[0], Complex(1.0));
  EXPECT_EQ(numbers[2], Complex(3.0));
  EXPECT_EQ(numbers.back(), Complex(0.0, 7.0));
  EXPECT_EQ(Unfilled<double>(4, 2.5), (Unfilled<double>{ 2.5, 2.5, 2.5, 2.5 }));
}

TEST(Unfilled, LazyZerosAreZeroUntilWritten)
{
  struct Pair
  {
    double Number;
    int Count;
  };
  constexpr std::size_t size = 50'000'000; // of which a few pages are touched
  LazyZeros<Pair> pairs(size);
  pairs[size - 1] = { 2.5, 3 };
  EXPECT_EQ(pairs[size - 1].Number, 2.5);
  EXPECT_EQ(pairs[size - 1].Count, 3);
  for (const std::size_t k : { std::size_t(0), size / 3, size - 2 })
  {
    EXPECT_EQ(pairs[k].Number, 0.0);
    EXPECT_EQ(pairs[k].Count, 0);
  }
  LazyZeros<int> none(0);
  EXPECT_NE(none.data(), nullptr);
}
