#include "Solvers/LeastSquares/BlockSmoother.h"

#include "Solvers/Kernels/PartColouring.h"
#include "Solvers/LeastSquares/BlockKernel.h"
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

BlockSmoother::BlockSmoother(
  const SparseMatrix<double>& factor, const RowTiles& tiles, const SchwarzBlocks& blocks, int sweeps, double relaxation)
  : B(factor)
  , Tiles(tiles)
  , Blocks(blocks)
  , Sweeps(sweeps)
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
  this->Held = Choose(
    unknowns, [&D](int i) { return !std::isfinite(D[i]); }, context);
  this->Penalised = Choose(
    unknowns, [&D](int i) { return std::isfinite(D[i]) && D[i] != 0.0; }, context);
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

void BlockSmoother::Begin(const Vector<double>& b, const ExecutionContext& context, const Vector<double>* x)
{
  const int* const places = this->Blocks.PlacesOfUnknowns().data();
  context.ParallelFor(0, static_cast<int>(b.size()), RowGrain,
    [&](int first, int last)
    {
      this->Step.segment(first, last - first).setZero();
      for (int i = first; i < last; ++i)
      {
        this->Right[places[i]] = static_cast<float>(b[i]);
      }
      if (x)
      {
        this->ForPenalised(first, last,
          [&](int i, double penalty) { this->Right[places[i]] = static_cast<float>(b[i] - penalty * (*x)[i]); });
      }
    });
}

template <bool Penalised, class Pack, class Places>
void BlockSmoother::SmoothBlocks(
  const BlockPattern& pattern, const Places& places, const Streams& of, const Streams& ahead)
{
  constexpr int lanes = LanesOf<Pack>;
  const int unknowns = pattern.Unknowns();
  const int rows = pattern.Rows();
  float* const Bx = this->Bx.data();
  float* const step = this->Step.data();

  Prefetch(ahead.Places, places.Size());
  Pack products[BlockGroups::MostRows];
  for (int k = 0; k < rows; ++k)
  {
    products[k] = places.RowOf(Bx, k);
  }
  Pack residuals[BlockGroups::LargestBlock];
  for (int i = 0; i < unknowns; ++i)
  {
    Pack residual = places.UnknownOf(this->Right.data(), i);
    if (Penalised)
    {
      residual -= places.UnknownOf(this->Diagonal.data(), i) * places.UnknownOf(step, i);
    }
    const int begin = pattern.Offsets[i];
    const int end = pattern.Offsets[i + 1];
    Prefetch(ahead.Values + begin * lanes, (end - begin) * lanes);
    for (int e = begin; e < end; ++e)
    {
      residual -= LoadPack<Pack>(of.Values + e * lanes) * products[pattern.RowOf[e]];
    }
    residuals[i] = residual;
  }
  Pack steps[BlockGroups::LargestBlock];
  MultiplySymmetric(of.Inverse, unknowns, residuals, steps, ahead.Inverse);
  for (int i = 0; i < unknowns; ++i)
  {
    if (!Penalised) // over-relaxation would overshoot a strong penalty
    {
      steps[i] *= this->Relaxation;
    }
    places.SetUnknown(places.UnknownOf(step, i) + steps[i], step, i);
  }
  for (int k = 0; k < rows; ++k)
  {
    Pack product = products[k];
    for (int s = pattern.RowOffsets[k]; s < pattern.RowOffsets[k + 1]; ++s)
    {
      product += LoadPack<Pack>(of.Values + pattern.EntryAt[s] * lanes) * steps[pattern.UnknownAt[s]];
    }
    places.SetRow(product, Bx, k);
  }
}

template <bool Penalised>
void BlockSmoother::SmoothGroup(const SchwarzBlocks::Group& group, const Streams& of, const Streams& ahead)
{
  const BlockPattern& pattern = this->Blocks.PatternOf(group);
  if (group.Lanes == 1)
  {
    this->SmoothBlocks<Penalised, float>(pattern, PlacesAnywhere<float>(pattern, of.Places), of, ahead);
  }
  else if (group.FirstPlace < 0)
  {
    this->SmoothBlocks<Penalised, FloatPack>(pattern, PlacesAnywhere<FloatPack>(pattern, of.Places), of, ahead);
  }
  else
  {
    this->SmoothBlocks<Penalised, FloatPack>(pattern, PlacesInOrder(pattern, of.Places, group.FirstPlace), of, ahead);
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
    // The inverse is that of the stiffness matrix where D is zero.
    of.Inverse == this->Blocks.Inverse(group) ? this->SmoothGroup<false>(group, of, later)
                                              : this->SmoothGroup<true>(group, of, later);
  }
}

void BlockSmoother::RunSweeps(bool descending, const ExecutionContext& context)
{
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    ForColours(this->Blocks.ColoursOfTiles(), descending, context,
      [this, descending](int t) { this->SmoothTile(this->Blocks.TileAt(t), descending); });
  }
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
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        x[i] = this->Step[places[i]];
        r[i] = b[i];
      }
      this->ForPenalised(first, last, [&x, &r](int i, double penalty) { r[i] -= penalty * x[i]; });
    });
  const int* const placesOfRows = this->Blocks.PlacesOfRows().data();
  this->Tiles.ForTiles(context,
    [&](int, int firstRow, int lastRow)
    {
      this->B.AddAdjoint(
        firstRow, lastRow, [&](int row) { return -static_cast<double>(this->Bx[placesOfRows[row]]); }, r.data());
    });
  for (const int i : this->Held)
  {
    r[i] = 0.0;
  }
}

void BlockSmoother::PostSmooth(const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  const int* const placesOfRows = this->Blocks.PlacesOfRows().data();
  context.ParallelFor(0, static_cast<int>(this->Bx.size()), RowGrain,
    [&](int first, int last)
    {
      this->B.Multiply(first, last, x.data(),
        [this, placesOfRows](int row, double product) { this->Bx[placesOfRows[row]] = static_cast<float>(product); });
    });
  this->Begin(b, context, &x);
  this->RunSweeps(true, context);
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        x[i] += this->Step[this->Blocks.PlacesOfUnknowns()[i]];
      }
    });
}

long long BlockSmoother::Bytes() const
{
  return static_cast<long long>(this->Inverses.size() * sizeof(this->Inverses[0]) +
    this->ChangedInverses.size() * sizeof(float) + (this->Held.size() + this->Penalised.size()) * sizeof(int) +
    (this->Diagonal.size() + this->Right.size() + this->Step.size() + this->Bx.size()) * sizeof(float));
}

}
