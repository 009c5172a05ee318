#ifndef dmgBlockTiles_h
#define dmgBlockTiles_h

#include "Solvers/Kernels/PartGraph.h"
#include "Solvers/LeastSquares/UnknownBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// An order of blocks for a smoother of B^T B. Blocks depend on each other where they share a row of B.
///
/// A tile are blocks of a strip that follow each other, and stand near each other where blocks, unknowns and
/// rows of B come in a spatial order: one thread takes them one after the other, in a working set that its
/// cache holds. Tiles stand strip by strip, and in a strip those come first that are independent, for many
/// threads. The blocks of a tile have colours as well: a processor works on several independent ones at
/// once.
class BlockTiles
{
public:
  /// Of most tiles, in blocks: for the caches of a core, and some for each of many threads on small surfaces.
  static int SizeFor(int numberOfBlocks);

  /// \param Bt B^T, a row per unknown.
  /// \param strips the first block of each strip (BlockStrips), and their number. Where everything is in
  ///   one, sweeps take all independent tiles at the same time, but cannot follow each other closely.
  /// Cost: linear in the unknowns of all blocks.
  BlockTiles(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks,
    const std::vector<int>& strips, const ExecutionContext& context);

  int Size() const { return static_cast<int>(this->Tiles.size()); }
  /// Its blocks are First(tile) to one before Last(tile).
  int First(int tile) const { return this->Tiles[tile].First; }
  int Last(int tile) const { return this->Tiles[tile].Last; }
  /// Tiles that share a row.
  const PartGraph& Neighbours() const { return this->Graph; }

  /// Blocks of a tile with the same colour share no row, but for the last colour, which is for those
  /// that found none.
  static constexpr int LastBlockColour = 63;
  /// Of each block.
  const std::vector<char>& BlockColours() const { return this->Colours; }

private:
  struct Tile
  {
    int First;
    int Last;
  };

  std::vector<int> CutStrips(const std::vector<int>& strips, int numberOfBlocks);
  void OrderTilesOfStrips(const std::vector<int>& tilesOfStrips);
  void ColourBlocks(
    const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

  std::vector<Tile> Tiles;
  PartGraph Graph;
  std::vector<char> Colours;
};

}

#endif
