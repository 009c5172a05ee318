#include "Solvers/BlockSmoother.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;

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
    this->IsPulled[t] = std::any_of(tile.Unknowns, tile.Unknowns + tile.NumberOfUnknowns,
      [this](int unknown) { return this->Diagonal[unknown] != 0.0; });
  }
}

template <bool Pulled>
void BlockSmoother::SmoothTile(const SchwarzBlocks::Tile& tile, bool descending,
  const Vector<double>& b, Vector<double>& x)
{
  // Copies of what the tile works on: B x of its rows, b - D x and the steps of its unknowns.
  thread_local std::vector<float> workspace;
  workspace.resize(tile.NumberOfRows + 2 * tile.NumberOfUnknowns);
  float* const product = workspace.data();
  float* const right = product + tile.NumberOfRows;
  float* const total = right + tile.NumberOfUnknowns;
  for (int r = 0; r < tile.NumberOfRows; ++r)
  {
    product[r] = this->Bx[tile.Rows[r]];
  }
  for (int u = 0; u < tile.NumberOfUnknowns; ++u)
  {
    const int unknown = tile.Unknowns[u];
    right[u] = static_cast<float>(
      Pulled ? b[unknown] - this->Diagonal[unknown] * x[unknown] : b[unknown]);
    total[u] = 0.0f;
  }

  const int* const offsets = this->Blocks.Blocks().Offsets.data();
  const int firstMember = offsets[tile.FirstBlock];
  const int numberOfBlocks = tile.LastBlock - tile.FirstBlock;
  float residuals[SchwarzBlocks::LargestBlock];
  float steps[SchwarzBlocks::LargestBlock];
  for (int k = 0; k < numberOfBlocks; ++k)
  {
    const int block = descending ? tile.LastBlock - 1 - k : tile.FirstBlock + k;
    const std::uint16_t* const members = tile.Members + (offsets[block] - firstMember);
    const int size = offsets[block + 1] - offsets[block];
    for (int i = 0; i < size; ++i)
    {
      const int u = members[i];
      float residual = right[u];
      const int end = tile.ColumnBegins[u + 1];
      for (int e = tile.ColumnBegins[u]; e < end; ++e)
      {
        residual -= tile.EntryValues[e] * product[tile.EntryRows[e]];
      }
      residuals[i] = residual;
      steps[i] = 0.0f;
    }
    const float* row = this->Inverses[block];
    for (int i = 0; i < size; row += ++i)
    {
      float step = row[i] * residuals[i];
      for (int j = 0; j < i; ++j)
      {
        step += row[j] * residuals[j];
        steps[j] += row[j] * residuals[i];
      }
      steps[i] += step;
    }
    for (int i = 0; i < size; ++i)
    {
      const int u = members[i];
      total[u] += steps[i];
      if (Pulled)
      {
        right[u] -= static_cast<float>(this->Diagonal[tile.Unknowns[u]]) * steps[i];
      }
      const int end = tile.ColumnBegins[u + 1];
      for (int e = tile.ColumnBegins[u]; e < end; ++e)
      {
        product[tile.EntryRows[e]] += tile.EntryValues[e] * steps[i];
      }
    }
  }

  for (int r = 0; r < tile.NumberOfRows; ++r)
  {
    this->Bx[tile.Rows[r]] = product[r];
  }
  for (int u = 0; u < tile.NumberOfUnknowns; ++u)
  {
    x[tile.Unknowns[u]] += total[u];
  }
}

void BlockSmoother::Sweep(bool descending, const Vector<double>& b, Vector<double>& x,
  const ExecutionContext& context)
{
  const int colours = this->Blocks.NumberOfColours();
  for (int c = 0; c < colours; ++c)
  {
    this->Blocks.ForTiles(descending ? colours - 1 - c : c, context, [&](int t) {
      const SchwarzBlocks::Tile tile = this->Blocks.TileAt(t);
      this->IsPulled[t] ? this->SmoothTile<true>(tile, descending, b, x)
                        : this->SmoothTile<false>(tile, descending, b, x);
    });
  }
}

void BlockSmoother::PreSmooth(
  const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context)
{
  x.setZero(b.size());
  this->Bx.setZero();
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    this->Sweep(false, b, x, context);
  }
  r.resize(b.size());
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
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
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    this->Sweep(true, b, x, context);
  }
}

long long BlockSmoother::Bytes() const
{
  return static_cast<long long>(this->Inverses.size() * sizeof(this->Inverses[0]) +
    this->ChangedInverses.size() * sizeof(float) + this->Held.size() * sizeof(int) +
    this->IsPulled.size() + this->Bx.size() * sizeof(float) +
    this->Diagonal.size() * sizeof(double));
}

}
