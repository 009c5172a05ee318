#ifndef dmgTestFailuresOfOtherRanks_h
#define dmgTestFailuresOfOtherRanks_h

#include <gtest/gtest.h>

#include <iostream>
#include <string>

namespace dmg::test
{

/// Tells of tests that fail, and of nothing else: for all ranks but the first.
class FailuresOfOtherRanks : public ::testing::EmptyTestEventListener
{
public:
  explicit FailuresOfOtherRanks(int rank)
    : Rank(rank)
  {
  }

private:
  void OnTestStart(const ::testing::TestInfo& test) override { this->Test = test.name(); }
  void OnTestPartResult(const ::testing::TestPartResult& result) override
  {
    if (result.failed())
    {
      std::cerr << "rank " << this->Rank << ", " << this->Test << ": " << (result.file_name() ? result.file_name() : "")
                << ":" << result.line_number() << "\n"
                << result.message() << std::endl;
    }
  }

  int Rank;
  std::string Test; ///< GoogleTest does not tell it to who is told of results
};

/// Leaves the printing of all else to the first rank.
inline void PrintOnFirstRank(int rank)
{
  if (rank > 0)
  {
    ::testing::TestEventListeners& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailuresOfOtherRanks(rank));
  }
}

}

#endif
