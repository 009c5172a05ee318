#include "Support/FailuresOfOtherRanks.h"

#include <gtest/gtest.h>

#include <mpi.h>

#include <unistd.h>

namespace
{

/// Ends a test in which a rank waits for ever; the last test that rank 0 has begun is the one.
class TimeLimit : public ::testing::EmptyTestEventListener
{
  void OnTestStart(const ::testing::TestInfo&) override { alarm(90); }
  void OnTestEnd(const ::testing::TestInfo&) override { alarm(0); }
};

}

/// Only rank 0 tells of tests that pass; all tell of those that fail.
int main(int count, char** arguments)
{
  MPI_Init(&count, &arguments);
  ::testing::InitGoogleTest(&count, arguments);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  ::testing::UnitTest::GetInstance()->listeners().Append(new TimeLimit); // which takes it
  dmg::test::PrintOnFirstRank(rank);
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
