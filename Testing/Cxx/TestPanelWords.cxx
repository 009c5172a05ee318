#include "Adapters/Pipeline/PanelWords.h"

#include <gtest/gtest.h>

#include <string>

using namespace dmg;

TEST(PanelWords, ReplaceEachRemedyOfTheCore)
{
  for (int k = 0; k < static_cast<int>(Remedy::Count); ++k)
  {
    const auto remedy = static_cast<Remedy>(k);
    const std::string text = PanelTextOf(remedy);
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.find("::"), std::string::npos) << text;
    EXPECT_EQ(InPanelWords("cell 3 is wrong; " + TextOf(remedy) + ", or " + TextOf(remedy)),
      "cell 3 is wrong; " + text + ", or " + text);
  }
  EXPECT_EQ(InPanelWords("cell 3 is wrong; repair it"), "cell 3 is wrong; repair it");
}

TEST(PanelWords, CutLongNames)
{
  const std::string hundred(100, 'n');
  EXPECT_EQ(
    InPanelWords("the array '" + hundred + "n' is not 'there'"), "the array '" + hundred + "...' is not 'there'");
  EXPECT_EQ(InPanelWords("the array '" + hundred + "' is not there"), "the array '" + hundred + "' is not there");
  EXPECT_EQ(InPanelWords("the cells' points, " + hundred + hundred), "the cells' points, " + hundred + hundred);
}
