#include "Solvers/Kernels/FirstOccurrences.h"

#include <gtest/gtest.h>

using namespace dmg;

TEST(FirstOccurrences, IndicesThatOccurComeFirst)
{
  const std::vector<int> numbers = { 4, 1, 4, 4, 1, 6 };
  FirstOccurrences order(8);
  order.Add(numbers.begin(), numbers.end());
  order.Add(1);
  order.Add(0);
  EXPECT_EQ(order.Complete(), (std::vector<int>{ 4, 1, 6, 0, 2, 3, 5, 7 }));
  EXPECT_TRUE(FirstOccurrences(0).Complete().empty());
}
