#include "Solvers/BlockSmoother.h"

#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;
constexpr int BlockGrain = 1024;
constexpr int NumberOfColours = 63;
constexpr int LargestBlock = 16;
// Keeps a block of dependent unknowns, as of a face without area, invertible in single precision.
constexpr double Ridge = 1e-6;

/// Colours of blocks, such that those of one colour share no row of B; greedy. Blocks around a vertex
/// of more than 63 faces may find none: they get the colour 63.
std::vector<int> Colours(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks)
{
  std::vector<std::uint64_t> taken(Bt.cols(), 0); // by row of B: colours of the blocks that touch it
  std::vector<int> colours(blocks.Size());
  for (int k = 0; k < blocks.Size(); ++k)
  {
    const auto forRows = [&](auto visit) {
      for (int s = blocks.Offsets[k]; s < blocks.Offsets[k + 1]; ++s)
      {
        const int unknown = blocks.Unknowns[s];
        for (int e = Bt.outerIndexPtr()[unknown]; e < Bt.outerIndexPtr()[unknown + 1]; ++e)
        {
          visit(taken[Bt.innerIndexPtr()[e]]);
        }
      }
    };
    std::uint64_t forbidden = 0;
    forRows([&forbidden](std::uint64_t set) { forbidden |= set; });
    int colour = 0;
    while (colour < NumberOfColours && (forbidden >> colour & 1) != 0)
    {
      ++colour;
    }
    colours[k] = colour;
    if (colour < NumberOfColours)
    {
      forRows([colour](std::uint64_t& set) { set |= std::uint64_t(1) << colour; });
    }
  }
  return colours;
}

}

template <class Value>
BlockSmoother<Value>::BlockSmoother(const SparseMatrix<double>& matrix, const UnknownBlocks& blocks,
  int sweeps, const ExecutionContext& context)
  : Sweeps(sweeps)
  , B(matrix.cast<Value>())
  , Bx(matrix.rows())
{
  assert(sweeps >= 1);
  const SparseMatrix<double> transpose = Adjoint(matrix, context);
  this->Bt = transpose.cast<Value>();

  const std::vector<int> colours = Colours(transpose, blocks);
  std::vector<int> begins(NumberOfColours + 2, 0);
  for (const int colour : colours)
  {
    ++begins[colour + 1];
  }
  OffsetsFromCounts(begins);
  std::vector<int> next = begins;
  std::vector<int> order(colours.size());
  for (std::size_t k = 0; k < colours.size(); ++k)
  {
    order[next[colours[k]]++] = static_cast<int>(k);
  }
  this->LastColourIsMixed = begins[NumberOfColours] < begins[NumberOfColours + 1];
  begins.erase(std::unique(begins.begin(), begins.end()), begins.end());
  this->ColourBegins = std::move(begins);
  this->Arrange(transpose, blocks, order, context);
}

template <class Value>
void BlockSmoother<Value>::Arrange(const SparseMatrix<double>& transpose,
  const UnknownBlocks& blocks, const std::vector<int>& order, const ExecutionContext& context)
{
  const int* const offsets = transpose.outerIndexPtr();
  this->BlockSlots = { 0 };
  this->SlotEntries = { 0 };
  this->BlockInverses = { 0 };
  this->SlotUnknowns.reserve(blocks.Unknowns.size());
  for (const int k : order)
  {
    const int size = blocks.Offsets[k + 1] - blocks.Offsets[k];
    if (size > LargestBlock)
    {
      throw InvalidInput("block " + std::to_string(k) + " holds " + std::to_string(size) +
        " unknowns; split it into blocks of at most " + std::to_string(LargestBlock));
    }
    for (int s = blocks.Offsets[k]; s < blocks.Offsets[k + 1]; ++s)
    {
      const int unknown = blocks.Unknowns[s];
      this->SlotUnknowns.push_back(unknown);
      this->SlotEntries.push_back(
        this->SlotEntries.back() + offsets[unknown + 1] - offsets[unknown]);
    }
    this->BlockSlots.push_back(static_cast<int>(this->SlotUnknowns.size()));
    this->BlockInverses.push_back(this->BlockInverses.back() + size * size);
  }
  this->EntryRows.resize(this->SlotEntries.back());
  this->EntryValues.resize(this->SlotEntries.back());
  this->Inverses.resize(this->BlockInverses.back());
  using Dense =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, LargestBlock, LargestBlock>;
  const auto arrangeBlock = [&](int block) {
    const int first = this->BlockSlots[block];
    const int size = this->BlockSlots[block + 1] - first;
    Dense matrix = Dense::Identity(size, size) * Ridge;
    for (int i = 0; i < size; ++i)
    {
      const int row = this->SlotUnknowns[first + i];
      int entry = this->SlotEntries[first + i];
      for (int e = offsets[row]; e < offsets[row + 1]; ++e, ++entry)
      {
        this->EntryRows[entry] = transpose.innerIndexPtr()[e];
        this->EntryValues[entry] = static_cast<Value>(transpose.valuePtr()[e]);
      }
      for (int j = 0; j < size; ++j)
      {
        // Two columns of B, rows ascending.
        const int column = this->SlotUnknowns[first + j];
        int f = offsets[column];
        for (int e = offsets[row]; e < offsets[row + 1]; ++e)
        {
          const int wanted = transpose.innerIndexPtr()[e];
          while (f < offsets[column + 1] && transpose.innerIndexPtr()[f] < wanted)
          {
            ++f;
          }
          if (f < offsets[column + 1] && transpose.innerIndexPtr()[f] == wanted)
          {
            matrix(i, j) += transpose.valuePtr()[e] * transpose.valuePtr()[f];
          }
        }
      }
    }
    const Dense inverse = matrix.llt().solve(Dense::Identity(size, size));
    Eigen::Map<Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic>>(
      this->Inverses.data() + this->BlockInverses[block], size, size) =
      inverse.template cast<Value>();
  };
  context.ParallelFor(0, static_cast<int>(order.size()), BlockGrain, [&](int first, int last) {
    for (int block = first; block < last; ++block)
    {
      arrangeBlock(block);
    }
  });
}

