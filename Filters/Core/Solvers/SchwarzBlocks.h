#ifndef dmgSchwarzBlocks_h
#define dmgSchwarzBlocks_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstddef>
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

/// What BlockSmoother needs of the roughness B^T B alone: blocks in tiles, and the inverse of each block.
///
/// A tile are blocks that follow each other, and stand near each other where blocks, unknowns and rows of
/// B come in a spatial order: one thread takes them one after the other, in a working set that its cache
/// holds. Tiles that share a row of B have different colours; tiles of a colour are independent. Inside
/// a tile, blocks are sorted by colours as well: a processor works on several blocks at once as long as
/// none waits for what another stores.
///
/// All is single precision: the inverses of blocks and the entries of B, which makes them those of nearly
/// the same problem.
class SchwarzBlocks
{
public:
  static constexpr int LargestBlock = 64;

  /// Blocks from First to one before Last.
  struct Tile
  {
    int First;
    int Last;
  };

  /// Of a column of B.
  struct Entry
  {
    int Row;
    float Value;
  };

  /// \param Bt B^T, a row per unknown, about equally many entries in each: all get the room of the
  ///   longest.
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
  Tile TileAt(int tile) const { return { this->TileBegins[tile], this->TileBegins[tile + 1] }; }

  /// The column of B of each unknown, EntriesPerUnknown each, filled up with zeros.
  const Entry* Entries() const { return this->Columns.data(); }
  /// The most entries that a column of B has.
  int EntriesPerUnknown() const { return this->Width; }

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
  void MakeTiles();
  void SortTiles(const SparseMatrix<double>& Bt, const ExecutionContext& context);
  void ColourTiles(const SparseMatrix<double>& Bt);
  void CopyEntries(const SparseMatrix<double>& Bt, const ExecutionContext& context);

  UnknownBlocks Members;
  std::vector<int> TileBegins;   ///< the first block of each, in the order of blocks
  std::vector<int> Tiles;        ///< colour by colour
  std::vector<int> ColourBegins; ///< the place of the first tile of each
  std::vector<Entry> Columns;
  int Width = 0;
  std::vector<std::size_t> InverseBegins = { 0 };
  std::vector<float> Inverses;
};

}

#endif
