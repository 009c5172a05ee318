#include "Solvers/LeastSquares/BlockGroups.h"

#include "Solvers/Kernels/FirstOccurrences.h"
#include "Solvers/Kernels/Packs.h"
#include "Solvers/LeastSquares/BlockTiles.h"
#include "Support/Errors.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace dmg
{
namespace
{

constexpr int PackLanes = LanesOf<FloatPack>;

/// The incidence of a block: the numbers of its unknowns and inner rows, then for each of its rows a bit per unknown that
/// touches it.
using Incidence = std::vector<std::uint64_t>;

BlockPattern PatternFrom(const Incidence& incidence)
{
  BlockPattern pattern;
  const int unknowns = static_cast<int>(incidence[0]);
  pattern.InnerRows = static_cast<int>(incidence[1]);
  const int rows = static_cast<int>(incidence.size()) - 2;
  std::vector<std::vector<std::pair<int, int>>> byRow(rows); // entry, unknown
  pattern.Offsets.push_back(0);
  for (int i = 0; i < unknowns; ++i)
  {
    for (int k = 0; k < rows; ++k)
    {
      if ((incidence[k + 2] >> i & 1) != 0)
      {
        byRow[k].emplace_back(pattern.Entries(), i);
        pattern.RowOf.push_back(static_cast<std::uint16_t>(k));
      }
    }
    pattern.Offsets.push_back(pattern.Entries());
  }
  pattern.RowOffsets.push_back(0);
  for (const auto& row : byRow)
  {
    for (const auto& [entry, unknown] : row)
    {
      pattern.EntryAt.push_back(static_cast<std::uint16_t>(entry));
      pattern.UnknownAt.push_back(static_cast<std::uint16_t>(unknown));
    }
    pattern.RowOffsets.push_back(static_cast<int>(pattern.EntryAt.size()));
  }
  return pattern;
}

/// The rows of B that a block touches: those inside of it first, and those before others that fewer of its
/// unknowns touch. Rows that the same unknowns touch may change places, and so blocks that look alike get the
/// same pattern.
class RowsOfBlock
{
public:
  /// \param lengths of the rows of B.
  RowsOfBlock(const SparseMatrix<double>& transpose, const std::vector<int>& lengths)
    : Bt(transpose)
    , Lengths(lengths)
    , Places(transpose.cols(), -1)
  {
  }

  void Collect(const int* unknowns, int size)
  {
    this->Touched.clear();
    for (int i = 0; i < size; ++i)
    {
      for (int e = this->Bt.outerIndexPtr()[unknowns[i]]; e < this->Bt.outerIndexPtr()[unknowns[i] + 1]; ++e)
      {
        const int row = this->Bt.innerIndexPtr()[e];
        if (this->Places[row] < 0)
        {
          this->Places[row] = this->Size();
          this->Touched.push_back({ this->Lengths[row], 0, row });
        }
        Touch& touch = this->Touched[this->Places[row]];
        touch.IsShared -= 1;
        touch.Unknowns |= std::uint64_t(1) << i;
      }
    }
    for (Touch& touch : this->Touched)
    {
      this->Places[touch.Row] = -1;
      touch.IsShared = touch.IsShared > 0;
    }
    std::sort(this->Touched.begin(), this->Touched.end());
    this->Key.assign(2, size);
    this->Key[1] = 0;
    for (const Touch& touch : this->Touched)
    {
      this->Key[1] += touch.IsShared == 0;
      this->Key.push_back(touch.Unknowns);
    }
  }

  const Incidence& OfBlock() const { return this->Key; }
  int Size() const { return static_cast<int>(this->Touched.size()); }
  int operator[](int k) const { return this->Touched[k].Row; }

private:
  struct Touch
  {
    int IsShared; ///< whether unknowns of other blocks touch the row
    std::uint64_t Unknowns;
    int Row;

    bool operator<(const Touch& other) const
    {
      return std::tie(this->IsShared, this->Unknowns, this->Row) < std::tie(other.IsShared, other.Unknowns, other.Row);
    }
  };

  const SparseMatrix<double>& Bt;
  const std::vector<int>& Lengths;
  std::vector<int> Places; ///< of rows among Touched, -1 elsewhere
  std::vector<Touch> Touched;
  Incidence Key;
};

/// The groups of a tile; patterns, groups and indices count from 0 in each.
class GroupsOfTile
{
public:
  std::vector<BlockGroups::Group> Groups;
  std::vector<int> RunBegins;
  std::vector<Incidence> Patterns;
  std::vector<int> Indices;

  GroupsOfTile() = default;
  /// Colour by colour, blocks that fill packs; then what is left of the colours, across them.
  GroupsOfTile(const UnknownBlocks& blocks, const BlockTiles& tiles, int tile, RowsOfBlock& rows)
  {
    std::vector<Key> keys = this->KeysOf(blocks, tiles, tile, rows);
    std::vector<Key> left;
    int colourOfRun = BlockTiles::LastBlockColour;
    ForAlike(keys,
      [&](const Key* next, const Key* end)
      {
        const int colour = next->Colour;
        for (; colour != BlockTiles::LastBlockColour && end - next >= PackLanes; next += PackLanes)
        {
          if (colour != colourOfRun)
          {
            this->BeginRun();
            colourOfRun = colour;
          }
          this->AppendGroup(next, PackLanes);
        }
        left.insert(left.end(), next, end);
      });
    for (Key& key : left)
    {
      key.Colour = BlockTiles::LastBlockColour;
    }
    ForAlike(left,
      [&](const Key* begin, const Key* end)
      {
        for (const std::vector<Key>& pack : this->IndependentBlocks(begin, end))
        {
          this->BeginRun();
          this->AppendGroup(pack.data(), static_cast<int>(pack.size()));
        }
      });
    this->IndicesOfBlocks.clear();
    this->IndicesOfBlocks.shrink_to_fit();
  }

private:
  struct Key
  {
    int Colour;
    int Pattern;
    int Begin; ///< of its unknowns, and then its rows, among IndicesOfBlocks

    bool IsLike(const Key& other) const { return this->Colour == other.Colour && this->Pattern == other.Pattern; }
    bool operator<(const Key& other) const
    {
      return std::tie(this->Colour, this->Pattern, this->Begin) < std::tie(other.Colour, other.Pattern, other.Begin);
    }
  };

  /// The keys of the blocks of a tile; new patterns are added.
  std::vector<Key> KeysOf(const UnknownBlocks& blocks, const BlockTiles& tiles, int tile, RowsOfBlock& rows)
  {
    std::map<Incidence, int> numbers;
    std::vector<Key> keys;
    for (int k = tiles.First(tile); k < tiles.Last(tile); ++k)
    {
      const int* const unknowns = blocks.Unknowns.data() + blocks.Offsets[k];
      const int size = blocks.Offsets[k + 1] - blocks.Offsets[k];
      rows.Collect(unknowns, size);
      if (rows.Size() > BlockGroups::MostRows)
      {
        throw InvalidInput("block " + std::to_string(k) + " touches " + std::to_string(rows.Size()) +
          " rows of the factor; split it into blocks of at most " + std::to_string(BlockGroups::MostRows));
      }
      const auto [found, isNew] = numbers.try_emplace(rows.OfBlock(), static_cast<int>(this->Patterns.size()));
      if (isNew)
      {
        this->Patterns.push_back(rows.OfBlock());
      }
      keys.push_back({ tiles.BlockColours()[k], found->second, static_cast<int>(this->IndicesOfBlocks.size()) });
      this->IndicesOfBlocks.insert(this->IndicesOfBlocks.end(), unknowns, unknowns + size);
      for (int row = 0; row < rows.Size(); ++row)
      {
        this->IndicesOfBlocks.push_back(rows[row]);
      }
    }
    return keys;
  }

  /// Sorts keys and calls visit(begin, end) for those of one colour and one pattern.
  template <class Visit>
  static void ForAlike(std::vector<Key>& keys, const Visit& visit)
  {
    std::sort(keys.begin(), keys.end());
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end)
    {
      while (end < keys.size() && keys[end].IsLike(keys[begin]))
      {
        ++end;
      }
      visit(&keys[begin], keys.data() + end);
    }
  }

  /// \param begin, end blocks that look alike.
  /// \return sets of blocks that share no row, each for a pack, as full as comes of each block joining the
  ///   first set that it can.
  std::vector<std::vector<Key>> IndependentBlocks(const Key* begin, const Key* end) const
  {
    std::vector<std::vector<Key>> packs;
    std::vector<std::vector<int>> rowsOfPacks; // ascending
    for (const Key* key = begin; key != end; ++key)
    {
      const int* const last = this->IndicesOfBlocks.data() + key->Begin + this->IndicesOf(key->Pattern);
      const int* const first = last - this->RowsOf(key->Pattern);
      std::size_t pack = 0;
      while (pack < packs.size() &&
        (packs[pack].size() == PackLanes ||
          std::any_of(first, last,
            [&taken = rowsOfPacks[pack]](int row) { return std::binary_search(taken.begin(), taken.end(), row); })))
      {
        ++pack;
      }
      packs.resize(std::max(packs.size(), pack + 1));
      rowsOfPacks.resize(packs.size());
      packs[pack].push_back(*key);
      rowsOfPacks[pack].insert(rowsOfPacks[pack].end(), first, last);
      std::sort(rowsOfPacks[pack].begin(), rowsOfPacks[pack].end());
    }
    return packs;
  }

  void BeginRun() { this->RunBegins.push_back(static_cast<int>(this->Groups.size())); }
  void AppendGroup(const Key* blocks, int size)
  {
    const int lanes = size > 1 ? PackLanes : 1;
    this->Groups.push_back({ blocks->Pattern, lanes, size, this->Indices.size() });
    for (int k = 0; k < this->IndicesOf(blocks->Pattern); ++k)
    {
      for (int lane = 0; lane < lanes; ++lane)
      {
        this->Indices.push_back(this->IndicesOfBlocks[blocks[lane < size ? lane : 0].Begin + k]);
      }
    }
  }

  int RowsOf(int pattern) const { return static_cast<int>(this->Patterns[pattern].size()) - 2; }
  int IndicesOf(int pattern) const { return static_cast<int>(this->Patterns[pattern][0]) + this->RowsOf(pattern); }

  std::vector<int> IndicesOfBlocks; ///< unknowns and rows, block by block
};

/// Puts the groups of all tiles together; numbers patterns and groups through.
void Append(GroupsOfTile& tile, std::map<Incidence, int>& numbers, BlockGroups& to)
{
  to.TileBegins.push_back(static_cast<int>(to.RunBegins.size()));
  for (const int begin : tile.RunBegins)
  {
    to.RunBegins.push_back(static_cast<int>(to.Groups.size()) + begin);
  }
  std::vector<int> numbersOfTile; // of its patterns
  for (const Incidence& incidence : tile.Patterns)
  {
    const auto [found, isNew] = numbers.try_emplace(incidence, static_cast<int>(to.Patterns.size()));
    if (isNew)
    {
      to.Patterns.push_back(PatternFrom(incidence));
    }
    numbersOfTile.push_back(found->second);
  }
  for (const BlockGroups::Group& group : tile.Groups)
  {
    to.Groups.push_back({ numbersOfTile[group.Pattern], group.Lanes, group.Blocks, to.Indices.size() + group.Indices });
  }
  to.Indices.insert(to.Indices.end(), tile.Indices.begin(), tile.Indices.end());
  tile = {};
}

}

