#include "Solvers/LeastSquares/BlockStrips.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

/// The rows of B that each block touches, each once.
struct RowsOfBlocks
{
  RowsOfBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
    : Begins(blocks.Size() + 1, 0)
  {
    const int parts = context.NumberOfThreads();
    std::vector<std::vector<int>> ofParts(parts);
    const auto firstOf = [&](int part) { return static_cast<int>(1LL * blocks.Size() * part / parts); };
    context.ParallelFor(0, parts, 1, [&](int firstPart, int lastPart) {
      std::vector<int> lastToTouch(Bt.cols(), -1); // of the rows
      for (int part = firstPart; part < lastPart; ++part)
      {
        for (int k = firstOf(part); k < firstOf(part + 1); ++k)
        {
          const std::size_t before = ofParts[part].size();
          ForEntries(Bt, blocks, k, [&](int row) {
            if (std::exchange(lastToTouch[row], k) != k)
            {
              ofParts[part].push_back(row);
            }
          });
          this->Begins[k + 1] = static_cast<int>(ofParts[part].size() - before);
        }
      }
    });
    this->Rows.reserve(OffsetsFromCounts(this->Begins));
    for (const std::vector<int>& rows : ofParts)
    {
      this->Rows.insert(this->Rows.end(), rows.begin(), rows.end());
    }
  }

  std::vector<int> Begins; ///< by block, among Rows
  std::vector<int> Rows;

private:
  template <class Visit>
  static void ForEntries(
    const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, int block, const Visit& visit)
  {
    for (int s = blocks.Offsets[block]; s < blocks.Offsets[block + 1]; ++s)
    {
      const int unknown = blocks.Unknowns[s];
      std::for_each(Bt.innerIndexPtr() + Bt.outerIndexPtr()[unknown],
        Bt.innerIndexPtr() + Bt.outerIndexPtr()[unknown + 1], visit);
    }
  }
};

/// Blocks of a component, level by level: those at the same distance from a first one.
class BlockLevels
{
public:
  BlockLevels(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
    : Of(Bt, blocks, context)
    , Begins(Bt.cols() + 1, 0)
    , IsReached(blocks.Size(), 0)
    , IsSpread(Bt.cols(), 0)
  {
    for (const int row : this->Of.Rows)
    {
      ++this->Begins[row + 1];
    }
    this->Blocks.resize(OffsetsFromCounts(this->Begins));
    std::vector<int> next(this->Begins.begin(), this->Begins.end() - 1);
    for (int k = 0; k < blocks.Size(); ++k)
    {
      this->ForRows(k, [this, &next, k](int row) { this->Blocks[next[row]++] = k; });
    }
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
      this->ForRows(this->Reached[k], [this](int row) { this->Spread(row); });
    }
  }
  /// Level by level.
  const std::vector<int>& OfComponent() const { return this->Reached; }
  /// Of levels.
  const std::vector<std::size_t>& EndsOfLevels() const { return this->Ends; }

private:
  template <class Visit>
  void ForRows(int block, const Visit& visit) const
  {
    std::for_each(this->Of.Rows.begin() + this->Of.Begins[block],
      this->Of.Rows.begin() + this->Of.Begins[block + 1], visit);
  }
  void Reach(int block)
  {
    if (std::exchange(this->IsReached[block], 1) == 0)
    {
      this->Reached.push_back(block);
    }
  }
  /// To all blocks that touch a row.
  void Spread(int row)
  {
    if (std::exchange(this->IsSpread[row], 1) == 0)
    {
      for (int s = this->Begins[row]; s < this->Begins[row + 1]; ++s)
      {
        this->Reach(this->Blocks[s]);
      }
    }
  }

  const RowsOfBlocks Of;
  std::vector<int> Begins; ///< by row, among Blocks
  std::vector<int> Blocks;
  std::vector<char> IsReached; ///< blocks
  std::vector<char> IsSpread;  ///< rows
  std::vector<int> Reached;
  std::vector<std::size_t> Ends;
};

}

BlockStrips StripsOf(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, int smallest,
  const ExecutionContext& context)
{
  std::vector<int> strips(blocks.Size());
  int strip = 0;
  int size = 0; // of the strip
  BlockLevels levels(Bt, blocks, context);
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
      // A few blocks that share no row with what is around them.
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
  return { std::move(strips), blocks.Size() > 0 ? strip + 1 : 0 };
}

}
