#include "Solvers/CompactProlongation.h"

#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dmg
{
namespace
{

constexpr int RowsOfTile = 2048;
constexpr int MostEntriesOfTile = 65535; // so that their columns have numbers of 16 bits
constexpr int ColumnGrain = 4096;
constexpr float LargestInteger = 32767.0f;

/// Ranges of rows.
std::vector<int> BeginsOfTiles(const SparseMatrix<Plane>& P)
{
  const int* const offsets = P.outerIndexPtr();
  std::vector<int> begins = { 0 };
  for (int row = 0; row < P.rows(); ++row)
  {
    assert(offsets[row + 1] - offsets[row] <= MostEntriesOfTile);
    if (row - begins.back() == RowsOfTile ||
      offsets[row + 1] - offsets[begins.back()] > MostEntriesOfTile)
    {
      begins.push_back(row);
    }
  }
  if (P.rows() > 0)
  {
    begins.push_back(static_cast<int>(P.rows()));
  }
  return begins;
}

/// Calls visit(k) for the entries of a tile whose column it has not had before.
template <class Visit>
void ForNewColumns(const SparseMatrix<Plane>& P, int firstRow, int lastRow,
  std::vector<int>& lastTileOf, int tile, const Visit& visit)
{
  for (int e = P.outerIndexPtr()[firstRow]; e < P.outerIndexPtr()[lastRow]; ++e)
  {
    const int column = P.innerIndexPtr()[e];
    if (lastTileOf[column] != tile)
    {
      lastTileOf[column] = tile;
      visit(column);
    }
  }
}

}

CompactProlongation::CompactProlongation(
  const SparseMatrix<Plane>& P, const ExecutionContext& context)
  : TileBegins(BeginsOfTiles(P))
  , ColumnBegins(this->TileBegins.size(), 0)
  , RowBegins(P.outerIndexPtr(), P.outerIndexPtr() + P.rows() + 1)
  , Units(P.rows())
  , Entries(P.nonZeros())
  , SlotBegins(P.cols() + 1, 0)
{
  std::vector<int> lastTileOf(P.cols(), -1);
  for (int tile = 0; tile < this->NumberOfTiles(); ++tile)
  {
    ForNewColumns(P, this->TileBegins[tile], this->TileBegins[tile + 1], lastTileOf, tile,
      [this](int column) { this->ColumnsOfTiles.push_back(column); });
    std::sort(this->ColumnsOfTiles.begin() + this->ColumnBegins[tile], this->ColumnsOfTiles.end());
    this->ColumnBegins[tile + 1] = static_cast<int>(this->ColumnsOfTiles.size());
  }
  for (const int column : this->ColumnsOfTiles)
  {
    ++this->SlotBegins[column + 1];
  }
  OffsetsFromCounts(this->SlotBegins);
  std::vector<int> next = this->SlotBegins;
  this->Slots.resize(this->ColumnsOfTiles.size());
  for (std::size_t slot = 0; slot < this->ColumnsOfTiles.size(); ++slot)
  {
    this->Slots[next[this->ColumnsOfTiles[slot]]++] = static_cast<int>(slot);
  }
  const int grain = std::max(1, this->NumberOfTiles() / (4 * context.NumberOfThreads()));
  context.ParallelFor(0, this->NumberOfTiles(), grain, [&](int first, int last) {
    std::vector<int> places(P.cols()); // of columns in a tile
    for (int tile = first; tile < last; ++tile)
    {
      this->FillTile(tile, P, places);
    }
  });
}

void CompactProlongation::FillTile(
  int tile, const SparseMatrix<Plane>& P, std::vector<int>& places)
{
  const int begin = this->ColumnBegins[tile];
  for (int slot = begin; slot < this->ColumnBegins[tile + 1]; ++slot)
  {
    places[this->ColumnsOfTiles[slot]] = slot - begin;
  }
  for (int row = this->TileBegins[tile]; row < this->TileBegins[tile + 1]; ++row)
  {
    float largest = 0.0f;
    for (int e = this->RowBegins[row]; e < this->RowBegins[row + 1]; ++e)
    {
      const Plane entry = P.valuePtr()[e];
      largest = std::max({ largest, std::abs(entry.real()), std::abs(entry.imag()) });
    }
    this->Units[row] = largest > 0.0f ? largest / LargestInteger : 1.0f;
    const auto inUnits = [unit = this->Units[row]](float component) {
      return static_cast<std::int16_t>(
        std::clamp(std::nearbyint(component / unit), -LargestInteger, LargestInteger));
    };
    for (int e = this->RowBegins[row]; e < this->RowBegins[row + 1]; ++e)
    {
      const Plane entry = P.valuePtr()[e];
      this->Entries[e] = { static_cast<std::uint16_t>(places[P.innerIndexPtr()[e]]),
        inUnits(entry.real()), inUnits(entry.imag()) };
    }
  }
}

void CompactProlongation::AddProduct(
  const Vector<double>& z, Vector<double>& x, const ExecutionContext& context) const
{
  assert(z.size() == 2 * this->Columns() && x.size() == this->Rows());
  context.ParallelFor(0, this->NumberOfTiles(), 1, [&](int firstTile, int lastTile) {
    std::vector<float> ofTile;
    for (int tile = firstTile; tile < lastTile; ++tile)
    {
      ofTile.clear();
      for (int slot = this->ColumnBegins[tile]; slot < this->ColumnBegins[tile + 1]; ++slot)
      {
        const int column = this->ColumnsOfTiles[slot];
        ofTile.push_back(static_cast<float>(z[2 * column]));
        ofTile.push_back(static_cast<float>(z[2 * column + 1]));
      }
      for (int row = this->TileBegins[tile]; row < this->TileBegins[tile + 1]; ++row)
      {
        float sum = 0.0f;
        for (int e = this->RowBegins[row]; e < this->RowBegins[row + 1]; ++e)
        {
          const Entry& entry = this->Entries[e];
          sum += entry.X * ofTile[2 * entry.Column] + entry.Y * ofTile[2 * entry.Column + 1];
        }
        x[row] += this->Units[row] * sum;
      }
    }
  });
}

void CompactProlongation::MultiplyAdjoint(const Vector<double>& x, Vector<double>& z,
  Vector<double>& sums, const ExecutionContext& context) const
{
  assert(x.size() == this->Rows());
  sums.resize(this->SizeOfSums());
  context.ParallelFor(0, this->NumberOfTiles(), 1, [&](int firstTile, int lastTile) {
    for (int tile = firstTile; tile < lastTile; ++tile)
    {
      double* const ofTile = sums.data() + 2 * this->ColumnBegins[tile];
      std::fill(ofTile, sums.data() + 2 * this->ColumnBegins[tile + 1], 0.0);
      for (int row = this->TileBegins[tile]; row < this->TileBegins[tile + 1]; ++row)
      {
        const double factor = x[row] * this->Units[row];
        for (int e = this->RowBegins[row]; e < this->RowBegins[row + 1]; ++e)
        {
          const Entry& entry = this->Entries[e];
          ofTile[2 * entry.Column] += factor * entry.X;
          ofTile[2 * entry.Column + 1] += factor * entry.Y;
        }
      }
    }
  });
  z.resize(2 * this->Columns());
  context.ParallelFor(0, this->Columns(), ColumnGrain, [&](int first, int last) {
    for (int column = first; column < last; ++column)
    {
      double X = 0.0;
      double Y = 0.0;
      for (int s = this->SlotBegins[column]; s < this->SlotBegins[column + 1]; ++s)
      {
        X += sums[2 * this->Slots[s]];
        Y += sums[2 * this->Slots[s] + 1];
      }
      z[2 * column] = X;
      z[2 * column + 1] = Y;
    }
  });
}

SparseMatrix<Plane> CompactProlongation::SelectedRows(
  const std::vector<int>& rows, const ExecutionContext& context) const
{
  const int size = static_cast<int>(rows.size());
  SparseMatrix<Plane> selected(size, this->Columns());
  MakeRoom(selected, context,
    [&](int k) { return this->RowBegins[rows[k] + 1] - this->RowBegins[rows[k]]; });
  context.ParallelFor(0, size, RowsOfTile, [&](int first, int last) {
    for (int k = first; k < last; ++k)
    {
      const int row = rows[k];
      const auto tile =
        std::upper_bound(this->TileBegins.begin(), this->TileBegins.end(), row) - 1;
      const int* const columns = this->ColumnsOfTiles.data() +
        this->ColumnBegins[tile - this->TileBegins.begin()];
      int at = selected.outerIndexPtr()[k];
      for (int e = this->RowBegins[row]; e < this->RowBegins[row + 1]; ++e, ++at)
      {
        const Entry& entry = this->Entries[e];
        selected.innerIndexPtr()[at] = columns[entry.Column];
        selected.valuePtr()[at] = this->Units[row] * Plane(entry.X, entry.Y);
      }
    }
  });
  return selected;
}

SparseMatrix<Plane> CompactProlongation::Rounded(const ExecutionContext& context) const
{
  return this->SelectedRows(Identity(this->Rows()), context);
}

long long CompactProlongation::Bytes() const
{
  const auto bytes = [](const auto& vector) {
    return static_cast<long long>(vector.size() * sizeof(vector[0]));
  };
  return bytes(this->TileBegins) + bytes(this->ColumnBegins) + bytes(this->ColumnsOfTiles) +
    bytes(this->RowBegins) + bytes(this->Units) + bytes(this->Entries) + bytes(this->SlotBegins) +
    bytes(this->Slots);
}

}
