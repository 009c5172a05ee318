#include "Solvers/LeastSquares/BlockTiles.h"

#include "Solvers/Kernels/PartColouring.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace dmg
{
namespace
{

constexpr int LargestTile = 1024;
constexpr int SmallestTile = 16;
constexpr int WantedTiles = 128;

/// Calls visit(row) for the rows of B that unknowns of some blocks touch, once for each time.
template <class Visit>
void ForRows(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, int firstBlock, int lastBlock, const Visit& visit)
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

int BlockTiles::SizeFor(int numberOfBlocks)
{
  return std::clamp(numberOfBlocks / WantedTiles, SmallestTile, LargestTile);
}

BlockTiles::BlockTiles(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
{
  const long long size = blocks.Size();
  const int wanted = SizeFor(blocks.Size());
  const int tiles = size > 0 ? std::max(1, static_cast<int>((size + wanted / 2) / wanted)) : 0;
  const auto first = [size, tiles](int tile) { return static_cast<int>(size * tile / tiles); };
  PartColouring colouring = ColourParts(tiles, static_cast<int>(Bt.cols()),
    [&](int tile, const auto& visit) { ForRows(Bt, blocks, first(tile), first(tile + 1), visit); });
  for (const int tile : colouring.Parts)
  {
    this->Tiles.push_back({ first(tile), first(tile + 1) });
  }
  this->TileColours = std::move(colouring.Begins);
  this->ColourBlocks(Bt, blocks, context);
}

/// Each block gets the first colour that no earlier block of its tile on one of its rows has.
void BlockTiles::ColourBlocks(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
{
  this->Colours.resize(blocks.Size());
  const int grain = std::max(1, this->Size() / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, this->Size(), grain,
    [&](int firstTile, int lastTile)
    {
      std::vector<std::uint64_t> taken(Bt.cols(), 0); // by row of B: colours of the blocks that touch it
      for (int tile = firstTile; tile < lastTile; ++tile)
      {
        for (int k = this->First(tile); k < this->Last(tile); ++k)
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
        ForRows(Bt, blocks, this->First(tile), this->Last(tile), [&](int row) { taken[row] = 0; });
      }
    });
}

}
