#include "Solvers/LeastSquares/BlockSmoother.h"

#include "Solvers/Kernels/Packs.h"
#include "Support/CountingSort.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;
constexpr int GroupsAhead = 2;

/// A pattern of blocks as the kernel asks for it.
class BlockShape
{
public:
  static constexpr int MostUnknowns = BlockGroups::LargestBlock;
  static constexpr int MostRows = BlockGroups::MostRows;

  explicit BlockShape(const BlockPattern& pattern)
    : Of(pattern)
  {
  }
  int Unknowns() const { return this->Of.Unknowns(); }
  int Rows() const { return this->Of.Rows(); }
  int InnerRows() const { return this->Of.InnerRows; }

  template <class Visit>
  void ForUnknowns(const Visit& visit) const
  {
    ForNumbers(0, this->Unknowns(), visit);
  }
  template <class Visit>
  void ForRows(const Visit& visit) const
  {
    ForNumbers(0, this->Rows(), visit);
  }
  template <class Visit>
  void ForUnknownsBefore(int unknown, const Visit& visit) const
  {
    ForNumbers(0, unknown, visit);
  }
  /// Calls visit(entry, row).
  template <class Visit>
  void ForEntriesOf(int unknown, const Visit& visit) const
  {
    ForNumbers(this->Of.Offsets[unknown], this->Of.Offsets[unknown + 1],
      [&](int entry) { visit(entry, this->Of.RowOf[entry]); });
  }
  /// Calls visit(entry, unknown).
  template <class Visit>
  void ForEntriesOfRow(int row, const Visit& visit) const
  {
    ForNumbers(this->Of.RowOffsets[row], this->Of.RowOffsets[row + 1],
      [&](int slot) { visit(this->Of.EntryAt[slot], this->Of.UnknownAt[slot]); });
  }
  int FirstEntryOf(int unknown) const { return this->Of.Offsets[unknown]; }

private:
  template <class Visit>
  static void ForNumbers(int first, int last, const Visit& visit)
  {
    for (int k = first; k < last; ++k)
    {
      visit(k);
    }
  }

  const BlockPattern& Of;
};

/// y = A x for a symmetric matrix in each lane, its lower triangle by rows.
/// \param ahead a matrix that will be needed soon.
template <class Pack>
inline void MultiplySymmetric(
  const float* triangle, const BlockShape& shape, const Pack* x, Pack* y, const float* ahead)
{
  constexpr int lanes = LanesOf<Pack>;
  shape.ForUnknowns([&](auto i) {
    const int begin = i * (i + 1) / 2;
    const float* const row = triangle + begin * lanes;
    Prefetch(ahead + begin * lanes, (i + 1) * lanes);
    Pack sum = LoadPack<Pack>(row + i * lanes) * x[i];
    shape.ForUnknownsBefore(i, [&](auto j) {
      const Pack entry = LoadPack<Pack>(row + j * lanes);
      sum += entry * x[j];
      y[j] += entry * x[i];
    });
    y[i] = sum;
  });
}

/// The same where lanes are of no use, but rows are long.
inline void MultiplySymmetric(
  const float* triangle, const BlockShape& shape, const float* x, float* y, const float*)
{
  const int size = shape.Unknowns();
  constexpr int lanes = LanesOf<FloatPack>;
  for (int i = 0; i < size; ++i, ++triangle)
  {
    FloatPack sums{};
    const FloatPack factors = FloatPack{} + x[i];
    int j = 0;
    for (; j + lanes <= i; j += lanes, triangle += lanes)
    {
      const FloatPack entries = LoadPack<FloatPack>(triangle);
      sums += entries * LoadPack<FloatPack>(x + j);
      StorePack(LoadPack<FloatPack>(y + j) + entries * factors, y + j);
    }
    float sum = SumOfLanes(sums);
    for (; j < i; ++j, ++triangle)
    {
      sum += *triangle * x[j];
      y[j] += *triangle * x[i];
    }
    y[i] = sum + *triangle * x[i];
  }
}

/// Where unknowns and rows of B stand in vectors: anywhere.
template <class Pack>
class PlacesAnywhere
{
public:
  PlacesAnywhere(const BlockShape& shape, const int* places)
    : Unknowns(places)
    , Rows(places + shape.Unknowns() * Lanes)
    , NumberOfPlaces((shape.Unknowns() + shape.Rows()) * Lanes)
  {
  }
  int Size() const { return this->NumberOfPlaces; }

