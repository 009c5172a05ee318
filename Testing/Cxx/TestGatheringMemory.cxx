#include "Adapters/Ranks/GatheringMemory.h"

#include "Support/Errors.h"

#include <gtest/gtest.h>

#include <string>

namespace dmg::test
{

TEST(GatheringMemory, IsThatOfTheSolverWhereArraysAreFew)
{
  // Four pieces of a million triangles, 100 bytes each with points and arrays.
  const GatheringMemory memory{ 4, 4'000'000, 3e8, 4e8 };
  EXPECT_DOUBLE_EQ(memory.NeededBytes(), 4e8 + 4e9);
  EXPECT_NO_THROW(CheckFits(memory, 4.5e9));
}

TEST(GatheringMemory, IsThatOfJoiningWhereArraysAreMany)
{
  const GatheringMemory memory{ 2, 1'000'000, 3e9, 4e9 };
  EXPECT_DOUBLE_EQ(memory.NeededBytes(), 3e9 + 2 * 4e9); // received, appended, points joined
}

TEST(GatheringMemory, TooLittleIsSaidWithTheNumbers)
{
  try
  {
    CheckFits({ 4, 20'000'000, 1.5e9, 2e9 }, 12.34e9);
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    const std::string text = error.what();
    for (const char* const words : { "4 ranks", "20000000 cells", "22 GB", "12.3 GB are free", "vtkDecimatePro" })
    {
      EXPECT_NE(text.find(words), std::string::npos) << text;
    }
  }
}

TEST(GatheringMemory, BytesHaveTwoDigitsAtMost)
{
  EXPECT_EQ(TextOfBytes(0.0), "1 MB");
  EXPECT_EQ(TextOfBytes(12.6e6), "13 MB");
  EXPECT_EQ(TextOfBytes(1.26e9), "1.3 GB");
  EXPECT_GT(FreeMemory(), 1e6);
}

}
