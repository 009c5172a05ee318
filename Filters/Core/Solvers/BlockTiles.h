#ifndef dmgBlockTiles_h
#define dmgBlockTiles_h

#include "Support/ExecutionContext.h"
#include "Support/PartColouring.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Small sets of unknowns that are solved for together; none is empty. They may overlap.
struct UnknownBlocks
{
  std::vector<int> Offsets = { 0 }; ///< block k holds Unknowns[Offsets[k]] to [Offsets[k + 1] - 1]
  std::vector<int> Unknowns;

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
  void EndBlock() { this->Offsets.push_back(static_cast<int>(this->Unknowns.size())); }
};

/// An order of blocks for a smoother of B^T B. Blocks depend on each other where they share a row of B.
///
/// A tile are blocks that follow each other, and stand near each other where blocks, unknowns and rows of
/// B come in a spatial order: one thread takes them one after the other, in a working set that its cache
/// holds. Tiles that share a row have different colours; tiles of a colour are independent. The blocks of
/// a tile have colours as well: a processor works on several independent ones at once.
class BlockTiles
{
public:
  /// \param Bt B^T, a row per unknown.
  /// Cost: linear in the unknowns of all blocks.
  BlockTiles(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

  int Size() const { return static_cast<int>(this->Begins.size()) - 1; }
  /// The first block of each tile, and the number of blocks.
  const std::vector<int>& BeginsOfTiles() const { return this->Begins; }
  const PartColouring& Colouring() const { return this->TileColours; }

  /// Blocks of a tile with the same colour share no row, but for the last colour, which is for those
  /// that found none.
  static constexpr int LastBlockColour = 63;
  /// Of each block.
  const std::vector<char>& BlockColours() const { return this->Colours; }

private:
  void ColourBlocks(
    const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

  std::vector<int> Begins;
  PartColouring TileColours;
  std::vector<char> Colours;
};

}

#endif