  Pack UnknownOf(const float* x, int i) const { return GatherPack<Pack>(x, this->Unknowns + i * Lanes); }
  void SetUnknown(Pack pack, float* x, int i) const
  {
    ScatterPack<Pack>(pack, x, this->Unknowns + i * Lanes);
  }
  Pack RowOf(const float* Bx, int k) const { return GatherPack<Pack>(Bx, this->Rows + k * Lanes); }
  void SetRow(Pack pack, float* Bx, int k) const { ScatterPack<Pack>(pack, Bx, this->Rows + k * Lanes); }

private:
  static constexpr int Lanes = LanesOf<Pack>;
  const int* const Unknowns;
  const int* const Rows;
  const int NumberOfPlaces;
};

/// The lanes of unknowns and of inner rows side by side.
class PlacesInOrder
{
public:
  PlacesInOrder(const BlockShape& shape, const int* rows, int firstPlace)
    : Of(shape)
    , FirstPlace(firstPlace)
    , Rows(rows)
  {
  }
  int Size() const { return this->Of.InnerRows() + (this->Of.Rows() - this->Of.InnerRows()) * Lanes; }

  FloatPack UnknownOf(const float* x, int i) const
  {
    return LoadPack<FloatPack>(x + this->FirstPlace + i * Lanes);
  }
  void SetUnknown(FloatPack pack, float* x, int i) const
  {
    StorePack(pack, x + this->FirstPlace + i * Lanes);
  }
  FloatPack RowOf(const float* Bx, int k) const
  {
    return k < this->Of.InnerRows() ? LoadPack<FloatPack>(Bx + this->Rows[k])
                                    : GatherPack<FloatPack>(Bx, this->OuterRow(k));
  }
  void SetRow(FloatPack pack, float* Bx, int k) const
  {
    k < this->Of.InnerRows() ? StorePack(pack, Bx + this->Rows[k])
                             : ScatterPack<FloatPack>(pack, Bx, this->OuterRow(k));
  }

private:
  static constexpr int Lanes = LanesOf<FloatPack>;
  const int* OuterRow(int k) const
  {
    return this->Rows + this->Of.InnerRows() + (k - this->Of.InnerRows()) * Lanes;
  }

  const BlockShape& Of;
  const int FirstPlace;
  const int* const Rows; ///< of inner ones the first lane's
};

/// Walks through the groups of a tile as a sweep takes them: runs up or down, but each of them upwards, which
/// processors foresee better; its groups are independent.
class GroupsInOrder
{
public:
  GroupsInOrder(const SchwarzBlocks& blocks, const SchwarzBlocks::Tile& tile, bool descending)
    : Blocks(blocks)
    , NextRun(descending ? tile.Last - 1 : tile.First)
    , EndOfRuns(descending ? tile.First - 1 : tile.Last)
    , Step(descending ? -1 : 1)
  {
    this->Enter();
  }

  bool IsAtEnd() const { return this->Of.First == this->Of.Last; }
  int Group() const { return this->Of.First; }
  void Advance()
  {
    if (!this->IsAtEnd() && ++this->Of.First == this->Of.Last)
    {
      this->Enter();
    }
  }

private:
  /// The next run, if there is one; none is empty.
  void Enter()
  {
    if (this->NextRun != this->EndOfRuns)
    {
      this->Of = this->Blocks.RunAt(this->NextRun);
      this->NextRun += this->Step;
    }
  }

  const SchwarzBlocks& Blocks;
  int NextRun;
  const int EndOfRuns;
  const int Step;
  SchwarzBlocks::Run Of = { 0, 0 }; ///< what is left of the run
};

}

BlockSmoother::BlockSmoother(const SparseMatrix<double>& factor, const RowTiles& tiles,
  const SchwarzBlocks& blocks, int sweeps, double relaxation)
  : B(factor)
  , Tiles(tiles)
  , Blocks(blocks)
  , Waves(blocks.NeighboursOfTiles(), sweeps)
  , Relaxation(static_cast<float>(relaxation))
  , Diagonal(Vector<float>::Zero(factor.cols()))
  , Right(factor.cols())
  , Step(factor.cols())
  , Bx(factor.rows())
{
  assert(relaxation > 0.0 && relaxation < 2.0);
  this->Inverses.reserve(blocks.Groups().size());
  for (const SchwarzBlocks::Group& group : blocks.Groups())
  {
    this->Inverses.push_back(blocks.Inverse(group));
  }
}

