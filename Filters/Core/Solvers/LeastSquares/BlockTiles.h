#ifndef dmgBlockTiles_h
#define dmgBlockTiles_h

#include "Solvers/LeastSquares/UnknownBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// An order of blocks for a smoother of B^T B. Blocks depend on each other where they share a row of B.
///
/// A tile is a run of consecutive blocks, which are near each other if blocks, unknowns and rows of B come in
/// a spatial order. One thread takes them one after the other, in a working set that its cache holds. Tiles stand
/// colour by colour. Threads share those of a colour, which are independent. The blocks of a tile have colours as
/// well: a processor works on several independent ones at once.
class BlockTiles
{
public:
  /// The size of most tiles, in blocks: they fit the caches of a core, and small surfaces have some for each of many threads.
  static int SizeFor(int numberOfBlocks);

  /// \param Bt B^T, a row per unknown.
  /// Cost: linear in the unknowns of all blocks.
  BlockTiles(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

  int Size() const { return static_cast<int>(this->Tiles.size()); }
  /// Its blocks are First(tile) to one before Last(tile).
  int First(int tile) const { return this->Tiles[tile].First; }
  int Last(int tile) const { return this->Tiles[tile].Last; }
  /// The first tile of each colour, and their number; tiles of a colour share no row.
  const std::vector<int>& ColoursOfTiles() const { return this->TileColours; }

  /// Blocks of a tile with the same colour share no row, but for the last colour, which is for those
  /// that found none.
  static constexpr int LastBlockColour = 63;
  /// The colour of each block.
  const std::vector<char>& BlockColours() const { return this->Colours; }

private:
  struct Tile
  {
    int First;
    int Last;
  };

  void ColourBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

  std::vector<Tile> Tiles;
  std::vector<int> TileColours;
  std::vector<char> Colours;
};

}

#endif
