#include "Solvers/BlockSmoother.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;
// So many blocks before it is their turn, the columns of their unknowns are asked for.
constexpr int Ahead = 8;

inline void Prefetch([[maybe_unused]] const void* address)
{
#if defined(__GNUC__)
  __builtin_prefetch(address);
#endif
}

}

BlockSmoother::BlockSmoother(const SparseMatrix<double>& factor,
  const SparseMatrix<double>& transpose, const SchwarzBlocks& blocks, int sweeps)
  : B(factor)
  , Bt(transpose)
  , Blocks(blocks)
  , Sweeps(sweeps)
  , Diagonal(Vector<double>::Zero(factor.cols()))
  , IsPulled(blocks.NumberOfTiles(), 0)
  , Inverses(blocks.Blocks().Size())
  , Right(factor.cols())
  , Step(factor.cols())
  , Bx(factor.rows())
{
  assert(sweeps >= 1);
  for (int k = 0; k < blocks.Blocks().Size(); ++k)
  {
    this->Inverses[k] = blocks.Inverse(k);
  }
}

void BlockSmoother::SetDiagonal(const Vector<double>& D, const ExecutionContext& context)
{
  assert(D.size() == this->B.cols());
  this->Held.clear();
  for (Eigen::Index i = 0; i < D.size(); ++i)
  {
    this->Diagonal[i] = std::isfinite(D[i]) ? D[i] : 0.0;
    if (!std::isfinite(D[i]))
    {
      this->Held.push_back(static_cast<int>(i));
    }
  }
  const UnknownBlocks& blocks = this->Blocks.Blocks();
  std::vector<int> changed;
  std::size_t size = 0;
  for (int k = 0; k < blocks.Size(); ++k)
  {
    const bool isChanged = std::any_of(blocks.Unknowns.begin() + blocks.Offsets[k],
      blocks.Unknowns.begin() + blocks.Offsets[k + 1],
      [&D](int unknown) { return D[unknown] != 0.0; });
    if (isChanged)
    {
      changed.push_back(k);
      size += this->Blocks.InverseSize(k);
    }
    this->Inverses[k] = this->Blocks.Inverse(k);
  }
  this->ChangedInverses.resize(size);
  std::vector<float*> places;
  places.reserve(changed.size());
  float* next = this->ChangedInverses.data();
  for (const int k : changed)
  {
    places.push_back(next);
    this->Inverses[k] = next;
    next += this->Blocks.InverseSize(k);
  }
  this->Blocks.Invert(this->Bt, D, changed, places, context);
  for (int t = 0; t < this->Blocks.NumberOfTiles(); ++t)
  {
    const SchwarzBlocks::Tile tile = this->Blocks.TileAt(t);
    this->IsPulled[t] = std::any_of(blocks.Unknowns.begin() + blocks.Offsets[tile.First],
      blocks.Unknowns.begin() + blocks.Offsets[tile.Last],
      [this](int unknown) { return this->Diagonal[unknown] != 0.0; });
  }
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

template <int Width, bool Pulled>
void BlockSmoother::SmoothTile(const SchwarzBlocks::Tile& tile, bool descending)
{
  const UnknownBlocks& blocks = this->Blocks.Blocks();
  const int width = Width > 0 ? Width : this->Blocks.EntriesPerUnknown();
  const SchwarzBlocks::Entry* const entries = this->Blocks.Entries();
  const float* const right = this->Right.data();
  float* const total = this->Step.data();
  float* const product = this->Bx.data();
  float residuals[SchwarzBlocks::LargestBlock];
  float steps[SchwarzBlocks::LargestBlock];
  const auto smoothBlock = [&](auto sizeOfBlock, const int* unknowns, const float* inverse) {
    const int size = sizeOfBlock;
    for (int i = 0; i < size; ++i)
    {
      const int unknown = unknowns[i];
      const SchwarzBlocks::Entry* const column = entries + static_cast<std::size_t>(unknown) * width;
      float residual = right[unknown];
      if (Pulled)
      {
        residual -= static_cast<float>(this->Diagonal[unknown]) * total[unknown];
      }
      for (int e = 0; e < width; ++e)
      {
        residual -= column[e].Value * product[column[e].Row];
      }
      residuals[i] = residual;
      steps[i] = 0.0f;
    }
    for (int i = 0; i < size; inverse += ++i)
    {
      float step = inverse[i] * residuals[i];
      for (int j = 0; j < i; ++j)
      {
        step += inverse[j] * residuals[j];
        steps[j] += inverse[j] * residuals[i];
      }
      steps[i] += step;
    }
    for (int i = 0; i < size; ++i)
    {
      const int unknown = unknowns[i];
      const SchwarzBlocks::Entry* const column = entries + static_cast<std::size_t>(unknown) * width;
      total[unknown] += steps[i];
      for (int e = 0; e < width; ++e)
      {
        product[column[e].Row] += column[e].Value * steps[i];
      }
    }
  };
  for (int k = 0; k < tile.Last - tile.First; ++k)
  {
    const int block = descending ? tile.Last - 1 - k : tile.First + k;
    const int* const unknowns = blocks.Unknowns.data() + blocks.Offsets[block];
    const int size = blocks.Offsets[block + 1] - blocks.Offsets[block];
    const int later =
      descending ? std::max(block - Ahead, tile.First) : std::min(block + Ahead, tile.Last - 1);
    for (int s = blocks.Offsets[later]; s < blocks.Offsets[later + 1]; ++s)
    {
      Prefetch(entries + static_cast<std::size_t>(blocks.Unknowns[s]) * width);
    }
    if (size == 3) // the sides of a face
    {
      smoothBlock(std::integral_constant<int, 3>(), unknowns, this->Inverses[block]);
    }
    else
    {
      smoothBlock(size, unknowns, this->Inverses[block]);
    }
  }
}

void BlockSmoother::Sweep(bool descending, const ExecutionContext& context)
{
  const int colours = this->Blocks.NumberOfColours();
  for (int c = 0; c < colours; ++c)
  {
    this->Blocks.ForTiles(descending ? colours - 1 - c : c, context, [&](int t) {
      const SchwarzBlocks::Tile tile = this->Blocks.TileAt(t);
      const auto smooth = [&](auto width) {
        this->IsPulled[t] ? this->SmoothTile<width(), true>(tile, descending)
                          : this->SmoothTile<width(), false>(tile, descending);
      };
      switch (this->Blocks.EntriesPerUnknown())
      {
        case 4: // 1-forms
          return smooth(std::integral_constant<int, 4>());
        case 6: // face fields
          return smooth(std::integral_constant<int, 6>());
        default:
          return smooth(std::integral_constant<int, 0>());
      }
    });
  }
}

void BlockSmoother::PreSmooth(
  const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context)
{
  this->Begin(b, context);
  this->Bx.setZero();
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    this->Sweep(false, context);
  }
  x.resize(b.size());
  r.resize(b.size());
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      x[i] = this->Step[i];
      double residual = b[i] - this->Diagonal[i] * x[i];
      for (int e = this->Bt.outerIndexPtr()[i]; e < this->Bt.outerIndexPtr()[i + 1]; ++e)
      {
        residual -= this->Bt.valuePtr()[e] * this->Bx[this->Bt.innerIndexPtr()[e]];
      }
      r[i] = residual;
    }
  });
  for (const int i : this->Held)
  {
    r[i] = 0.0;
  }
}

void BlockSmoother::PostSmooth(
  const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(this->Bx.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      this->Bx[i] = static_cast<float>(RowTimes(this->B, i, x.data()));
    }
  });
  this->Begin(b, context, &x);
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    this->Sweep(true, context);
  }
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    const int count = last - first;
    x.segment(first, count) += this->Step.segment(first, count).cast<double>();
  });
}

long long BlockSmoother::Bytes() const
{
  return static_cast<long long>(this->Inverses.size() * sizeof(this->Inverses[0]) +
    this->ChangedInverses.size() * sizeof(float) + this->Held.size() * sizeof(int) +
    this->IsPulled.size() +
    (this->Right.size() + this->Step.size() + this->Bx.size()) * sizeof(float) +
    this->Diagonal.size() * sizeof(double));
}

}