/// Whether D is not zero on some unknowns of a group.
bool BlockSmoother::Touches(const Vector<double>& D, const SchwarzBlocks::Group& group) const
{
  for (int slot = 0; slot < this->Blocks.NumberOfUnknowns(group); ++slot)
  {
    if (D[this->Blocks.UnknownOf(group, slot)] != 0.0)
    {
      return true;
    }
  }
  return false;
}

void BlockSmoother::SetDiagonal(const Vector<double>& D, const ExecutionContext& context)
{
  assert(D.size() == this->Diagonal.size());
  const int unknowns = static_cast<int>(D.size());
  this->Held = Choose(unknowns, [&D](int i) { return !std::isfinite(D[i]); }, context);
  this->Penalised =
    Choose(unknowns, [&D](int i) { return std::isfinite(D[i]) && D[i] != 0.0; }, context);
  this->Diagonal.setZero();
  for (const int i : this->Penalised)
  {
    this->Diagonal[this->Blocks.PlacesOfUnknowns()[i]] = static_cast<float>(D[i]);
  }
  const std::vector<SchwarzBlocks::Group>& groups = this->Blocks.Groups();
  const std::vector<int> changed = Choose(
    static_cast<int>(groups.size()), [&](int g) { return this->Touches(D, groups[g]); }, context);
  std::size_t size = 0;
  for (const int g : changed)
  {
    size += this->Blocks.InverseSize(groups[g]);
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    this->Inverses[g] = this->Blocks.Inverse(groups[g]);
  }
  this->ChangedInverses.resize(size);
  std::vector<float*> places;
  places.reserve(changed.size());
  float* next = this->ChangedInverses.data();
  for (const int g : changed)
  {
    places.push_back(next);
    this->Inverses[g] = next;
    next += this->Blocks.InverseSize(groups[g]);
  }
  this->Blocks.Invert(D, changed, places, context);
}

template <class Visit>
void BlockSmoother::ForPenalised(int first, int last, const Visit& visit) const
{
  for (auto i = std::lower_bound(this->Penalised.begin(), this->Penalised.end(), first);
       i != this->Penalised.end() && *i < last; ++i)
  {
    visit(*i, this->Diagonal[this->Blocks.PlacesOfUnknowns()[*i]]);
  }
}

void BlockSmoother::Begin(
  const Vector<double>& b, const ExecutionContext& context, const Vector<double>* x)
{
  const int* const places = this->Blocks.PlacesOfUnknowns().data();
  context.ParallelFor(0, static_cast<int>(b.size()), RowGrain, [&](int first, int last) {
    this->Step.segment(first, last - first).setZero();
    for (int i = first; i < last; ++i)
    {
      this->Right[places[i]] = static_cast<float>(b[i]);
    }
    if (x)
    {
      this->ForPenalised(first, last, [&](int i, double penalty) {
        this->Right[places[i]] = static_cast<float>(b[i] - penalty * (*x)[i]);
      });
    }
  });
}

template <bool Penalised, class Pack, class Places>
void BlockSmoother::SmoothBlocks(
  const BlockPattern& pattern, const Places& places, const Streams& of, const Streams& ahead)
{
  constexpr int lanes = LanesOf<Pack>;
  const BlockShape shape(pattern);
  const float* const values = of.Values;
  float* const Bx = this->Bx.data();
  float* const step = this->Step.data();

  Prefetch(ahead.Places, places.Size());
  Pack products[BlockShape::MostRows];
  shape.ForRows([&](auto k) { products[k] = places.RowOf(Bx, k); });
  Pack residuals[BlockShape::MostUnknowns];
  shape.ForUnknowns([&](auto i) {
    Pack residual = places.UnknownOf(this->Right.data(), i);
    if (Penalised)
    {
      residual -= places.UnknownOf(this->Diagonal.data(), i) * places.UnknownOf(step, i);
    }
    const int begin = shape.FirstEntryOf(i);
    Prefetch(ahead.Values + begin * lanes, (shape.FirstEntryOf(i + 1) - begin) * lanes);
    shape.ForEntriesOf(i, [&](int entry, auto row) {
      residual -= LoadPack<Pack>(values + entry * lanes) * products[row];
    });
    residuals[i] = residual;
  });
  Pack steps[BlockShape::MostUnknowns];
  MultiplySymmetric(of.Inverse, shape, residuals, steps, ahead.Inverse);
  shape.ForUnknowns([&](auto i) {
    if (!Penalised) // over-relaxation would overshoot a strong penalty
    {
      steps[i] *= this->Relaxation;
    }
    places.SetUnknown(places.UnknownOf(step, i) + steps[i], step, i);
  });
  shape.ForRows([&](auto k) {
    Pack product = products[k];
    shape.ForEntriesOfRow(k, [&](int entry, auto unknown) {
      product += LoadPack<Pack>(values + entry * lanes) * steps[unknown];
    });
    places.SetRow(product, Bx, k);
  });
}

