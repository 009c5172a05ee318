#ifndef dmgSchwarzBlocks_h
#define dmgSchwarzBlocks_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmg
{

/// Small sets of unknowns that are solved for together. They may overlap.
struct UnknownBlocks
{
  std::vector<int> Offsets = { 0 }; ///< block k holds Unknowns[Offsets[k]] to [Offsets[k + 1] - 1]
  std::vector<int> Unknowns;

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
  void EndBlock() { this->Offsets.push_back(static_cast<int>(this->Unknowns.size())); }
};

/// What BlockSmoother needs of the roughness B^T B alone: blocks in tiles, and the inverse of each block.
///
/// A tile are blocks that follow each other, and stand near each other where blocks come in a spatial
/// order. One thread takes them one after the other, on copies of the few unknowns and rows of B that
/// they touch, which a cache holds together with the tile's own part of B^T; so a sweep reads memory in
/// streams. Tiles that share a row of B have different colours; tiles of a colour are independent.
/// Inside a tile, blocks are sorted by colours as well: a processor works on several blocks at once as
/// long as none waits for what another stores.
///
/// All is single precision: the inverses of blocks and the entries of B, which makes them those of nearly
/// the same problem.
class SchwarzBlocks
{
public:
  static constexpr int LargestBlock = 16;

  /// What a tile works on.
  struct Tile
  {
    int FirstBlock;
    int LastBlock; ///< one beyond
    const int* Unknowns;
    int NumberOfUnknowns;
    const int* Rows; ///< of B
    int NumberOfRows;
    /// [u] to [u + 1]: the entries of the column of B of unknown u of the tile.
    const int* ColumnBegins;
    const std::uint16_t* EntryRows; ///< numbers in Rows
    const float* EntryValues;
    /// Numbers in Unknowns, block after block; of the first block first.
    const std::uint16_t* Members;
  };

  /// \param Bt B^T, a row per unknown. Rows of B^T B with a diagonal entry near 1.
  /// \throw InvalidInput a block of more than LargestBlock unknowns.
  /// Cost: linear in the unknowns of all blocks.
  SchwarzBlocks(
    const SparseMatrix<double>& Bt, UnknownBlocks blocks, const ExecutionContext& context);

  /// In the order in which they are smoothed, which is not the caller's.
  const UnknownBlocks& Blocks() const { return this->Members; }

  int NumberOfColours() const { return static_cast<int>(this->ColourBegins.size()) - 1; }
  int NumberOfTiles() const { return static_cast<int>(this->Tiles.size()); }
  /// Calls visit(tile) for each tile of a colour, several at the same time.
  template <class Visit>
  void ForTiles(int colour, const ExecutionContext& context, const Visit& visit) const
  {
    context.ParallelFor(this->ColourBegins[colour], this->ColourBegins[colour + 1], 1,
      [this, &visit](int first, int last) {
        for (int t = first; t < last; ++t)
        {
          visit(this->Tiles[t]);
        }
      });
  }
  Tile TileAt(int tile) const;

  /// The inverse of a block, symmetric: its lower triangle by rows.
  const float* Inverse(int block) const
  {
    return this->Inverses.data() + this->InverseBegins[block];
  }
  std::size_t InverseSize(int block) const
  {
    return this->InverseBegins[block + 1] - this->InverseBegins[block];
  }

  /// The inverses of some blocks of B^T B + D.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is held, and its part of the inverse
  ///   is zero.
  /// \param blocks whose inverses are to be found.
  /// \param inverses where each shall go.
  void Invert(const SparseMatrix<double>& Bt, const Vector<double>& D,
    const std::vector<int>& blocks, const std::vector<float*>& inverses,
    const ExecutionContext& context) const;

  /// Held by this object.
  long long Bytes() const;

private:
  void MakeTiles(const SparseMatrix<double>& Bt);
  void SortTiles(const SparseMatrix<double>& Bt, const ExecutionContext& context);
  void ColourTiles();
  void CopyEntries(const SparseMatrix<double>& Bt, const ExecutionContext& context);

  UnknownBlocks Members;
  std::vector<int> Tiles;        ///< colour by colour
  std::vector<int> ColourBegins; ///< the place of the first tile of each

  // Of the tiles, one after the other.
  std::vector<int> TileBegins;   ///< the first block of each
  std::vector<int> UnknownBegins = { 0 };
  std::vector<int> Unknowns;
  std::vector<int> RowBegins = { 0 };
  std::vector<int> Rows;
  std::vector<int> ColumnBegins = { 0 };
  std::vector<std::uint16_t> EntryRows;
  std::vector<float> EntryValues;
  std::vector<std::uint16_t> LocalMembers;

  std::vector<std::size_t> InverseBegins = { 0 };
  std::vector<float> Inverses;
};

}

#endif
