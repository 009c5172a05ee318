#include "Support/Types.h"
#include "Support/Unfilled.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace dmg;

TEST(TestUnfilled, VectorsKeepWhatIsWritten)
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