template <bool Penalised>
void BlockSmoother::SmoothGroup(
  const SchwarzBlocks::Group& group, const Streams& of, const Streams& ahead)
{
  const BlockPattern& pattern = this->Blocks.PatternOf(group);
  const BlockShape shape(pattern);
  if (group.Lanes == 1)
  {
    this->SmoothBlocks<Penalised, float>(
      pattern, PlacesAnywhere<float>(shape, of.Places), of, ahead);
  }
  else if (group.FirstPlace < 0)
  {
    this->SmoothBlocks<Penalised, FloatPack>(
      pattern, PlacesAnywhere<FloatPack>(shape, of.Places), of, ahead);
  }
  else
  {
    this->SmoothBlocks<Penalised, FloatPack>(
      pattern, PlacesInOrder(shape, of.Places, group.FirstPlace), of, ahead);
  }
}

BlockSmoother::Streams BlockSmoother::StreamsOf(int g) const
{
  const SchwarzBlocks::Group& group = this->Blocks.Groups()[g];
  return { this->Blocks.PlacesOf(group), this->Blocks.Values(group), this->Inverses[g] };
}

void BlockSmoother::SmoothTile(const SchwarzBlocks::Tile& tile, bool descending)
{
  GroupsInOrder ahead(this->Blocks, tile, descending);
  for (int k = 0; k < GroupsAhead; ++k)
  {
    ahead.Advance();
  }
  for (GroupsInOrder at(this->Blocks, tile, descending); !at.IsAtEnd(); at.Advance(), ahead.Advance())
  {
    const int g = at.Group();
    const SchwarzBlocks::Group& group = this->Blocks.Groups()[g];
    const Streams of = this->StreamsOf(g);
    const Streams later = this->StreamsOf(ahead.IsAtEnd() ? g : ahead.Group());
    // Where D is zero, the inverse is that of the roughness.
    of.Inverse == this->Blocks.Inverse(group) ? this->SmoothGroup<false>(group, of, later)
                                              : this->SmoothGroup<true>(group, of, later);
  }
}

void BlockSmoother::RunSweeps(bool descending, const ExecutionContext& context)
{
  this->Waves.Run(descending, context,
    [this, descending](int t) { this->SmoothTile(this->Blocks.TileAt(t), descending); });
}

void BlockSmoother::PreSmooth(
  const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context)
{
  this->Begin(b, context);
  this->Bx.setZero();
  this->RunSweeps(false, context);
  x.resize(b.size());
  r.resize(b.size());
  const int* const places = this->Blocks.PlacesOfUnknowns().data();
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      x[i] = this->Step[places[i]];
      r[i] = b[i];
    }
    this->ForPenalised(first, last, [&x, &r](int i, double penalty) { r[i] -= penalty * x[i]; });
  });
  const int* const placesOfRows = this->Blocks.PlacesOfRows().data();
  this->Tiles.ForTiles(context, [&](int, int firstRow, int lastRow) {
    this->B.AddAdjoint(firstRow, lastRow,
      [&](int row) { return -static_cast<double>(this->Bx[placesOfRows[row]]); }, r.data());
  });
  for (const int i : this->Held)
  {
    r[i] = 0.0;
  }
}

void BlockSmoother::PostSmooth(
  const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  const int* const placesOfRows = this->Blocks.PlacesOfRows().data();
  context.ParallelFor(0, static_cast<int>(this->Bx.size()), RowGrain, [&](int first, int last) {
    this->B.Multiply(first, last, x.data(), [this, placesOfRows](int row, double product) {
      this->Bx[placesOfRows[row]] = static_cast<float>(product);
    });
  });
  this->Begin(b, context, &x);
  this->RunSweeps(true, context);
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      x[i] += this->Step[this->Blocks.PlacesOfUnknowns()[i]];
    }
  });
}

long long BlockSmoother::Bytes() const
{
  return this->Waves.Bytes() +
    static_cast<long long>(this->Inverses.size() * sizeof(this->Inverses[0]) +
      this->ChangedInverses.size() * sizeof(float) +
      (this->Held.size() + this->Penalised.size()) * sizeof(int) +
      (this->Diagonal.size() + this->Right.size() + this->Step.size() + this->Bx.size()) *
        sizeof(float));
}

}
