#ifndef dmgSchwarzBlocks_h
#define dmgSchwarzBlocks_h

#include "Solvers/BlockTiles.h"
#include "Support/ExecutionContext.h"
#include "Support/Packs.h"
#include "Support/Types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmg
{

/// What BlockSmoother needs of the roughness B^T B alone: for each block the entries of B in its columns
/// and its inverse, in the order in which they are needed.
///
/// Blocks are smoothed in groups of four, each in a lane of a pack: independent blocks of a tile
/// (BlockTiles) whose unknowns share rows of B in the same way, as the sides of most faces do, and the
/// faces around most vertices of a valence. First those of one colour, then what is left of all colours.
/// Others are groups of one.
///
/// All is single precision: the inverses of blocks and the entries of B, which makes them those of nearly
/// the same problem.
class SchwarzBlocks
{
public:
  static constexpr int LargestBlock = 64;
  static constexpr int MostRows = 512;

  /// How the unknowns of a block share rows of B, which count from 0 in each block.
  struct Pattern
  {
    std::vector<int> Offsets;         ///< unknown i has entries Offsets[i] to [Offsets[i + 1] - 1]
    std::vector<std::uint16_t> RowOf; ///< of each entry
    /// Row k has entries EntryAt[s] of unknowns UnknownAt[s], s from RowOffsets[k] to
    /// [RowOffsets[k + 1] - 1].
    std::vector<int> RowOffsets;
    std::vector<std::uint16_t> EntryAt;
    std::vector<std::uint16_t> UnknownAt;

    int Unknowns() const { return static_cast<int>(this->Offsets.size()) - 1; }
    int Rows() const { return static_cast<int>(this->RowOffsets.size()) - 1; }
    int Entries() const { return static_cast<int>(this->RowOf.size()); }
    /// Of a lower triangle.
    int InverseSize() const { return this->Unknowns() * (this->Unknowns() + 1) / 2; }
  };

  /// Blocks that are smoothed at once. All arrays hold lanes after each other: entry e of lane l is
  /// [e * Lanes + l].
  struct Group
  {
    int Pattern;
    int Lanes; ///< 1, or those of FloatPack
    std::uint32_t Indices;
    std::uint32_t Values;
    std::uint32_t Inverse;
  };

  /// Groups from First to one before Last, which may be taken in any order: of one colour, or one group.
  struct Run
  {
    int First;
    int Last;
  };

  /// Runs from First to one before Last, which depend on each other.
  struct Tile
  {
    int First;
    int Last;
  };

  /// \param Bt B^T, a row per unknown.
  /// \param strips of the blocks, for tiles (BlockTiles); none: all in one.
  /// \throw InvalidInput a block of more than LargestBlock unknowns, or that touches more than MostRows
  ///   rows of B.
  /// Cost: linear in the unknowns of all blocks.
  SchwarzBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks,
    const std::vector<int>& strips, const ExecutionContext& context);

  int NumberOfBlocks() const { return this->Blocks; }

  int NumberOfTiles() const { return static_cast<int>(this->TileBegins.size()) - 1; }
  /// Tiles that share a row of B.
  const PartGraph& NeighboursOfTiles() const { return this->Neighbours; }
  Tile TileAt(int tile) const { return { this->TileBegins[tile], this->TileBegins[tile + 1] }; }
  Run RunAt(int run) const { return { this->RunBegins[run], this->RunBegins[run + 1] }; }
  /// All groups of a tile.
  Run GroupsOf(const Tile& tile) const
  {
    return { this->RunBegins[tile.First], this->RunBegins[tile.Last] };
  }

  /// In the order in which they are smoothed, tile by tile.
  const std::vector<Group>& Groups() const { return this->GroupsInOrder; }
  const std::vector<Pattern>& AllPatterns() const { return this->Patterns; }
  const Pattern& PatternOf(const Group& group) const { return this->Patterns[group.Pattern]; }
  const int* Unknowns(const Group& group) const { return this->Indices.data() + group.Indices; }
  /// Of B.
  const int* Rows(const Group& group) const
  {
    return this->Unknowns(group) + this->PatternOf(group).Unknowns() * group.Lanes;
  }
  /// Entries of B, unknown by unknown.
  const float* Values(const Group& group) const { return this->EntriesOfB.data() + group.Values; }
  /// The inverses of its blocks, symmetric: lower triangles by rows.
  const float* Inverse(const Group& group) const { return this->Inverses.data() + group.Inverse; }
  std::size_t InverseSize(const Group& group) const
  {
    return static_cast<std::size_t>(this->PatternOf(group).InverseSize()) * group.Lanes;
  }

  /// The inverses of the blocks of some groups of B^T B + D.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is held, and its part of the inverse
  ///   is zero.
  /// \param groups whose inverses are to be found.
  /// \param inverses where each shall go.
  void Invert(const Vector<double>& D, const std::vector<int>& groups,
    const std::vector<float*>& inverses, const ExecutionContext& context) const;

  /// Held by this object.
  long long Bytes() const;

private:
  class Packing;

  int Blocks = 0;
  std::vector<int> TileBegins; ///< the first run of each
  std::vector<int> RunBegins;  ///< the first group of each
  PartGraph Neighbours; ///< of tiles
  std::vector<Pattern> Patterns;
  std::vector<Group> GroupsInOrder;
  std::vector<int> Indices; ///< of each group its unknowns, then its rows of B
  std::vector<float> EntriesOfB;
  std::vector<float> Inverses;
};

}

#endif
