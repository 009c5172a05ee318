#include "Solvers/Kernels/FirstOccurrences.h"

#include <gtest/gtest.h>

using namespace dmg;

TEST(FirstOccurrences, IndicesThatOccurComeFirst)
{
  const std::vector<int> said = { 4, 1, 4, 4, 1, 6 };
  FirstOccurrences order(8);
  order.Say(said.begin(), said.end());
  order.Say(1);
  order.Say(0);
  EXPECT_EQ(order.Complete(), (std::vector<int>{ 4, 1, 6, 0, 2, 3, 5, 7 }));
  EXPECT_TRUE(FirstOccurrences(0).Complete().empty());
}
