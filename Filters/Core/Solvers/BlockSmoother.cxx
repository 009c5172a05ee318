#include "Solvers/BlockSmoother.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;
constexpr int GroupsAhead = 2;

/// A pattern of blocks as the kernel asks for it.
class AnyShape
{
public:
  static constexpr int MostUnknowns = SchwarzBlocks::LargestBlock;
  static constexpr int MostRows = SchwarzBlocks::MostRows;

  explicit AnyShape(const SchwarzBlocks::Pattern& pattern)
    : Of(pattern)
  {
  }
  int Unknowns() const { return this->Of.Unknowns(); }
  int Rows() const { return this->Of.Rows(); }
  int Begin(int unknown) const { return this->Of.Offsets[unknown]; }
  int RowOf(int entry) const { return this->Of.RowOf[entry]; }
  int RowBegin(int row) const { return this->Of.RowOffsets[row]; }
  int EntryAt(int slot) const { return this->Of.EntryAt[slot]; }
  int UnknownAt(int slot) const { return this->Of.UnknownAt[slot]; }

private:
  const SchwarzBlocks::Pattern& Of;
};

/// Three unknowns, with a row for each of them, for every two and for all: the sides of a face inside of
/// a surface, the faces beyond them, its corners, and itself. The compiler knows it and unrolls all loops.
class ShapeOfSides
{
public:
  static constexpr int MostUnknowns = 3;
  static constexpr int MostRows = 7;

  static constexpr int Unknowns() { return 3; }
  static constexpr int Rows() { return 7; }
  static constexpr int Begin(int unknown) { return 4 * unknown; }
  static constexpr int RowOf(int entry) { return RowsOfEntries[entry]; }
  static constexpr int RowBegin(int row) { return RowBegins[row]; }
  static constexpr int EntryAt(int slot) { return Entries[slot]; }
  static constexpr int UnknownAt(int slot) { return Entries[slot] / 4; }

  static bool Is(const SchwarzBlocks::Pattern& pattern)
  {
    return pattern.Unknowns() == Unknowns() && pattern.Rows() == Rows() &&
      std::equal(pattern.RowOf.begin(), pattern.RowOf.end(), std::begin(RowsOfEntries),
        std::end(RowsOfEntries));
  }

private:
  // Rows ascend by the unknowns that touch them, as bits.
  static constexpr int RowsOfEntries[] = { 0, 2, 4, 6, 1, 2, 5, 6, 3, 4, 5, 6 };
  static constexpr int RowBegins[] = { 0, 1, 2, 4, 5, 7, 9, 12 };
  static constexpr int Entries[] = { 0, 4, 1, 5, 8, 2, 9, 6, 10, 3, 7, 11 };
};

/// y = A x for a symmetric matrix in each lane, its lower triangle by rows.
/// \param ahead a matrix that will be needed soon.
template <class Pack>
inline void MultiplySymmetric(
  const float* triangle, int size, const Pack* x, Pack* y, const float* ahead)
{
  constexpr int lanes = LanesOf<Pack>;
  for (int i = 0; i < size; ++i, triangle += lanes)
  {
    Prefetch(ahead, (i + 1) * lanes);
    ahead += (i + 1) * lanes;
    Pack sum{};
    for (int j = 0; j < i; ++j, triangle += lanes)
    {
      const Pack entry = LoadPack<Pack>(triangle);
      sum += entry * x[j];
      y[j] += entry * x[i];
    }
    y[i] = sum + LoadPack<Pack>(triangle) * x[i];
  }
}

/// The same where lanes are of no use, but rows are long.
inline void MultiplySymmetric(
  const float* triangle, int size, const float* x, float* y, const float*)
{
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
  for (int k = 0; k < static_cast<int>(blocks.AllPatterns().size()); ++k)
  {
    if (ShapeOfSides::Is(blocks.AllPatterns()[k]))
    {
      this->PatternOfSides = k;
    }
  }
  this->Inverses.reserve(blocks.Groups().size());
  for (const SchwarzBlocks::Group& group : blocks.Groups())
  {
    this->Inverses.push_back(blocks.Inverse(group));
  }
}

