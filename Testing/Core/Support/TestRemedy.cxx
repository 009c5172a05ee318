#include "Support/Remedy.h"

#include <gtest/gtest.h>

#include <string>

using namespace dmg;

// Callers replace the texts one after the other, so none may contain one before it.
TEST(Remedy, HasWordsOfItsOwn)
{
  for (int k = 0; k < static_cast<int>(Remedy::Count); ++k)
  {
    const std::string text = TextOf(static_cast<Remedy>(k));
    EXPECT_GT(text.size(), 6u);
    EXPECT_EQ(text.find("vtk"), std::string::npos) << text;
    for (int former = 0; former < k; ++former)
    {
      EXPECT_EQ(text.find(TextOf(static_cast<Remedy>(former))), std::string::npos) << text;
    }
  }
}
