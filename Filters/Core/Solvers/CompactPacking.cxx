#include "Solvers/CompactProlongation.h"

#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

// How a prolongation becomes a compact one.
namespace dmg
{
namespace
{

constexpr int MostRowsOfTile = 2048;
constexpr int MostColumnsOfTile = 65536; // they have numbers of 16 bits
constexpr int ColumnGrain = 4096;
constexpr float LargestInteger = 32767.0f;

/// \param largest component of the row.
/// \return 1 where there is nothing, or too little for a normal number.
template <class Real>
Real UnitOf(Real largest)
{
  const Real unit = largest / LargestInteger;
  return unit >= std::numeric_limits<Real>::min() ? unit : Real(1);
}

/// Rounded. \pre |component| is at most the largest.
template <class Real>
std::int16_t InUnits(Real component, Real unit)
{
  const Real number = component / unit;
  return static_cast<std::int16_t>(number < 0 ? number - Real(0.5) : number + Real(0.5));
}

}

/// Packs the adjoint tile by tile. Columns ascend in its rows, so that what a tile needs of one is a
/// segment of it.
class CompactProlongation::Packing
{
public:
  Packing(CompactProlongation& prolongation, const RowBands<Plane>& restriction)
    : To(prolongation)
    , R(restriction)
  {
  }

  /// Tiles of so few rows that their columns can be numbered.
  void CutIntoTiles(const ExecutionContext& context);
  /// Rows of tiles by length, and room for their slices.
  void MakeSlices(const ExecutionContext& context);
  void Fill(const ExecutionContext& context);

private:
  /// Of a column in a tile.
  struct Segment
  {
    int Column;
    int Tile;
    int Begin; ///< among the entries of the column
  };

  void FindSegments(const ExecutionContext& context);
  /// Calls visit(slot in the tile, row in the tile, value) for all entries of a tile, columns ascending.
  template <class Visit>
  void ForEntries(int tile, const Visit& visit) const;
  template <class Visit>
  void ForTiles(const ExecutionContext& context, const Visit& visit) const
  {
    context.ParallelFor(0, this->To.NumberOfTiles(), 1, [&visit](int first, int last) {
      for (int tile = first; tile < last; ++tile)
      {
        visit(tile);
      }
    });
  }
  int RowsIn(int tile) const { return this->To.LastRow(tile) - this->To.FirstRow(tile); }