template <class Value>
void BlockSmoother<Value>::SmoothBlocks(
  int firstBlock, int lastBlock, const Vector<Value>& b, Vector<Value>& x)
{
  Value residuals[LargestBlock];
  Value* const Bx = this->Bx.data();
  const int* const rows = this->EntryRows.data();
  const Value* const values = this->EntryValues.data();
  for (int block = firstBlock; block < lastBlock; ++block)
  {
    const int first = this->BlockSlots[block];
    const int size = this->BlockSlots[block + 1] - first;
    const int* const entries = this->SlotEntries.data() + first;
    for (int i = 0; i < size; ++i)
    {
      Value residual = b[this->SlotUnknowns[first + i]];
      for (int e = entries[i]; e < entries[i + 1]; ++e)
      {
        residual -= values[e] * Bx[rows[e]];
      }
      residuals[i] = residual;
    }
    const Value* column = this->Inverses.data() + this->BlockInverses[block];
    for (int i = 0; i < size; ++i)
    {
      Value step(0);
      for (int j = 0; j < size; ++j)
      {
        step += *column++ * residuals[j]; // symmetric: columns are rows
      }
      x[this->SlotUnknowns[first + i]] += step;
      for (int e = entries[i]; e < entries[i + 1]; ++e)
      {
        Bx[rows[e]] += values[e] * step;
      }
    }
  }
}

template <class Value>
void BlockSmoother<Value>::SmoothColour(
  std::size_t colour, bool descending, const Vector<Value>& b, Vector<Value>& x,
  const ExecutionContext& context)
{
  const int first = this->ColourBegins[colour];
  const int last = this->ColourBegins[colour + 1];
  if (this->LastColourIsMixed && colour + 2 == this->ColourBegins.size())
  {
    for (int k = first; k < last; ++k)
    {
      const int block = descending ? first + last - 1 - k : k;
      this->SmoothBlocks(block, block + 1, b, x);
    }
    return;
  }
  context.ParallelFor(first, last, BlockGrain,
    [this, &b, &x](int begin, int end) { this->SmoothBlocks(begin, end, b, x); });
}

template <class Value>
void BlockSmoother<Value>::PreSmooth(
  const Vector<Value>& b, Vector<Value>& x, Vector<Value>& r, const ExecutionContext& context)
{
  x.setZero();
  this->Bx.setZero();
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    for (std::size_t colour = 0; colour + 1 < this->ColourBegins.size(); ++colour)
    {
      this->SmoothColour(colour, false, b, x, context);
    }
  }
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      r[i] = b[i] - RowTimes(this->Bt, i, this->Bx.data());
    }
  });
}

template <class Value>
void BlockSmoother<Value>::PostSmooth(
  const Vector<Value>& b, Vector<Value>& x, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(this->Bx.size()), RowGrain, [&](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      this->Bx[i] = RowTimes(this->B, i, x.data());
    }
  });
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    for (std::size_t colour = this->ColourBegins.size() - 1; colour-- > 0;)
    {
      this->SmoothColour(colour, true, b, x, context);
    }
  }
}

template <class Value>
long long BlockSmoother<Value>::Bytes() const
{
  const auto bytes = [](const auto& vector) {
    return static_cast<long long>(vector.size() * sizeof(vector[0]));
  };
  return bytes(this->BlockSlots) + bytes(this->SlotUnknowns) + bytes(this->SlotEntries) +
    bytes(this->EntryRows) + bytes(this->EntryValues) + bytes(this->BlockInverses) +
    bytes(this->Inverses) +
    (this->B.nonZeros() + this->Bt.nonZeros()) * static_cast<long long>(sizeof(Value) + 4);
}

template class BlockSmoother<float>;
template class BlockSmoother<double>;

}
