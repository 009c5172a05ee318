#ifndef dmgTestTbbContext_h
#define dmgTestTbbContext_h

#include "Support/ExecutionContext.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace dmg::test
{

/// Threads of TBB for tests and benchmarks; records progress, and asks to stop where a test wants. Under the thread
/// sanitizer, new threads for every loop: it does not see how TBB's wait for each other, as a system's TBB is not
/// instrumented, and would take all that they share for a race.
class TbbContext : public ExecutionContext
{
public:
  explicit TbbContext(int numberOfThreads)
    : Arena(numberOfThreads)
    , Threads(numberOfThreads)
  {
  }

  /// Ask to stop once progress was reported \p count times.
  void CancelAfter(int count) { this->Limit = count; }

  /// All fractions reported so far.
  const std::vector<double>& Progress() const { return this->Fractions; }

  int NumberOfThreads() const override { return this->Threads; }
  bool IsCancelled() const override
  {
    return this->Limit >= 0 && static_cast<int>(this->Fractions.size()) >= this->Limit;
  }

protected:
  void ReportProgress(double fraction) const override { this->Fractions.push_back(fraction); }

  void RunInParallel(int begin, int end, int grain, const std::function<void(int, int)>& body) const override
  {
#ifdef __SANITIZE_THREAD__
    RunInNewThreads(this->Threads, begin, end, grain, body);
#else
    this->Arena.execute(
      [&]
      {
        tbb::parallel_for(tbb::blocked_range<int>(begin, end, grain),
          [&body](const tbb::blocked_range<int>& piece) { body(piece.begin(), piece.end()); });
      });
#endif
  }

private:
  /// \param body throws nothing.
  static void RunInNewThreads(
    int numberOfThreads, int begin, int end, int grain, const std::function<void(int, int)>& body)
  {
    std::atomic<long long> next(begin);
    const auto takePieces = [&]
    {
      for (long long first = next.fetch_add(grain); first < end; first = next.fetch_add(grain))
      {
        body(static_cast<int>(first), static_cast<int>(std::min<long long>(first + grain, end)));
      }
    };
    std::vector<std::thread> others;
    for (int k = 1; k < numberOfThreads; ++k)
    {
      others.emplace_back(takePieces);
    }
    takePieces();
    for (std::thread& other : others)
    {
      other.join();
    }
  }

  mutable tbb::task_arena Arena;
  mutable std::vector<double> Fractions; // only the thread that entered the core reports
  const int Threads;
  int Limit = -1;
};

}

#endif
