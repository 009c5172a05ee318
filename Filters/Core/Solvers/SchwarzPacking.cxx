#include "Solvers/SchwarzBlocks.h"

#include "Support/Errors.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

// How blocks are put into groups.
namespace dmg
{
namespace
{

/// The number of unknowns of a block; then for each of its rows a bit per unknown that touches it,
/// ascending.
using Incidence = std::vector<std::uint64_t>;

SchwarzBlocks::Pattern PatternFrom(const Incidence& incidence)
{
  SchwarzBlocks::Pattern pattern;
  const int unknowns = static_cast<int>(incidence[0]);
  const int rows = static_cast<int>(incidence.size()) - 1;
  std::vector<std::vector<std::pair<int, int>>> byRow(rows); // entry, unknown
  pattern.Offsets.push_back(0);
  for (int i = 0; i < unknowns; ++i)
  {
    for (int k = 0; k < rows; ++k)
    {
      if ((incidence[k + 1] >> i & 1) != 0)
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

/// The rows of B that a block touches, those first that fewer of its unknowns touch. Rows that the same
/// unknowns touch may change places, and so blocks that look alike get the same pattern.
class RowsOfBlock
{
public:
  explicit RowsOfBlock(const SparseMatrix<double>& transpose)
    : Bt(transpose)
    , Places(transpose.cols(), -1)
  {
  }

  void Collect(const int* unknowns, int size)
  {
    for (const auto& [unknownsOfRow, row] : this->Touched)
    {
      this->Places[row] = -1;
    }
    this->Touched.clear();
    for (int i = 0; i < size; ++i)
    {
      for (int e = this->Bt.outerIndexPtr()[unknowns[i]]; e < this->Bt.outerIndexPtr()[unknowns[i] + 1]; ++e)
      {
        const int row = this->Bt.innerIndexPtr()[e];
        if (this->Places[row] < 0)
        {
          this->Places[row] = static_cast<int>(this->Touched.size());
          this->Touched.emplace_back(0, row);
        }
        this->Touched[this->Places[row]].first |= std::uint64_t(1) << i;
      }
    }
    std::sort(this->Touched.begin(), this->Touched.end());
    this->Key.assign(1, size);
    for (int k = 0; k < this->Size(); ++k)
    {
      this->Key.push_back(this->Touched[k].first);
      this->Places[this->Touched[k].second] = k;
    }
  }

  /// Entries of B in the column of an unknown of the block, where there are any.
  void EntriesOf(int unknown, float* entries)
  {
    for (int e = this->Bt.outerIndexPtr()[unknown]; e < this->Bt.outerIndexPtr()[unknown + 1]; ++e)
    {
      entries[this->Places[this->Bt.innerIndexPtr()[e]]] = static_cast<float>(this->Bt.valuePtr()[e]);
    }
  }

  const Incidence& OfBlock() const { return this->Key; }
  int Size() const { return static_cast<int>(this->Touched.size()); }
  int operator[](int k) const { return this->Touched[k].second; }
  bool Has(int row) const { return this->Places[row] >= 0; }

private:
  const SparseMatrix<double>& Bt;
  std::vector<int> Places; ///< of rows among Touched, -1 elsewhere
  std::vector<std::pair<std::uint64_t, int>> Touched;
  Incidence Key;
};

}

/// Puts blocks into groups, and what belongs to them into the arrays of SchwarzBlocks.
class SchwarzBlocks::Packing
{
public:
  Packing(SchwarzBlocks& blocks, const SparseMatrix<double>& transpose, const UnknownBlocks& unknowns,
    const BlockTiles& tiles)
    : To(blocks)
    , Bt(transpose)
    , Of(unknowns)
    , Tiles(tiles)
    , Order(unknowns.Size())
    , Drafts(tiles.Size())
  {
  }

  void MakeGroups(const ExecutionContext& context);
  void MakeRoom();
  void Fill(const ExecutionContext& context);

private:
  static constexpr int PackLanes = LanesOf<FloatPack>;

  struct Key
  {
    int Colour;
    int Pattern;
    int Block;

    bool IsLike(const Key& other) const
    {
      return this->Colour == other.Colour && this->Pattern == other.Pattern;
    }
    bool operator<(const Key& other) const
    {
      return std::tie(this->Colour, this->Pattern, this->Block) <
        std::tie(other.Colour, other.Pattern, other.Block);
    }
  };

  /// The groups of a tile; patterns and groups count from 0 in each.
  struct Draft
  {
    std::vector<Group> Groups;
    std::vector<int> RunBegins;
    std::vector<Incidence> Patterns;
    int* Next = nullptr; ///< where the blocks of the next group go

    void BeginRun() { this->RunBegins.push_back(static_cast<int>(this->Groups.size())); }
    void AppendGroup(const Key* blocks, int lanes)
    {
      this->Groups.push_back({ blocks->Pattern, lanes, 0, 0, 0 });
      this->Next =
        std::transform(blocks, blocks + lanes, this->Next, [](const Key& key) { return key.Block; });
    }
  };

  Draft DraftOf(int tile, RowsOfBlock& rows);
  std::vector<Key> KeysOf(int tile, RowsOfBlock& rows, std::vector<Incidence>& patterns) const;
  std::vector<std::vector<Key>> IndependentBlocks(
    const Key* begin, const Key* end, RowsOfBlock& rows) const;
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
  template <class Visit>
  void ForTiles(const ExecutionContext& context, const Visit& visit) const
  {
    const int grain = std::max(1, this->Tiles.Size() / (4 * context.NumberOfThreads()));
    context.ParallelFor(0, this->Tiles.Size(), grain, [&](int first, int last) {
      RowsOfBlock rows(this->Bt);
      for (int tile = first; tile < last; ++tile)
      {
        visit(tile, rows);
      }
    });
  }
  const int* UnknownsOf(int block) const { return this->Of.Unknowns.data() + this->Of.Offsets[block]; }
  int SizeOf(int block) const { return this->Of.Offsets[block + 1] - this->Of.Offsets[block]; }

  SchwarzBlocks& To;
  const SparseMatrix<double>& Bt;
  const UnknownBlocks& Of;
  const BlockTiles& Tiles;
  std::vector<int> Order; ///< of blocks, as groups hold them
  std::vector<Draft> Drafts;
};

void SchwarzBlocks::Packing::MakeGroups(const ExecutionContext& context)
{
  this->ForTiles(context,
    [this](int tile, RowsOfBlock& rows) { this->Drafts[tile] = this->DraftOf(tile, rows); });
}

/// Of each block of a tile; and the patterns there are.
std::vector<SchwarzBlocks::Packing::Key> SchwarzBlocks::Packing::KeysOf(
  int tile, RowsOfBlock& rows, std::vector<Incidence>& patterns) const
{
  std::map<Incidence, int> numbers;
  std::vector<Key> keys;
  for (int k = this->Tiles.First(tile); k < this->Tiles.Last(tile); ++k)
  {
    rows.Collect(this->UnknownsOf(k), this->SizeOf(k));
    if (rows.Size() > MostRows)
    {
      throw InvalidInput("block " + std::to_string(k) + " touches " + std::to_string(rows.Size()) +
        " rows of the factor; split it into blocks of at most " + std::to_string(MostRows));
    }
    const auto [found, isNew] =
      numbers.try_emplace(rows.OfBlock(), static_cast<int>(patterns.size()));
    if (isNew)
    {
      patterns.push_back(rows.OfBlock());
    }
    keys.push_back({ this->Tiles.BlockColours()[k], found->second, k });
  }
  return keys;
}

/// \param begin, end blocks that look alike.
/// \return sets of blocks that share no row, each for a pack, as full as comes of each block joining the
///   first set that it can.
std::vector<std::vector<SchwarzBlocks::Packing::Key>> SchwarzBlocks::Packing::IndependentBlocks(
  const Key* begin, const Key* end, RowsOfBlock& rows) const
{
  std::vector<std::vector<Key>> packs;
  std::vector<std::vector<int>> rowsOfPacks;
  for (const Key* key = begin; key != end; ++key)
  {
    rows.Collect(this->UnknownsOf(key->Block), this->SizeOf(key->Block));
    std::size_t pack = 0;
    while (pack < packs.size() &&
      (packs[pack].size() == PackLanes ||
        std::any_of(rowsOfPacks[pack].begin(), rowsOfPacks[pack].end(),
          [&rows](int row) { return rows.Has(row); })))
    {
      ++pack;
    }
    packs.resize(std::max(packs.size(), pack + 1));
    rowsOfPacks.resize(packs.size());
    packs[pack].push_back(*key);
    for (int k = 0; k < rows.Size(); ++k)
    {
      rowsOfPacks[pack].push_back(rows[k]);
    }
  }
  return packs;
}

/// Colour by colour, blocks that fill packs; then what is left of the colours, across them.
SchwarzBlocks::Packing::Draft SchwarzBlocks::Packing::DraftOf(int tile, RowsOfBlock& rows)
{
  Draft draft;
  draft.Next = this->Order.data() + this->Tiles.First(tile);
  std::vector<Key> keys = this->KeysOf(tile, rows, draft.Patterns);
  std::vector<Key> left;
  int colourOfRun = BlockTiles::LastBlockColour;
  ForAlike(keys, [&](const Key* next, const Key* end) {
    const int colour = next->Colour;
    for (; colour != BlockTiles::LastBlockColour && end - next >= PackLanes; next += PackLanes)
    {
      if (colour != colourOfRun)
      {
        draft.BeginRun();
        colourOfRun = colour;
      }
      draft.AppendGroup(next, PackLanes);
    }
    left.insert(left.end(), next, end);
  });
  for (Key& key : left)
  {
    key.Colour = BlockTiles::LastBlockColour;
  }
  ForAlike(left, [&](const Key* begin, const Key* end) {
    for (const std::vector<Key>& pack : this->IndependentBlocks(begin, end, rows))
    {
      const int size = static_cast<int>(pack.size());
      const int lanes = size == PackLanes ? PackLanes : 1;
      for (int k = 0; k < size; k += lanes)
      {
        draft.BeginRun();
        draft.AppendGroup(&pack[k], lanes);
      }
    }
  });
  return draft;
}

/// Numbers patterns and groups through, and gives each group its place in the arrays.
void SchwarzBlocks::Packing::MakeRoom()
{
  std::map<Incidence, int> numbers;
  std::size_t indices = 0;
  std::size_t values = 0;
  std::size_t inverses = 0;
  for (Draft& draft : this->Drafts)
  {
    this->To.TileBegins.push_back(static_cast<int>(this->To.RunBegins.size()));
    for (const int begin : draft.RunBegins)
    {
      this->To.RunBegins.push_back(static_cast<int>(this->To.GroupsInOrder.size()) + begin);
    }
    std::vector<int> numbersOfTile; // of its patterns
    for (const Incidence& incidence : draft.Patterns)
    {
      const auto [found, isNew] =
        numbers.try_emplace(incidence, static_cast<int>(this->To.Patterns.size()));
      if (isNew)
      {
        this->To.Patterns.push_back(PatternFrom(incidence));
      }
      numbersOfTile.push_back(found->second);
    }
    for (Group group : draft.Groups)
    {
      const int number = numbersOfTile[group.Pattern];
      const Pattern& pattern = this->To.Patterns[number];
      group = { number, group.Lanes, static_cast<std::uint32_t>(indices),
        static_cast<std::uint32_t>(values), static_cast<std::uint32_t>(inverses) };
      indices += static_cast<std::size_t>(pattern.Unknowns() + pattern.Rows()) * group.Lanes;
      values += static_cast<std::size_t>(pattern.Entries()) * group.Lanes;
      inverses += this->To.InverseSize(group);
      this->To.GroupsInOrder.push_back(group);
    }
    draft = {};
  }
  this->To.TileBegins.push_back(static_cast<int>(this->To.RunBegins.size()));
  this->To.RunBegins.push_back(static_cast<int>(this->To.GroupsInOrder.size()));
  if (std::max({ indices, values, inverses }) > std::numeric_limits<std::uint32_t>::max())
  {
    throw InvalidInput("the smoothing blocks hold more than 2^32 numbers; decimate the surface");
  }
  this->To.Indices.resize(indices);
  this->To.EntriesOfB.resize(values);
  this->To.Inverses.resize(inverses);
}

void SchwarzBlocks::Packing::Fill(const ExecutionContext& context)
{
  this->ForTiles(context, [this](int tile, RowsOfBlock& rows) {
    int place = this->Tiles.First(tile);
    float entries[MostRows]; // of a column of B
    const Run groups = this->To.GroupsOf(this->To.TileAt(tile));
    for (int g = groups.First; g < groups.Last; ++g)
    {
      const Group& group = this->To.GroupsInOrder[g];
      const Pattern& pattern = this->To.PatternOf(group);
      for (int l = 0; l < group.Lanes; ++l)
      {
        const int block = this->Order[place++];
        const int* const unknowns = this->UnknownsOf(block);
        rows.Collect(unknowns, this->SizeOf(block));
        int* index = this->To.Indices.data() + group.Indices + l;
        for (int i = 0; i < pattern.Unknowns(); ++i, index += group.Lanes)
        {
          *index = unknowns[i];
        }
        for (int k = 0; k < pattern.Rows(); ++k, index += group.Lanes)
        {
          *index = rows[k];
        }
        float* value = this->To.EntriesOfB.data() + group.Values + l;
        for (int i = 0; i < pattern.Unknowns(); ++i)
        {
          rows.EntriesOf(unknowns[i], entries);
          for (int e = pattern.Offsets[i]; e < pattern.Offsets[i + 1]; ++e, value += group.Lanes)
          {
            *value = entries[pattern.RowOf[e]];
          }
        }
      }
    }
  });
}

SchwarzBlocks::SchwarzBlocks(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks,
  const std::vector<int>& strips, const ExecutionContext& context)
  : Blocks(blocks.Size())
{
  for (int k = 0; k < blocks.Size(); ++k)
  {
    const int unknowns = blocks.Offsets[k + 1] - blocks.Offsets[k];
    if (unknowns > LargestBlock)
    {
      throw InvalidInput("block " + std::to_string(k) + " holds " + std::to_string(unknowns) +
        " unknowns; split it into blocks of at most " + std::to_string(LargestBlock));
    }
  }
  const BlockTiles tiles(
    Bt, blocks, strips.empty() ? std::vector<int>{ 0, blocks.Size() } : strips, context);
  this->Neighbours = tiles.Neighbours();
  Packing packing(*this, Bt, blocks, tiles);
  packing.MakeGroups(context);
  packing.MakeRoom();
  packing.Fill(context);

  std::vector<int> all(this->GroupsInOrder.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<float*> places;
  places.reserve(all.size());
  for (const Group& group : this->GroupsInOrder)
  {
    places.push_back(this->Inverses.data() + group.Inverse);
  }
  this->Invert(Vector<double>::Zero(Bt.rows()), all, places, context);
}

}