std::vector<int> BlockGroups::OrderOfUnknowns(int unknowns) const
{
  FirstOccurrences order(unknowns);
  for (const Group& group : this->Groups)
  {
    order.Say(this->Unknowns(group), this->Rows(group));
  }
  return order.Complete();
}

std::vector<int> BlockGroups::OrderOfRows(int rows) const
{
  FirstOccurrences order(rows);
  for (const Group& group : this->Groups)
  {
    order.Say(this->Rows(group), this->Rows(group) + this->PatternOf(group).Rows() * group.Lanes);
  }
  return order.Complete();
}

void BlockGroups::Renumber(const std::vector<int>& placesOfUnknowns, const std::vector<int>& placesOfRows)
{
  for (const Group& group : this->Groups)
  {
    int* const unknowns = this->Indices.data() + group.Indices;
    int* const rows = unknowns + this->PatternOf(group).Unknowns() * group.Lanes;
    int* const end = rows + this->PatternOf(group).Rows() * group.Lanes;
    std::for_each(unknowns, rows, [&](int& unknown) { unknown = placesOfUnknowns[unknown]; });
    std::for_each(rows, end, [&](int& row) { row = placesOfRows[row]; });
  }
}

BlockGroups GroupBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
{
  for (int k = 0; k < blocks.Size(); ++k)
  {
    const int unknowns = blocks.Offsets[k + 1] - blocks.Offsets[k];
    if (unknowns > BlockGroups::LargestBlock)
    {
      throw InvalidInput("block " + std::to_string(k) + " holds " + std::to_string(unknowns) +
        " unknowns; split it into blocks of at most " + std::to_string(BlockGroups::LargestBlock));
    }
  }
  std::vector<int> lengths(Bt.cols(), 0); // of the rows of B
  std::for_each(Bt.innerIndexPtr(), Bt.innerIndexPtr() + Bt.nonZeros(), [&lengths](int row) { ++lengths[row]; });
  const BlockTiles tiles(Bt, blocks, context);
  std::vector<GroupsOfTile> ofTiles(tiles.Size());
  const int grain = std::max(1, tiles.Size() / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, tiles.Size(), grain,
    [&](int first, int last)
    {
      RowsOfBlock rows(Bt, lengths);
      for (int tile = first; tile < last; ++tile)
      {
        ofTiles[tile] = GroupsOfTile(blocks, tiles, tile, rows);
      }
    });

  BlockGroups groups;
  groups.ColoursOfTiles = tiles.ColoursOfTiles();
  std::size_t indices = 0;
  for (const GroupsOfTile& tile : ofTiles)
  {
    indices += tile.Indices.size();
  }
  groups.Indices.reserve(indices);
  std::map<Incidence, int> numbers;
  for (GroupsOfTile& tile : ofTiles)
  {
    Append(tile, numbers, groups);
  }
  groups.TileBegins.push_back(static_cast<int>(groups.RunBegins.size()));
  groups.RunBegins.push_back(static_cast<int>(groups.Groups.size()));
  return groups;
}

}
