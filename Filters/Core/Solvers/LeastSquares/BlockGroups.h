#ifndef dmgBlockGroups_h
#define dmgBlockGroups_h

#include "Solvers/LeastSquares/UnknownBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmg
{

/// The pattern in which the unknowns of a block share rows of B, which count from 0 in each block.
struct BlockPattern
{
  int InnerRows = 0;                ///< so many rows come first, which no unknown outside of the block touches
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
  /// The number of entries of a lower triangle.
  int InverseSize() const { return this->Unknowns() * (this->Unknowns() + 1) / 2; }
};

/// Blocks in groups of four, each in a lane of a pack: independent blocks of a tile (BlockTiles) whose
/// unknowns share rows of B in the same way, as the sides of most faces do, and the faces around most vertices
/// of a valence. First those of one colour, then what is left of all colours; with less than four, a block takes
/// several lanes, which read, compute and write the same. Others are groups of one. Groups of several
/// lanes save a third of a second solve: see what each part of the solvers gains in Testing/Benchmarks/README.md.
///
/// The groups give a renumbering. Unknowns that only one group uses, and the inner rows of its blocks, are stored interleaved
/// by lane, so that each loads as one vector.
struct BlockGroups
{
  static constexpr int LargestBlock = 64;
  static constexpr int MostRows = 512;

  struct Group
  {
    int Pattern;
    int Lanes;  ///< 1, or those of FloatPack
    int Blocks; ///< >= 2 if there are lanes for more; the first block has those that are left as well
    /// Begin of its unknowns among Indices: the first of each lane, the second of each lane, and so on. Its rows of
    /// B follow in the same way.
    std::size_t Indices;
  };

  std::vector<BlockPattern> Patterns;
  std::vector<Group> Groups;       ///< in the order in which they are smoothed, tile by tile
  std::vector<int> RunBegins;      ///< the first group of each run, and their number
  std::vector<int> TileBegins;     ///< the first run of each tile, and their number
  std::vector<int> ColoursOfTiles; ///< the first tile of each colour, and their number
  std::vector<int> Indices;

  const BlockPattern& PatternOf(const Group& group) const { return this->Patterns[group.Pattern]; }
  const int* Unknowns(const Group& group) const { return this->Indices.data() + group.Indices; }
  const int* Rows(const Group& group) const
  {
    return this->Unknowns(group) + this->PatternOf(group).Unknowns() * group.Lanes;
  }

  /// The order in which the groups come to them, and then the rest; of all \p unknowns or \p rows.
  std::vector<int> OrderOfUnknowns(int unknowns) const;
  std::vector<int> OrderOfRows(int rows) const;

  /// \param placesOfUnknowns, placesOfRows new numbers.
  void Renumber(const std::vector<int>& placesOfUnknowns, const std::vector<int>& placesOfRows);
};

/// \param Bt B^T, a row per unknown.
/// \throw InvalidInput a block of more than LargestBlock unknowns, or that touches more than MostRows
///   rows of B.
/// Cost: linear in the unknowns of all blocks.
BlockGroups GroupBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

}

#endif
