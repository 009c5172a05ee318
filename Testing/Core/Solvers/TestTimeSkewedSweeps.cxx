#include "Solvers/Kernels/TimeSkewedSweeps.h"

#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

using namespace dmg;

namespace
{

/// Tiles touch numbers each; they are neighbours where these are the same.
PartGraph GraphOf(const std::vector<std::vector<int>>& items, int numberOfItems)
{
  return GraphOfParts(static_cast<int>(items.size()), numberOfItems,
    [&items](int tile, const auto& visit)
    {
      for (const int item : items[tile])
      {
        visit(item);
      }
    });
}

PartGraph Chain(int size)
{
  std::vector<std::vector<int>> items;
  for (int i = 0; i < size; ++i)
  {
    items.push_back({ i, i + 1 });
  }
  return GraphOf(items, size + 1);
}

std::vector<PartGraph> Graphs()
{
  std::vector<PartGraph> graphs = { Chain(0), Chain(1), Chain(2), Chain(50) };
  graphs.push_back(GraphOf(std::vector<std::vector<int>>(20), 1));         // all apart
  graphs.push_back(GraphOf(std::vector<std::vector<int>>(20, { 0 }), 1));  // each beside each
  test::Random random(7701);
  std::vector<std::vector<int>> items(60);
  for (std::vector<int>& ofTile : items)
  {
    for (int k = 0; k < 4; ++k)
    {
      ofTile.push_back(static_cast<int>(random.Uniform(0.0, 99.99)));
    }
  }
  graphs.push_back(GraphOf(items, 100));
  return graphs;
}

}

TEST(TestTimeSkewedSweeps, NeighboursAreVisitedAsByOneSweepAfterTheOther)
{
  for (const PartGraph& graph : Graphs())
  {
    for (const int sweeps : { 1, 2, 5 })
    {
      for (const int threads : { 1, 2, 4, 16 })
      {
        SCOPED_TRACE(testing::Message() << graph.Size() << " tiles, " << sweeps << " sweeps, " << threads
                                        << " threads");
        TimeSkewedSweeps waves(graph, sweeps);
        for (const bool descending : { false, true })
        {
          // What a tile has depends on all that its neighbours had: a hash of the order.
          std::vector<unsigned long long> expected(graph.Size());
          std::vector<unsigned long long> found(graph.Size());
          const auto visit = [&graph](std::vector<unsigned long long>& states, int tile)
          {
            unsigned long long state = 31 * states[tile] + tile + 1;
            for (const int* other = graph.Begin(tile); other != graph.End(tile); ++other)
            {
              state = 1000003 * state + states[*other];
            }
            states[tile] = state;
          };
          for (int sweep = 0; sweep < sweeps; ++sweep)
          {
            for (int k = 0; k < graph.Size(); ++k)
            {
              visit(expected, descending ? graph.Size() - 1 - k : k);
            }
          }
          std::atomic<int> visits{ 0 };
          waves.Run(descending, test::TbbContext(threads),
            [&](int tile)
            {
              if (tile % 3 == 0) // a thread that does not wait for it gets ahead
              {
                std::this_thread::sleep_for(std::chrono::microseconds(20));
              }
              visit(found, tile);
              ++visits;
            });
          EXPECT_EQ(found, expected);
          EXPECT_EQ(visits, sweeps * graph.Size());
        }
      }
    }
  }
}

TEST(TestTimeSkewedSweeps, SweepsFollowEachOtherClosely)
{
  constexpr int Size = 1000;
  constexpr int Sweeps = 4;
  TimeSkewedSweeps waves(Chain(Size), Sweeps);
  for (const bool descending : { false, true })
  {
    std::vector<int> lastVisits(Size, -1);
    int longest = 0; // until the next sweep comes to a tile
    int visits = 0;
    waves.Run(descending, SerialContext(),
      [&](int tile)
      {
        if (lastVisits[tile] >= 0)
        {
          longest = std::max(longest, visits - lastVisits[tile]);
        }
        lastVisits[tile] = visits++;
      });
    EXPECT_EQ(visits, Size * Sweeps);
    // A tile waits for its neighbour, and a few are left between.
    EXPECT_LE(longest, 8 * Sweeps);
  }
}

TEST(TestTimeSkewedSweeps, NoThreadNeedsAnother)
{
  // A context that runs everything in one thread, whatever it says of itself.
  class Boastful : public SerialContext
  {
  public:
    int NumberOfThreads() const override { return 8; }
  };
  TimeSkewedSweeps waves(Chain(100), 3);
  int visits = 0;
  waves.Run(true, Boastful(), [&visits](int) { ++visits; });
  EXPECT_EQ(visits, 300);
}
