#ifndef dmgTestFailuresOfOtherRanks_h
#define dmgTestFailuresOfOtherRanks_h

#include <gtest/gtest.h>

#include <iostream>

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
  void OnTestPartResult(const ::testing::TestPartResult& result) override
  {
    if (result.failed())
    {
      const ::testing::TestInfo* const test = ::testing::UnitTest::GetInstance()->current_test_info();
      std::cerr << "rank " << this->Rank << ", " << (test ? test->name() : "") << ": "
                << (result.file_name() ? result.file_name() : "") << ":" << result.line_number() << "\n"
                << result.message() << std::endl;
    }
  }

  int Rank;
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
