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
}

void BlockSmoother::SmoothBlock(int block, const Vector<double>& b, Vector<double>& x)
{
  const UnknownBlocks& blocks = this->Blocks.Blocks();
  const int* const unknowns = blocks.Unknowns.data() + blocks.Offsets[block];
  const int size = blocks.Offsets[block + 1] - blocks.Offsets[block];
  double residuals[SchwarzBlocks::LargestBlock];
  double steps[SchwarzBlocks::LargestBlock];
  double* const product = this->Bx.data();
  for (int i = 0; i < size; ++i)
  {
    const int unknown = unknowns[i];
    residuals[i] =
      b[unknown] - this->Diagonal[unknown] * x[unknown] - RowTimes(this->Bt, unknown, product);
    steps[i] = 0.0;
  }
  const float* row = this->Inverses[block];
  for (int i = 0; i < size; row += ++i)
  {
    double step = row[i] * residuals[i];
    for (int j = 0; j < i; ++j)
    {
      step += row[j] * residuals[j];
      steps[j] += row[j] * residuals[i];
    }
    steps[i] += step;
  }
  for (int i = 0; i < size; ++i)
  {
    const int unknown = unknowns[i];
    x[unknown] += steps[i];
    const int end = this->Bt.outerIndexPtr()[unknown + 1];
    for (int e = this->Bt.outerIndexPtr()[unknown]; e < end; ++e)
    {
      product[this->Bt.innerIndexPtr()[e]] += this->Bt.valuePtr()[e] * steps[i];
    }
  }
}

void BlockSmoother::PreSmooth(
  const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context)
{
  x.setZero(b.size());
  this->Bx.setZero();
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    for (int colour = 0; colour < this->Blocks.NumberOfColours(); ++colour)
    {
      this->Blocks.ForTiles(colour, context, [&](int first, int last) {
        for (int block = first; block < last; ++block)
        {
          this->SmoothBlock(block, b, x);
        }
      });
    }
  }
  r.resize(b.size());
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      r[i] = b[i] - this->Diagonal[i] * x[i] - RowTimes(this->Bt, i, this->Bx.data());
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
  Multiply(this->B, x, this->Bx, context);
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    for (int colour = this->Blocks.NumberOfColours(); colour-- > 0;)
    {
      this->Blocks.ForTiles(colour, context, [&](int first, int last) {
        for (int block = last; block-- > first;)
        {
          this->SmoothBlock(block, b, x);
        }
      });
    }
  }
}

long long BlockSmoother::Bytes() const
{
  return static_cast<long long>(this->Inverses.size() * sizeof(this->Inverses[0]) +
    this->ChangedInverses.size() * sizeof(float) + this->Held.size() * sizeof(int) +
    (this->Diagonal.size() + this->Bx.size()) * sizeof(double));
}

}
