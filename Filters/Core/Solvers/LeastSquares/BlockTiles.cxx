#include "Solvers/LeastSquares/BlockTiles.h"

#include "Support/Permutations.h"

#include <algorithm>
#include <cstdint>

namespace dmg
{
namespace
{

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

int BlockTiles::SizeFor(int numberOfBlocks)
{
  return std::clamp(numberOfBlocks / WantedTiles, SmallestTile, LargestTile);
}

BlockTiles::BlockTiles(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks,
  const std::vector<int>& strips, const ExecutionContext& context)
{
  std::vector<int> tilesOfStrips = this->CutStrips(strips, blocks.Size());
  this->Graph = GraphOfParts(this->Size(), static_cast<int>(Bt.cols()), [&](int tile, const auto& visit) {
    ForRows(Bt, blocks, this->First(tile), this->Last(tile), visit);
  });
  this->OrderTilesOfStrips(tilesOfStrips);
  this->ColourBlocks(Bt, blocks, context);
}

/// Into tiles of about the same size.
/// \return the first tile of each strip, and their number.
std::vector<int> BlockTiles::CutStrips(const std::vector<int>& strips, int numberOfBlocks)
{
  const int wanted = SizeFor(numberOfBlocks);
  std::vector<int> begins;
  for (std::size_t strip = 0; strip + 1 < strips.size(); ++strip)
  {
    begins.push_back(this->Size());
    const long long size = strips[strip + 1] - strips[strip];
    const int tiles = size > 0 ? std::max(1, static_cast<int>((size + wanted / 2) / wanted)) : 0;
    for (int k = 0; k < tiles; ++k)
    {
      this->Tiles.push_back({ strips[strip] + static_cast<int>(size * k / tiles),
        strips[strip] + static_cast<int>(size * (k + 1) / tiles) });
    }
  }
  begins.push_back(this->Size());
  return begins;
}

/// Those of a strip by colours.
void BlockTiles::OrderTilesOfStrips(const std::vector<int>& tilesOfStrips)
{
  std::vector<int> colours(this->Size());
  std::vector<int> order = Identity(this->Size());
  for (std::size_t strip = 0; strip + 1 < tilesOfStrips.size(); ++strip)
  {
    ColourGreedily(this->Graph, tilesOfStrips[strip], tilesOfStrips[strip + 1], colours);
    std::stable_sort(order.begin() + tilesOfStrips[strip], order.begin() + tilesOfStrips[strip + 1],
      [&colours](int a, int b) { return colours[a] < colours[b]; });
  }
  this->Graph = Permuted(this->Graph, order);
  std::vector<Tile> ordered;
  for (const int tile : order)
  {
    ordered.push_back(this->Tiles[tile]);
  }
  this->Tiles.swap(ordered);
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
