#ifndef dmgSchwarzBlocks_h
#define dmgSchwarzBlocks_h

#include "Solvers/LeastSquares/BlockGroups.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmg
{

/// The part of BlockSmoother that depends on B^T B alone: for each block the entries of B in its columns
/// and its inverse, group by group (BlockGroups), in the order in which they are needed.
///
/// All is single precision: the inverses of blocks and the entries of B, which makes them those of nearly
/// the same problem.
///
/// Unknowns and rows of B have places of their own, in which groups find theirs side by side (BlockGroups).
class SchwarzBlocks
{
public:
  static constexpr int LargestBlock = BlockGroups::LargestBlock;

  /// Blocks that are smoothed at once. All arrays hold lanes after each other: entry e of lane l is
  /// [e * Lanes + l].
  struct Group
  {
    int Pattern;
    int Lanes;  ///< 1, or those of FloatPack
    int Blocks; ///< in the first lanes; the first of them has those that are left as well
    /// The place of the first unknown, if they follow each other, and so do the lanes of each inner row of B;
    /// -1 if not.
    int FirstPlace;
    std::uint32_t Places;
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
  /// \throw as GroupBlocks; InvalidInput there are more than 2^32 entries.
  /// Cost: linear in the entries, and in the cubes of the sizes of blocks.
  SchwarzBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context);

  int NumberOfTiles() const { return static_cast<int>(this->TileBegins.size()) - 1; }
  /// The first tile of each colour, and their number; tiles of a colour share no row of B.
  const std::vector<int>& ColoursOfTiles() const { return this->TileColours; }
  Tile TileAt(int tile) const { return { this->TileBegins[tile], this->TileBegins[tile + 1] }; }
  Run RunAt(int run) const { return { this->RunBegins[run], this->RunBegins[run + 1] }; }
  /// All groups of a tile.
  Run GroupsOf(const Tile& tile) const { return { this->RunBegins[tile.First], this->RunBegins[tile.Last] }; }

  /// The groups in the order in which they are smoothed, tile by tile.
  const std::vector<Group>& Groups() const { return this->GroupsInOrder; }
  const std::vector<BlockPattern>& AllPatterns() const { return this->Patterns; }
  const BlockPattern& PatternOf(const Group& group) const { return this->Patterns[group.Pattern]; }

  /// The unknown at each place, and the place of each unknown.
  const std::vector<int>& UnknownsAt() const { return this->OrderOfUnknowns; }
  const std::vector<int>& PlacesOfUnknowns() const { return this->PlacesInUnknowns; }
  /// The place of each row of B.
  const std::vector<int>& PlacesOfRows() const { return this->PlacesInRows; }
  /// \param slot i * Lanes + lane for unknown i of a block.
  int UnknownOf(const Group& group, int slot) const
  {
    return this->OrderOfUnknowns[group.FirstPlace >= 0 ? group.FirstPlace + slot : this->PlacesOf(group)[slot]];
  }
  int NumberOfUnknowns(const Group& group) const { return this->PatternOf(group).Unknowns() * group.Lanes; }
  /// The places of unknowns by slots, and then of rows. But where there is a first place: of each inner row in the first
  /// lane, and then of the other rows by slots.
  const int* PlacesOf(const Group& group) const { return this->Places.data() + group.Places; }
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
  void Invert(const Vector<double>& D, const std::vector<int>& groups, const std::vector<float*>& inverses,
    const ExecutionContext& context) const;

  /// Held by this object.
  long long Bytes() const;

private:
  void MakeRoom(const BlockGroups& groups);
  void Fill(const SparseMatrix<double>& Bt, const BlockGroups& groups, const ExecutionContext& context);

  std::vector<int> TileBegins; ///< the first run of each
  std::vector<int> RunBegins;  ///< the first group of each
  std::vector<int> TileColours;
  std::vector<BlockPattern> Patterns;
  std::vector<Group> GroupsInOrder;
  std::vector<int> OrderOfUnknowns;
  std::vector<int> PlacesInUnknowns;
  std::vector<int> PlacesInRows;
  std::vector<int> Places;
  std::vector<float> EntriesOfB;
  std::vector<float> Inverses;
};

}

#endif
