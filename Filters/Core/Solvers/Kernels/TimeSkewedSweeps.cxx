#include "Solvers/Kernels/TimeSkewedSweeps.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace dmg
{
namespace
{

// Tiles that a wave stays behind what it waits for, so that threads find these finished.
constexpr int Slack = 2;

/// How far a sweep must have come before the next may visit each tile: past the last neighbour of it and of
/// all before it.
std::vector<int> Fronts(const PartGraph& graph)
{
  std::vector<int> fronts;
  fronts.reserve(graph.Size());
  int front = 0;
  for (int tile = 0; tile < graph.Size(); ++tile)
  {
    const int last = graph.Begin(tile) == graph.End(tile) ? tile : std::max(tile, graph.End(tile)[-1]);
    front = std::max(front, std::min(last + 1 + Slack, graph.Size()));
    fronts.push_back(front);
  }
  return fronts;
}

}

TimeSkewedSweeps::TimeSkewedSweeps(PartGraph neighbours, int sweeps)
  : Graph(std::move(neighbours))
  , Sweeps(sweeps)
  , Done(this->Graph.Size())
{
  assert(sweeps >= 1);
  const int tiles = this->Graph.Size();
  const std::vector<int> fronts = Fronts(this->Graph);
  this->Visits.reserve(static_cast<std::size_t>(tiles) * sweeps);
  std::vector<int> waves(sweeps, 0); // the next tile of each
  while (waves.back() < tiles)
  {
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      int& tile = waves[sweep];
      if (tile < tiles && (sweep == 0 || waves[sweep - 1] >= fronts[tile]))
      {
        this->Visits.push_back({ tile++, sweep });
      }
    }
  }
}

long long TimeSkewedSweeps::Bytes() const
{
  return static_cast<long long>(this->Visits.size() * sizeof(Visit) +
    this->Done.size() * sizeof(this->Done[0]) +
    (this->Graph.Begins.size() + this->Graph.Neighbours.size()) * sizeof(int));
}

}