  CompactProlongation& To;
  const RowBands<Plane>& R;
  std::vector<Segment> Segments; ///< column by column
  std::vector<int> Order;        ///< of segments, tile by tile
};

void CompactProlongation::Packing::FindSegments(const ExecutionContext& context)
{
  const int columns = this->R.Rows();
  const int rowsOfTile = this->To.RowsOfTile;
  const auto forSegments = [this, rowsOfTile](int column, const auto& visit) {
    const RowOfBand<Plane> entries = this->R.Row(column);
    int end = 0; // of the rows of the tile
    for (int e = 0; e < entries.Size; ++e)
    {
      if (e == 0 || entries.Columns[e] >= end)
      {
        const int tile = entries.Columns[e] / rowsOfTile;
        end = (tile + 1) * rowsOfTile;
        visit(Segment{ column, tile, e });
      }
    }
  };
  std::vector<int>& begins = this->To.SlotBegins;
  begins.assign(columns + 1, 0);
  context.ParallelFor(0, columns, ColumnGrain, [&](int first, int last) {
    for (int column = first; column < last; ++column)
    {
      forSegments(column, [&](const Segment&) { ++begins[column + 1]; });
    }
  });
  this->Segments.resize(OffsetsFromCounts(begins));
  context.ParallelFor(0, columns, ColumnGrain, [&](int first, int last) {
    for (int column = first; column < last; ++column)
    {
      auto next = this->Segments.begin() + begins[column];
      forSegments(column, [&next](const Segment& segment) { *next++ = segment; });
    }
  });
}

void CompactProlongation::Packing::CutIntoTiles(const ExecutionContext& context)
{
  this->To.NumberOfRows = this->R.Columns();
  for (this->To.RowsOfTile = MostRowsOfTile;; this->To.RowsOfTile /= 2)
  {
    this->FindSegments(context);
    const int tiles = (this->To.NumberOfRows + this->To.RowsOfTile - 1) / this->To.RowsOfTile;
    SortedItems byTiles = SortByKey(Identity(static_cast<int>(this->Segments.size())), tiles,
      [this](int segment) { return this->Segments[segment].Tile; }, context);
    this->Order = std::move(byTiles.Items);
    this->To.ColumnBegins = std::move(byTiles.Begins);
    int most = 0;
    for (int tile = 0; tile < tiles; ++tile)
    {
      most = std::max(most, this->To.ColumnBegins[tile + 1] - this->To.ColumnBegins[tile]);
    }
    if (most <= MostColumnsOfTile)
    {
      break;
    }
    if (this->To.RowsOfTile == 1)
    {
      throw InvalidInput("a row of an interpolation has " + std::to_string(most) +
        " entries, more than " + std::to_string(MostColumnsOfTile) + "; decimate the surface");
    }
  }
  this->To.Slots = Inverse(this->Order);
  this->To.ColumnsOfTiles.reserve(this->Order.size());
  for (const int segment : this->Order)
  {
    this->To.ColumnsOfTiles.push_back(this->Segments[segment].Column);
  }
}

template <class Visit>
void CompactProlongation::Packing::ForEntries(int tile, const Visit& visit) const
{
  const int firstRow = this->To.FirstRow(tile);
  const int lastRow = this->To.LastRow(tile);
  const int firstSlot = this->To.ColumnBegins[tile];
  for (int slot = firstSlot; slot < this->To.ColumnBegins[tile + 1]; ++slot)
  {
    const Segment& segment = this->Segments[this->Order[slot]];
    const RowOfBand<Plane> entries = this->R.Row(segment.Column);
    for (int e = segment.Begin; e < entries.Size && entries.Columns[e] < lastRow; ++e)
    {
      visit(slot - firstSlot, entries.Columns[e] - firstRow, std::conj(entries.Values[e]));
    }
  }
}

void CompactProlongation::Packing::MakeSlices(const ExecutionContext& context)
{
  const int tiles = this->To.NumberOfTiles();
  const int slices = tiles > 0 ? this->To.LastSlice(tiles - 1) : 0;
  this->To.StepBegins.assign(slices + 1, 0);
  this->To.RowsAt.assign(RowsOfSlice * slices, this->To.RowsOfTile); // which is no row
  this->ForTiles(context, [&](int tile) {
    std::vector<int> lengths(this->RowsIn(tile), 0);
    this->ForEntries(tile, [&](int, int row, Plane) { ++lengths[row]; });
    const int longest = lengths.empty() ? 0 : *std::max_element(lengths.begin(), lengths.end());
    // Lanes are far from each other, so that they seldom add to one sum, and wait for each other.
    constexpr int distance = 64;
    const SerialContext serial;
    const std::vector<int> byDistance = SortByKey(Identity(static_cast<int>(lengths.size())),
      distance, [](int row) { return row % distance; }, serial).Items;
    const std::vector<int> byLength = SortByKey(byDistance, longest + 1,
      [&lengths, longest](int row) { return longest - lengths[row]; }, serial).Items;
    const int firstSlice = this->To.FirstSlice(tile);
    std::copy(byLength.begin(), byLength.end(), this->To.RowsAt.begin() + RowsOfSlice * firstSlice);
    for (int slice = firstSlice; slice < this->To.LastSlice(tile); ++slice)
    {
      this->To.StepBegins[slice + 1] = lengths[byLength[RowsOfSlice * (slice - firstSlice)]];
    }
  });
  this->To.Steps.resize(OffsetsFromCounts(this->To.StepBegins));
  this->To.Units.resize(this->To.RowsAt.size());
}

void CompactProlongation::Packing::Fill(const ExecutionContext& context)
{
  std::vector<long long> entries(this->To.NumberOfTiles(), 0);
  this->ForTiles(context, [&](int tile) {
    const int rows = this->RowsIn(tile);
    std::vector<float> units(rows, 0.0f);
    this->ForEntries(tile, [&units](int, int row, Plane entry) {
      units[row] = std::max({ units[row], std::abs(entry.real()), std::abs(entry.imag()) });
    });
    const int firstPlace = RowsOfSlice * this->To.FirstSlice(tile);
    std::vector<int> places(rows);
    std::vector<int> next(rows); // the step of the next entry
    for (int k = 0; k < rows; ++k)
    {
      const int row = this->To.RowsAt[firstPlace + k];
      places[row] = k;
      next[row] = this->To.StepBegins[(firstPlace + k) / RowsOfSlice];
      units[row] = UnitOf(units[row]);
      this->To.Units[firstPlace + k] = units[row];
    }
    this->ForEntries(tile, [&](int slot, int row, Plane entry) {
      const std::int16_t x = InUnits(entry.real(), units[row]);
      const std::int16_t y = InUnits(entry.imag(), units[row]);
      if (x != 0 || y != 0)
      {
        Step& step = this->To.Steps[next[row]++];
        const int lane = places[row] % RowsOfSlice;
        step.Columns[lane] = static_cast<std::uint16_t>(slot);
        step.Components[2 * lane] = x;
        step.Components[2 * lane + 1] = y;
        ++entries[tile];
      }
    });
  });
  this->To.NumberOfEntries = std::accumulate(entries.begin(), entries.end(), 0LL);
}

CompactProlongation::CompactProlongation(
  const RowBands<Plane>& restriction, const ExecutionContext& context)
{
  Packing packing(*this, restriction);
  packing.CutIntoTiles(context);
  packing.MakeSlices(context);
  packing.Fill(context);
}

void CompactProlongation::Round(SparseMatrix<Complex>& P, const ExecutionContext& context)
{
  context.ParallelFor(0, static_cast<int>(P.rows()), MostRowsOfTile, [&P](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      Complex* const begin = P.valuePtr() + P.outerIndexPtr()[i];
      Complex* const end = P.valuePtr() + P.outerIndexPtr()[i + 1];
      double largest = 0.0;
      std::for_each(begin, end, [&largest](Complex entry) {
        largest = std::max({ largest, std::abs(entry.real()), std::abs(entry.imag()) });
      });
      const double unit = UnitOf(largest);
      std::transform(begin, end, begin, [unit](Complex entry) {
        return unit * Complex(InUnits(entry.real(), unit), InUnits(entry.imag(), unit));
      });
    }
  });
}

}
