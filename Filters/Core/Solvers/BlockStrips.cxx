#include "Solvers/BlockStrips.h"

#include "Support/CountingSort.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <utility>

namespace dmg
{
namespace
{

/// Blocks of a component, level by level: those at the same distance from a first one.
class BlockLevels
{
public:
  BlockLevels(const PlanarProlongation& prolongation, const UnknownBlocks& blocks)
    : P(prolongation)
    , Blocks(blocks)
    , Begins(prolongation.cols() + 1, 0)
    , IsReached(blocks.Size(), 0)
    , IsSpread(prolongation.cols(), 0)
  {
    const auto forEntries = [&](const auto& visit) {
      for (int k = 0; k < blocks.Size(); ++k)
      {
        this->ForColumns(k, [&](int column) { visit(column, k); });
      }
    };
    forEntries([this](int column, int) { ++this->Begins[column + 1]; });
    this->Takers.resize(OffsetsFromCounts(this->Begins));
    std::vector<int> next(this->Begins.begin(), this->Begins.end() - 1);
    forEntries([this, &next](int column, int block) { this->Takers[next[column]++] = block; });
  }

  bool HasReached(int block) const { return this->IsReached[block] != 0; }

  /// Gathers the component of a block that has not been reached.
  void GatherFrom(int block)
  {
    this->Reached.clear();
    this->Ends.clear();
    this->Reach(block);
    for (std::size_t k = 0; k < this->Reached.size(); ++k)
    {
      if (k == (this->Ends.empty() ? 0 : this->Ends.back()))
      {
        this->Ends.push_back(this->Reached.size());
      }
      this->ForColumns(this->Reached[k], [this](int column) { this->Spread(column); });
    }
  }
  /// Level by level.
  const std::vector<int>& OfComponent() const { return this->Reached; }
  /// Of levels.
  const std::vector<std::size_t>& EndsOfLevels() const { return this->Ends; }

private:
  /// The coarse unknowns that a block takes from; those of three of its unknowns will do.
  template <class Visit>
  void ForColumns(int block, const Visit& visit) const
  {
    const int first = this->Blocks.Offsets[block];
    const int last = this->Blocks.Offsets[block + 1] - 1;
    for (const int place : { first, (first + last) / 2, last })
    {
      const int unknown = this->Blocks.Unknowns[place];
      for (int e = this->P.outerIndexPtr()[unknown]; e < this->P.outerIndexPtr()[unknown + 1]; ++e)
      {
        visit(this->P.innerIndexPtr()[e]);
      }
    }
  }
  void Reach(int block)
  {
    if (std::exchange(this->IsReached[block], 1) == 0)
    {
      this->Reached.push_back(block);
    }
  }
  /// To all blocks that take from a coarse unknown.
  void Spread(int column)
  {
    if (std::exchange(this->IsSpread[column], 1) == 0)
    {
      for (int s = this->Begins[column]; s < this->Begins[column + 1]; ++s)
      {
        this->Reach(this->Takers[s]);
      }
    }
  }

  const PlanarProlongation& P;
  const UnknownBlocks& Blocks;
  std::vector<int> Begins; ///< by coarse unknown, among Takers
  std::vector<int> Takers; ///< blocks
  std::vector<char> IsReached; ///< blocks
  std::vector<char> IsSpread;  ///< coarse unknowns
  std::vector<int> Reached;
  std::vector<std::size_t> Ends;
};

}

BlockStrips StripsOf(const PlanarProlongation& P, const UnknownBlocks& blocks, int smallest,
  const ExecutionContext& context)
{
  std::vector<int> strips(blocks.Size());
  int strip = 0;
  int size = 0; // of the strip
  BlockLevels levels(P, blocks);
  for (int first = 0; first < blocks.Size(); ++first)
  {
    if (levels.HasReached(first))
    {
      continue;
    }
    levels.GatherFrom(first);
    const std::vector<int>& component = levels.OfComponent();
    if (first > 0 && static_cast<int>(component.size()) < smallest)
    {
      // A few blocks that share no coarse unknown with what is around them.
      for (const int block : component)
      {
        strips[block] = strips[first - 1];
      }
      continue;
    }
    std::size_t begin = 0;
    for (const std::size_t end : levels.EndsOfLevels())
    {
      if (size >= smallest)
      {
        ++strip;
        size = 0;
      }
      size += static_cast<int>(end - begin);
      for (; begin < end; ++begin)
      {
        strips[component[begin]] = strip;
      }
    }
  }
  SortedItems sorted = SortByKey(
    Identity(blocks.Size()), strip + 1, [&strips](int block) { return strips[block]; }, context);
  return { std::move(sorted.Items), std::move(sorted.Begins) };
}

}
