#ifndef dmgTimeSkewedSweeps_h
#define dmgTimeSkewedSweeps_h

#include "Solvers/Kernels/PartGraph.h"
#include "Support/ExecutionContext.h"

#include <atomic>
#include <thread>
#include <vector>

namespace dmg
{

/// Sweeps over tiles that follow each other as waves.
///
/// One sweep after the other, each takes all tiles from memory. But a tile can have its next sweep as soon as
/// its neighbours have had theirs; then it is still in the caches. So each wave follows closely behind the
/// one before, and tiles come from memory once for all sweeps (time skewing, Wonnacott 2000; for Gauss-Seidel
/// on unstructured grids, Strout, Carter, Ferrante, Kreaseck 2004). How closely depends on the tiles: the
/// neighbours of each should have numbers near its own.
///
/// With caches that hold a surface this gains little: 0 to 5 % of a second solve on the median of 14 surfaces, 3 and 12 % on
/// 500,000 faces, one thread.
///
/// Neighbours are visited in the same order as by one sweep after the other, so the result is the same, bit by
/// bit, for any number of threads. These take the visits from a list, in which each comes after those that it
/// waits for: whatever the number of threads that really run, one of them can go on.
class TimeSkewedSweeps
{
public:
  /// \param neighbours tiles that must not be visited at the same time.
  /// \param sweeps >= 1.
  TimeSkewedSweeps(PartGraph neighbours, int sweeps);
  TimeSkewedSweeps(const TimeSkewedSweeps&) = delete;
  TimeSkewedSweeps& operator=(const TimeSkewedSweeps&) = delete;

  /// Calls visit(tile) for each tile in each sweep: of neighbours, the one with the smaller number
  /// first. Sweeps that descend visit in the opposite order.
  /// \param visit must not throw: others would wait for it.
  template <class VisitTile>
  void Run(bool descending, const ExecutionContext& context, const VisitTile& visit)
  {
    for (std::atomic<int>& done : this->Done)
    {
      done.store(0, std::memory_order_relaxed);
    }
    std::atomic<int> next{ 0 };
    context.ParallelFor(0, context.NumberOfThreads(), 1, [&](int, int) {
      const int size = static_cast<int>(this->Visits.size());
      for (int k = next++; k < size; k = next++)
      {
        const Visit& at = this->Visits[descending ? size - 1 - k : k];
        const int sweep = descending ? this->Sweeps - 1 - at.Sweep : at.Sweep;
        this->WaitForNeighbours(at.Tile, sweep, descending);
        visit(at.Tile);
        this->Done[at.Tile].store(sweep + 1, std::memory_order_release);
      }
    });
  }

  /// Held by this object.
  long long Bytes() const;

private:
  struct Visit
  {
    int Tile;
    int Sweep;
  };

  /// Until a tile may have a sweep: those before it have had it, and all have had the one before.
  void WaitForNeighbours(int tile, int sweep, bool descending) const
  {
    this->WaitFor(tile, sweep);
    for (const int* other = this->Graph.Begin(tile); other != this->Graph.End(tile); ++other)
    {
      this->WaitFor(*other, (*other > tile) == descending ? sweep + 1 : sweep);
    }
  }
  void WaitFor(int tile, int sweeps) const
  {
    while (this->Done[tile].load(std::memory_order_acquire) < sweeps)
    {
      std::this_thread::yield();
    }
  }

  const PartGraph Graph;
  const int Sweeps;
  std::vector<Visit> Visits;
  std::vector<std::atomic<int>> Done; ///< sweeps that each tile has had
};

}

#endif
