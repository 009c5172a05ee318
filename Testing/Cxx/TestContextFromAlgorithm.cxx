#include "Adapters/Pipeline/ContextFromAlgorithm.h"

#include "Support/Errors.h"
#include "TestTools.h"

#include "vtkPolyDataAlgorithm.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

using dmg::ContextFromAlgorithm;

namespace
{

/// Whether two pieces of a loop run at the same time: each waits for the other, for a while.
bool TwoPiecesMeet(const dmg::ExecutionContext& context)
{
  std::atomic<int> arrived{ 0 };
  std::atomic<bool> met{ false };
  context.ParallelFor(0, 2, 1,
    [&arrived, &met](int first, int last)
    {
      arrived += last - first;
      const auto start = std::chrono::steady_clock::now();
      while (last - first == 1 && arrived < 2 && std::chrono::steady_clock::now() - start < std::chrono::seconds(2))
      {
        std::this_thread::yield();
      }
      met = met || (last - first == 1 && arrived == 2);
    });
  return met;
}

}

TEST(ContextFromAlgorithm, TellsProgressThatNeverGoesBack)
{
  vtkNew<vtkPolyDataAlgorithm> algorithm;
  const ContextFromAlgorithm context(algorithm);
  context.Checkpoint(0.5);
  context.Checkpoint(0.25);
  EXPECT_EQ(algorithm->GetProgress(), 0.5);
  context.Checkpoint(0.75);
  EXPECT_EQ(algorithm->GetProgress(), 0.75);
}

TEST(ContextFromAlgorithm, UsesThreadsUnlessSequentialWasAskedFor)
{
  if (std::thread::hardware_concurrency() < 2)
  {
    GTEST_SKIP() << "needs two processors";
  }
  vtkNew<vtkPolyDataAlgorithm> algorithm;
  const char* const asked = std::getenv("VTK_SMP_BACKEND_IN_USE");
  if (!asked)
  {
    const std::string before = vtkSMPTools::GetBackend();
    const ContextFromAlgorithm context(algorithm);
    EXPECT_GE(context.NumberOfThreads(), 2);
    EXPECT_TRUE(TwoPiecesMeet(context));
    EXPECT_EQ(before, vtkSMPTools::GetBackend()) << "the backend was not restored";
  }

  // Asked for by the environment, before the backend is set.
  const std::string before = vtkSMPTools::GetBackend();
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 1);
  vtkSMPTools::SetBackend("Sequential");
  const ContextFromAlgorithm sequential(algorithm);
  EXPECT_EQ(sequential.NumberOfThreads(), 1);
  EXPECT_FALSE(TwoPiecesMeet(sequential));
  vtkSMPTools::SetBackend(before.c_str());
  asked ? setenv("VTK_SMP_BACKEND_IN_USE", asked, 1) : unsetenv("VTK_SMP_BACKEND_IN_USE");
}

TEST(ContextFromAlgorithm, LoopsCoverTheirRangeOnce)
{
  vtkNew<vtkPolyDataAlgorithm> algorithm;
  const ContextFromAlgorithm context(algorithm);
  std::vector<int> visits(1003, 0);
  context.ParallelFor(3, 1003, 7,
    [&visits](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        ++visits[i];
      }
    });
  for (int i = 0; i < 1003; ++i)
  {
    EXPECT_EQ(visits[i], i < 3 ? 0 : 1) << i;
  }
}

TEST(ContextFromAlgorithm, LoopsMayHaveLoops)
{
  vtkNew<vtkPolyDataAlgorithm> algorithm;
  const ContextFromAlgorithm context(algorithm);
  std::atomic<int> calls{ 0 };
  context.ParallelFor(0, 2, 1,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        context.ParallelFor(0, 1000, 10, [&calls](int begin, int end) { calls += end - begin; });
      }
    });
  EXPECT_EQ(calls, 2000);
}

TEST(ContextFromAlgorithm, ExceptionsReachTheCaller)
{
  vtkNew<vtkPolyDataAlgorithm> algorithm;
  const ContextFromAlgorithm context(algorithm);
  const auto loop = [&context]
  {
    context.ParallelFor(0, 100, 1,
      [](int first, int last)
      {
        if (first <= 57 && 57 < last)
        {
          throw std::runtime_error("57");
        }
      });
  };
  EXPECT_THROW(loop(), std::runtime_error);
}

TEST(ContextFromAlgorithm, ReportsProgressAndHearsOfAbort)
{
  vtkNew<vtkPolyDataAlgorithm> algorithm;
  const ContextFromAlgorithm context(algorithm);
  EXPECT_NO_THROW(context.Checkpoint(0.25));
  EXPECT_EQ(algorithm->GetProgress(), 0.25);
  EXPECT_FALSE(context.IsCancelled());
  const dmg::test::AbortAt abort(algorithm, 0.5);
  EXPECT_NO_THROW(context.Checkpoint(0.4));
  EXPECT_THROW(context.Checkpoint(0.6), dmg::Cancelled);
  bool heard = false;
  std::thread([&context, &heard] { heard = context.IsCancelled(); }).join();
  EXPECT_TRUE(heard);
}