void BlockSmoother::SetDiagonal(const Vector<double>& D, const ExecutionContext& context)
{
  assert(D.size() == this->Diagonal.size());
  this->Held.clear();
  for (Eigen::Index i = 0; i < D.size(); ++i)
  {
    this->Diagonal[i] = std::isfinite(D[i]) ? static_cast<float>(D[i]) : 0.0f;
    if (!std::isfinite(D[i]))
    {
      this->Held.push_back(static_cast<int>(i));
    }
  }
  const std::vector<SchwarzBlocks::Group>& groups = this->Blocks.Groups();
  std::vector<int> changed;
  std::size_t size = 0;
  for (int g = 0; g < static_cast<int>(groups.size()); ++g)
  {
    this->Inverses[g] = this->Blocks.Inverse(groups[g]);
    if (std::any_of(this->Blocks.Unknowns(groups[g]), this->Blocks.Rows(groups[g]),
          [&D](int unknown) { return D[unknown] != 0.0; }))
    {
      changed.push_back(g);
      size += this->Blocks.InverseSize(groups[g]);
    }
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

void BlockSmoother::Begin(
  const Vector<double>& b, const ExecutionContext& context, const Vector<double>* x)
{
  context.ParallelFor(0, static_cast<int>(b.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      this->Right[i] = static_cast<float>(x ? b[i] - this->Diagonal[i] * (*x)[i] : b[i]);
      this->Step[i] = 0.0f;
    }
  });
}

template <bool Pulled, class Pack, class Shape>
void BlockSmoother::SmoothBlocks(const Shape& shape, const Streams& of, const Streams& ahead)
{
  constexpr int lanes = LanesOf<Pack>;
  const int* const unknowns = of.Indices;
  const int* const rows = unknowns + shape.Unknowns() * lanes;
  const float* const values = of.Values;

  Prefetch(ahead.Indices, (shape.Unknowns() + shape.Rows()) * lanes);
  Pack products[Shape::MostRows];
  for (int k = 0; k < shape.Rows(); ++k)
  {
    products[k] = GatherPack<Pack>(this->Bx.data(), rows + k * lanes);
  }
  Pack residuals[Shape::MostUnknowns];
  for (int i = 0; i < shape.Unknowns(); ++i)
  {
    Pack residual = GatherPack<Pack>(this->Right.data(), unknowns + i * lanes);
    if (Pulled)
    {
      residual -= GatherPack<Pack>(this->Diagonal.data(), unknowns + i * lanes) *
        GatherPack<Pack>(this->Step.data(), unknowns + i * lanes);
    }
    const int begin = shape.Begin(i);
    const int end = shape.Begin(i + 1);
    Prefetch(ahead.Values + begin * lanes, (end - begin) * lanes);
    for (int e = begin; e < end; ++e)
    {
      residual -= LoadPack<Pack>(values + e * lanes) * products[shape.RowOf(e)];
    }
    residuals[i] = residual;
  }
  Pack steps[Shape::MostUnknowns];
  MultiplySymmetric(of.Inverse, shape.Unknowns(), residuals, steps, ahead.Inverse);
  for (int i = 0; i < shape.Unknowns(); ++i)
  {
    if (!Pulled) // a strong pull is better not overshot
    {
      steps[i] *= this->Relaxation;
    }
    ScatterPack<Pack>(GatherPack<Pack>(this->Step.data(), unknowns + i * lanes) + steps[i],
      this->Step.data(), unknowns + i * lanes);
  }
  for (int k = 0; k < shape.Rows(); ++k)
  {
    Pack product = products[k];
    for (int s = shape.RowBegin(k); s < shape.RowBegin(k + 1); ++s)
    {
      product += LoadPack<Pack>(values + shape.EntryAt(s) * lanes) * steps[shape.UnknownAt(s)];
    }
    ScatterPack<Pack>(product, this->Bx.data(), rows + k * lanes);
  }
}

template <bool Pulled>
void BlockSmoother::SmoothGroup(
  const SchwarzBlocks::Group& group, const Streams& of, const Streams& ahead)
{
  const AnyShape shape(this->Blocks.PatternOf(group));
  if (group.Lanes == 1)
  {
    this->SmoothBlocks<Pulled, float>(shape, of, ahead);
  }
  else if (group.Pattern == this->PatternOfSides)
  {
    this->SmoothBlocks<Pulled, FloatPack>(ShapeOfSides(), of, ahead);
  }
  else
  {
    this->SmoothBlocks<Pulled, FloatPack>(shape, of, ahead);
  }
}

BlockSmoother::Streams BlockSmoother::StreamsOf(int g) const
{
  const SchwarzBlocks::Group& group = this->Blocks.Groups()[g];
  return { this->Blocks.Unknowns(group), this->Blocks.Values(group), this->Inverses[g] };
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
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      x[i] = this->Step[i];
      r[i] = b[i] - this->Diagonal[i] * x[i];
    }
  });
  SubtractAdjointProduct(this->B, this->Tiles, this->Bx, r, context);
  for (const int i : this->Held)
  {
    r[i] = 0.0;
  }
}

void BlockSmoother::PostSmooth(
  const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(this->Bx.size()), RowGrain, [&](int first, int last) {
    this->B.Multiply(first, last, x.data(),
      [this](int row, double product) { this->Bx[row] = static_cast<float>(product); });
  });
  this->Begin(b, context, &x);
  this->RunSweeps(true, context);
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    const int count = last - first;
    x.segment(first, count) += this->Step.segment(first, count).cast<double>();
  });
}

long long BlockSmoother::Bytes() const
{
  return this->Waves.Bytes() +
    static_cast<long long>(this->Inverses.size() * sizeof(this->Inverses[0]) +
      this->ChangedInverses.size() * sizeof(float) + this->Held.size() * sizeof(int) +
      (this->Diagonal.size() + this->Right.size() + this->Step.size() + this->Bx.size()) *
        sizeof(float));
}

}
