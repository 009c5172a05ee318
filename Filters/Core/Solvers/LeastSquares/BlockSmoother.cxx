#include "Solvers/LeastSquares/BlockSmoother.h"

#include "Solvers/Kernels/Packs.h"
#include "Support/CountingSort.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

constexpr int RowGrain = 8192;
constexpr int BlockGrain = 256;
constexpr int MostRows = 1 << 16; // of B that a tile touches
constexpr int LastColour = 63;    // of the blocks of a tile; for those that find no other

// Keeps a block of dependent unknowns, such as those of a face without area, invertible in single precision.
constexpr double Ridge = 1e-6;

using BlockMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, UnknownBlocks::LargestBlock,
  UnknownBlocks::LargestBlock>;

/// y = A x for a symmetric matrix, of which the lower triangle is given by rows.
void MultiplySymmetric(const float* triangle, int size, const float* x, float* y)
{
  constexpr int lanes = LanesOf<FloatPack>;
  for (int i = 0; i < size; ++i, ++triangle)
  {
    FloatPack sums{};
    const FloatPack factors = { x[i], x[i], x[i], x[i] };
    int j = 0;
    for (; j + lanes <= i; j += lanes, triangle += lanes)
    {
      const auto entries = LoadPack<FloatPack>(triangle);
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

/// Calls visit(row) for the rows of B that some blocks touch, once for each time.
template <class Visit>
void ForRows(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, int firstBlock, int lastBlock, const Visit& visit)
{
  for (int s = blocks.Offsets[firstBlock]; s < blocks.Offsets[lastBlock]; ++s)
  {
    const int* const offsets = Bt.outerIndexPtr() + blocks.Unknowns[s];
    std::for_each(Bt.innerIndexPtr() + offsets[0], Bt.innerIndexPtr() + offsets[1], visit);
  }
}

/// Tiles of consecutive blocks: tile t has the blocks [begins[t], begins[t + 1]). The rows that a tile touches fit the caches of a core,
/// and RowsOfEntries can number them. Many threads have some tiles of a colour each.
std::vector<int> BeginsOfTiles(const SparseMatrix<double>& Bt, const UnknownBlocks& blocks)
{
  const int mostBlocks = std::clamp(blocks.Size() / 64, 128, 1024);
  std::vector<int> begins;
  std::vector<int> lastTiles(Bt.cols(), -1); // that touch each row of B
  const auto countNewRows = [&](int block)
  {
    int count = 0;
    const int tile = static_cast<int>(begins.size());
    ForRows(
      Bt, blocks, block, block + 1, [&](int row) { count += std::exchange(lastTiles[row], tile) == tile ? 0 : 1; });
    return count;
  };
  int rows = 0;
  for (int k = 0; k < blocks.Size(); ++k)
  {
    rows += countNewRows(k);
    if (begins.empty() || k - begins.back() == mostBlocks || rows > MostRows)
    {
      begins.push_back(k);
      rows = countNewRows(k);
    }
  }
  begins.push_back(blocks.Size());
  return begins;
}

}

UnknownBlocks OrderedByColours(
  const SparseMatrix<double>& Bt, const UnknownBlocks& blocks, const ExecutionContext& context)
{
  const std::vector<int> begins = BeginsOfTiles(Bt, blocks);
  const int numberOfTiles = static_cast<int>(begins.size()) - 1;
  std::vector<int> order = Identity(blocks.Size());
  std::vector<char> colours(blocks.Size());
  const int grain = std::max(1, numberOfTiles / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, numberOfTiles, grain,
    [&](int firstTile, int lastTile)
    {
      std::vector<std::uint64_t> taken(Bt.cols(), 0); // by row of B: colours of the blocks that touch it
      for (int tile = firstTile; tile < lastTile; ++tile)
      {
        const int first = begins[tile];
        const int last = begins[tile + 1];
        for (int k = first; k < last; ++k)
        {
          std::uint64_t forbidden = 0;
          ForRows(Bt, blocks, k, k + 1, [&](int row) { forbidden |= taken[row]; });
          while (colours[k] < LastColour && (forbidden >> colours[k] & 1) != 0)
          {
            ++colours[k];
          }
          ForRows(Bt, blocks, k, k + 1, [&](int row) { taken[row] |= std::uint64_t(1) << colours[k]; });
        }
        ForRows(Bt, blocks, first, last, [&](int row) { taken[row] = 0; });
        std::stable_sort(
          order.begin() + first, order.begin() + last, [&colours](int k, int l) { return colours[k] < colours[l]; });
      }
    });
  return blocks.InOrder(order);
}

BlockSmoother::BlockSmoother(const SparseMatrix<double>& factor, const RowTiles& tiles, const UnknownBlocks& blocks,
  const Vector<double>& D, int sweeps, const ExecutionContext& context, double relaxation)
  : B(factor)
  , Tiles(tiles)
  , Blocks(blocks)
  , Sweeps(sweeps)
  , Relaxation(relaxation)
  , RowBegins({ 0 })
  , EntryBegins({ 0 })
  , InverseBegins(blocks.Size() + 1, 0)
  , AreTouched(blocks.Size(), 1) // so that all are inverted
  , Right(factor.cols())
  , Step(factor.cols())
  , Bx(factor.rows())
{
  assert(relaxation > 0.0 && relaxation < 2.0);
  const SparseMatrix<double> Bt = Adjoint(factor, context);
  this->BlockBegins = BeginsOfTiles(Bt, blocks);
  this->TileColours = ColourParts(this->NumberOfTiles(), static_cast<int>(Bt.cols()),
    [&](int tile, const auto& visit)
    { ForRows(Bt, blocks, this->BlockBegins[tile], this->BlockBegins[tile + 1], visit); });
  this->CollectEntries(Bt);
  for (int k = 0; k < blocks.Size(); ++k)
  {
    const std::size_t size = blocks.SizeOf(k);
    assert(size <= UnknownBlocks::LargestBlock);
    this->InverseBegins[k + 1] = this->InverseBegins[k] + size * (size + 1) / 2;
  }
  this->Inverses.resize(this->InverseBegins.back());
  this->SetDiagonal(D, context);
}

void BlockSmoother::CollectEntries(const SparseMatrix<double>& Bt)
{
  std::vector<int> places(Bt.cols(), -1); // of rows of B in the tile
  for (int tile = 0; tile < this->NumberOfTiles(); ++tile)
  {
    const int begin = this->RowBegins.back();
    const int end = this->Blocks.Offsets[this->BlockBegins[tile + 1]];
    for (int s = this->Blocks.Offsets[this->BlockBegins[tile]]; s < end; ++s)
    {
      for (SparseMatrix<double>::InnerIterator entry(Bt, this->Blocks.Unknowns[s]); entry; ++entry)
      {
        int& place = places[entry.col()];
        if (place < 0)
        {
          place = static_cast<int>(this->Rows.size()) - begin;
          this->Rows.push_back(static_cast<int>(entry.col()));
        }
        this->RowsOfEntries.push_back(static_cast<std::uint16_t>(place));
        this->Entries.push_back(static_cast<float>(entry.value()));
      }
      this->EntryBegins.push_back(static_cast<int>(this->Entries.size()));
    }
    this->RowBegins.push_back(static_cast<int>(this->Rows.size()));
    std::for_each(this->Rows.begin() + begin, this->Rows.end(), [&places](int row) { places[row] = -1; });
  }
}

bool BlockSmoother::Touches(const Vector<double>& D, int block) const
{
  const int* const unknowns = this->UnknownsOf(block);
  return std::any_of(unknowns, unknowns + this->Blocks.SizeOf(block), [&D](int unknown) { return D[unknown] != 0.0; });
}

void BlockSmoother::SetDiagonal(const Vector<double>& D, const ExecutionContext& context)
{
  assert(D.size() == this->Right.size());
  this->Held = Choose(
    static_cast<int>(D.size()), [&D](int i) { return !std::isfinite(D[i]); }, context);
  this->Diagonal = D.array().isFinite().select(D, 0.0).cast<float>();
  const std::vector<int> changed = Choose(
    this->Blocks.Size(), [&](int k) { return this->AreTouched[k] || this->Touches(D, k); }, context);
  context.ParallelFor(0, static_cast<int>(changed.size()), BlockGrain,
    [&](int first, int last)
    {
      Vector<double> room = Vector<double>::Zero(MostRows);
      for (int c = first; c < last; ++c)
      {
        const int k = changed[c];
        this->AreTouched[k] = this->Touches(D, k);
        this->Invert(k, D, this->AreTouched[k] ? 1.0 : this->Relaxation, room);
      }
    });
}

void BlockSmoother::Invert(int block, const Vector<double>& D, double factor, Vector<double>& room)
{
  const int* const unknowns = this->UnknownsOf(block);
  const int size = this->Blocks.SizeOf(block);
  const int* const begins = this->EntryBegins.data() + this->Blocks.Offsets[block];
  // The block of A, scaled to ones on the diagonal.
  BlockMatrix A(size, size);
  double scales[UnknownBlocks::LargestBlock];
  Vector<double>& column = room;
  for (int i = 0; i < size; ++i)
  {
    const auto forEntries = [&](int j, const auto& visit)
    {
      for (int e = begins[j]; e < begins[j + 1]; ++e)
      {
        visit(this->RowsOfEntries[e], static_cast<double>(this->Entries[e]));
      }
    };
    forEntries(i, [&column](int row, double value) { column[row] = value; });
    for (int j = 0; j <= i; ++j)
    {
      A(i, j) = 0.0;
      forEntries(j, [&](int row, double value) { A(i, j) += value * column[row]; });
    }
    forEntries(i, [&column](int row, double) { column[row] = 0.0; });
    const double diagonal = A(i, i) + D[unknowns[i]];
    scales[i] = diagonal > 0.0 ? 1.0 / std::sqrt(diagonal) : 0.0; // zero where there is nothing to solve for
    for (int j = 0; j < i; ++j)
    {
      A(i, j) *= scales[i] * scales[j];
    }
    A(i, i) = 1.0 + Ridge;
  }
  const BlockMatrix inverted = A.selfadjointView<Eigen::Lower>().llt().solve(BlockMatrix::Identity(size, size));
  float* inverse = this->Inverses.data() + this->InverseBegins[block];
  for (int i = 0; i < size; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      *inverse++ = static_cast<float>(factor * scales[i] * inverted(i, j) * scales[j]);
    }
  }
}

void BlockSmoother::SmoothBlock(int block, float* products)
{
  const int* const unknowns = this->UnknownsOf(block);
  const int size = this->Blocks.SizeOf(block);
  const int* const begins = this->EntryBegins.data() + this->Blocks.Offsets[block];
  const bool isTouched = this->AreTouched[block];
  float residuals[UnknownBlocks::LargestBlock];
  for (int i = 0; i < size; ++i)
  {
    float residual = this->Right[unknowns[i]];
    if (isTouched)
    {
      residual -= this->Diagonal[unknowns[i]] * this->Step[unknowns[i]];
    }
    for (int e = begins[i]; e < begins[i + 1]; ++e)
    {
      residual -= this->Entries[e] * products[this->RowsOfEntries[e]];
    }
    residuals[i] = residual;
  }
  float steps[UnknownBlocks::LargestBlock];
  MultiplySymmetric(this->Inverses.data() + this->InverseBegins[block], size, residuals, steps);
  for (int i = 0; i < size; ++i)
  {
    this->Step[unknowns[i]] += steps[i];
    for (int e = begins[i]; e < begins[i + 1]; ++e)
    {
      products[this->RowsOfEntries[e]] += this->Entries[e] * steps[i];
    }
  }
}

/// Works on a copy of the rows of B x that its blocks touch.
void BlockSmoother::SmoothTile(int tile, bool descending)
{
  const int* const rows = this->Rows.data() + this->RowBegins[tile];
  const int numberOfRows = this->RowBegins[tile + 1] - this->RowBegins[tile];
  std::vector<float> products(numberOfRows);
  for (int k = 0; k < numberOfRows; ++k)
  {
    products[k] = this->Bx[rows[k]];
  }
  const int first = this->BlockBegins[tile];
  const int last = this->BlockBegins[tile + 1];
  for (int k = first; k < last; ++k)
  {
    this->SmoothBlock(descending ? first + last - 1 - k : k, products.data());
  }
  for (int k = 0; k < numberOfRows; ++k)
  {
    this->Bx[rows[k]] = products[k];
  }
}

void BlockSmoother::RunSweeps(bool descending, const ExecutionContext& context)
{
  this->Step.setZero();
  for (int sweep = 0; sweep < this->Sweeps; ++sweep)
  {
    ForColours(this->TileColours.Begins, descending, context,
      [this, descending](int t) { this->SmoothTile(this->TileColours.Parts[t], descending); });
  }
}

void BlockSmoother::PreSmooth(
  const Vector<double>& b, Vector<double>& x, Vector<double>& r, const ExecutionContext& context)
{
  this->Right = b.cast<float>();
  this->Bx.setZero();
  this->RunSweeps(false, context);
  x.resize(b.size());
  r.resize(b.size());
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        x[i] = this->Step[i];
        r[i] = b[i] - this->Diagonal[i] * x[i];
      }
    });
  this->Tiles.ForTiles(context,
    [&](int, int firstRow, int lastRow)
    {
      this->B.AddAdjoint(
        firstRow, lastRow, [this](int row) { return -static_cast<double>(this->Bx[row]); }, r.data());
    });
  SetZero(r, this->Held, context);
}

void BlockSmoother::PostSmooth(const Vector<double>& b, Vector<double>& x, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(this->Bx.size()), RowGrain,
    [&](int first, int last)
    {
      this->B.Multiply(
        first, last, x.data(), [this](int row, double product) { this->Bx[row] = static_cast<float>(product); });
    });
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        this->Right[i] = static_cast<float>(b[i] - this->Diagonal[i] * x[i]);
      }
    });
  this->RunSweeps(true, context);
  context.ParallelFor(0, static_cast<int>(x.size()), RowGrain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        x[i] += this->Step[i];
      }
    });
}

long long BlockSmoother::Bytes() const
{
  const auto bytes = [](const auto& vector) { return static_cast<long long>(vector.size() * sizeof(vector[0])); };
  return bytes(this->TileColours.Parts) + bytes(this->BlockBegins) + bytes(this->RowBegins) + bytes(this->Rows) +
    bytes(this->EntryBegins) + bytes(this->RowsOfEntries) + bytes(this->Entries) + bytes(this->InverseBegins) +
    bytes(this->Inverses) + bytes(this->AreTouched) + bytes(this->Held) + bytes(this->Diagonal) + bytes(this->Right) +
    bytes(this->Step) + bytes(this->Bx);
}

}
