#include "Solvers/BlockTiles.h"

#include <algorithm>
#include <cstdint>

namespace dmg
{
namespace
{

// Tiles for the caches of a core, and some for each of many threads on small surfaces.
constexpr int LargestTile = 1024;
constexpr int SmallestTile = 16;
constexpr int WantedTiles = 128;

/// Calls visit(row) for the rows of B that unknowns of some blocks touch, once for each time.
template <class Visit>
void ForRows(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, int firstBlock,
  int lastBlock, const Visit& visit)
{
  for (int s = blocks.Offsets[firstBlock]; s < blocks.Offsets[lastBlock]; ++s)
  {
    const int unknown = blocks.Unknowns[s];
    for (int e = Bt.outerIndexPtr()[unknown]; e < Bt.outerIndexPtr()[unknown + 1]; ++e)
    {
      visit(Bt.innerIndexPtr()[e]);
    }
  }
}

}

BlockTiles::BlockTiles(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
{
  const int size = blocks.Size();
  const int tileSize = std::clamp(size / WantedTiles, SmallestTile, LargestTile);
  for (int begin = 0; begin < size; begin += tileSize)
  {
    this->Begins.push_back(begin);
  }
  this->Begins.push_back(size);
  this->ColourBlocks(Bt, blocks, context);
  this->TileColours = ColourParts(
    this->Size(), static_cast<int>(Bt.cols()), [&](int tile, const auto& visit) {
      ForRows(Bt, blocks, this->Begins[tile], this->Begins[tile + 1], visit);
    });
}

/// Each block gets the first colour that no earlier block of its tile on one of its rows has.
void BlockTiles::ColourBlocks(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
{
  this->Colours.resize(blocks.Size());
  const int grain = std::max(1, this->Size() / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, this->Size(), grain, [&](int firstTile, int lastTile) {
    std::vector<std::uint64_t> taken(Bt.cols(), 0); // by row of B: colours of the blocks that touch it
    for (int tile = firstTile; tile < lastTile; ++tile)
    {
      for (int k = this->Begins[tile]; k < this->Begins[tile + 1]; ++k)
      {
        std::uint64_t forbidden = 0;
        ForRows(Bt, blocks, k, k + 1, [&](int row) { forbidden |= taken[row]; });
        int colour = 0;
        while (colour < LastBlockColour && (forbidden >> colour & 1) != 0)
        {
          ++colour;
        }
        ForRows(Bt, blocks, k, k + 1, [&](int row) { taken[row] |= std::uint64_t(1) << colour; });
        this->Colours[k] = static_cast<char>(colour);
      }
      ForRows(Bt, blocks, this->Begins[tile], this->Begins[tile + 1], [&](int row) { taken[row] = 0; });
    }
  });
}

}
