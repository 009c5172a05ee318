#include "Solvers/CompactProlongation.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>

namespace dmg
{
namespace
{

constexpr int ColumnGrain = 4096;
constexpr int RowsOfSlice = CompactProlongation::RowsOfSlice;

/// The products of the rows of a slice with plane vectors.
class PlanarSlice
{
public:
  void Add(FloatPack firstTwo, FloatPack lastTwo, FloatPack ofFirstTwo, FloatPack ofLastTwo)
  {
    this->FirstTwo += firstTwo * ofFirstTwo;
    this->LastTwo += lastTwo * ofLastTwo;
  }

  float operator[](int lane) const { return this->Sum(lane, 0) + this->Sum(lane, 1); }
  /// X x - Y y instead of X x + Y y.
  float Difference(int lane) const { return this->Sum(lane, 0) - this->Sum(lane, 1); }

private:
  float Sum(int lane, int component) const
  {
    return (lane < 2 ? this->FirstTwo : this->LastTwo)[2 * (lane % 2) + component];
  }

  FloatPack FirstTwo{};
  FloatPack LastTwo{};
};

/// The same with complex numbers.
class ComplexSlice
{
public:
  void Add(FloatPack firstTwo, FloatPack lastTwo, FloatPack ofFirstTwo, FloatPack ofLastTwo)
  {
    this->Straight.Add(firstTwo, lastTwo, ofFirstTwo, ofLastTwo);
    this->Crossed.Add(firstTwo, lastTwo, SwapPairs(ofFirstTwo), SwapPairs(ofLastTwo));
  }

  Plane operator[](int lane) const
  {
    return { this->Straight.Difference(lane), this->Crossed[lane] };
  }

private:
  PlanarSlice Straight;
  PlanarSlice Crossed;
};

/// What the rows of a slice, times units, add to the sums of their columns.
class PlanarFactors
{
public:
  using Sum = double;

  PlanarFactors(const float* units, const double* rows, const std::uint16_t* places)
  {
    for (int lane = 0; lane < RowsOfSlice; ++lane)
    {
      this->Rows[lane] = DoublePack{} + units[lane] * rows[places[lane]];
    }
  }

  void Add(
    IntegerPack firstTwo, IntegerPack lastTwo, const std::uint16_t* columns, double* sums) const
  {
    DoublePack entries[RowsOfSlice];
    ToDoubles(firstTwo, entries[0], entries[1]);
    ToDoubles(lastTwo, entries[2], entries[3]);
    for (int lane = 0; lane < RowsOfSlice; ++lane)
    {
      double* const sum = sums + 2 * columns[lane];
      StorePack(LoadPack<DoublePack>(sum) + entries[lane] * this->Rows[lane], sum);
    }
  }

private:
  DoublePack Rows[RowsOfSlice];
};

/// The same for conjugates of complex numbers. Rows are in single precision, and so are the sums of the
/// entries that a column has in a tile.
class ComplexFactors
{
public:
  using Sum = float;

  ComplexFactors(const float* units, const Plane* rows, const std::uint16_t* places)
  {
    for (int two = 0; two < 2; ++two)
    {
      const Plane first = units[2 * two] * rows[places[2 * two]];
      const Plane last = units[2 * two + 1] * rows[places[2 * two + 1]];
      this->OfX[two] = FloatPack{ first.real(), first.imag(), last.real(), last.imag() };
      this->OfY[two] = FloatPack{ first.imag(), -first.real(), last.imag(), -last.real() };
    }
  }

  void Add(
    IntegerPack firstTwo, IntegerPack lastTwo, const std::uint16_t* columns, float* sums) const
  {
    AddPairs(this->Times(ToFloats(firstTwo), 0), sums, columns[0], columns[1]);
    AddPairs(this->Times(ToFloats(lastTwo), 1), sums, columns[2], columns[3]);
  }

private:
  FloatPack Times(FloatPack entries, int two) const
  {
    return __builtin_shufflevector(entries, entries, 0, 0, 2, 2) * this->OfX[two] +
      __builtin_shufflevector(entries, entries, 1, 1, 3, 3) * this->OfY[two];
  }

  FloatPack OfX[2];
  FloatPack OfY[2];
};

}

int CompactProlongation::LastRow(int tile) const
{
  return std::min(this->FirstRow(tile + 1), this->NumberOfRows);
}

int CompactProlongation::LastSlice(int tile) const
{
  const int rows = this->LastRow(tile) - this->FirstRow(tile);
  return this->FirstSlice(tile) + (rows + RowsOfSlice - 1) / RowsOfSlice;
}

template <class Slice, class Row>
void CompactProlongation::AddProductBySlices(
  const double* z, Vector<Row>& x, const ExecutionContext& context) const
{
  assert(x.size() == this->Rows());
  context.ParallelFor(0, this->NumberOfTiles(), 1, [&](int firstTile, int lastTile) {
    std::vector<float> ofTile;
    std::vector<decltype(1.0f * Slice()[0])> products(this->RowsOfTile + 1);
    for (int tile = firstTile; tile < lastTile; ++tile)
    {
      ofTile.clear();
      for (int slot = this->ColumnBegins[tile]; slot < this->ColumnBegins[tile + 1]; ++slot)
      {
        const int column = this->ColumnsOfTiles[slot];
        ofTile.push_back(static_cast<float>(z[2 * column]));
        ofTile.push_back(static_cast<float>(z[2 * column + 1]));
      }
      for (int slice = this->FirstSlice(tile); slice < this->LastSlice(tile); ++slice)
      {
        Slice sums;
        for (int s = this->StepBegins[slice]; s < this->StepBegins[slice + 1]; ++s)
        {
          const Step& step = this->Steps[s];
          IntegerPack firstTwo, lastTwo;
          LoadIntegers(step.Components, firstTwo, lastTwo);
          sums.Add(ToFloats(firstTwo), ToFloats(lastTwo),
            GatherPairs(ofTile.data(), step.Columns[0], step.Columns[1]),
            GatherPairs(ofTile.data(), step.Columns[2], step.Columns[3]));
        }
        for (int lane = 0; lane < RowsOfSlice; ++lane)
        {
          const int place = RowsOfSlice * slice + lane;
          products[this->RowsAt[place]] = this->Units[place] * sums[lane];
        }
      }
      for (int row = this->FirstRow(tile); row < this->LastRow(tile); ++row)
      {
        x[row] += products[row - this->FirstRow(tile)];
      }
    }
  });
}

void CompactProlongation::AddProduct(
  const Vector<double>& z, Vector<double>& x, const ExecutionContext& context) const
{
  assert(z.size() == 2 * this->Columns());
  this->AddProductBySlices<PlanarSlice>(z.data(), x, context);
}

void CompactProlongation::AddProduct(
  const Vector<Complex>& z, Vector<Plane>& x, const ExecutionContext& context) const
{
  assert(z.size() == this->Columns());
  this->AddProductBySlices<ComplexSlice>(reinterpret_cast<const double*>(z.data()), x, context);
}

template <class Factors, class Row>
void CompactProlongation::MultiplyAdjointBySlices(const Vector<Row>& x, double* z,
  Vector<typename Factors::Sum>& sums, const ExecutionContext& context) const
{
  assert(x.size() == this->Rows());
  sums.resize(this->SizeOfSums());
  context.ParallelFor(0, this->NumberOfTiles(), 1, [&](int firstTile, int lastTile) {
    std::vector<Row> rows; // read one after the other, and then from a cache
    for (int tile = firstTile; tile < lastTile; ++tile)
    {
      typename Factors::Sum* const ofTile = sums.data() + 2 * this->ColumnBegins[tile];
      std::fill(ofTile, sums.data() + 2 * this->ColumnBegins[tile + 1], 0);
      rows.assign(x.data() + this->FirstRow(tile), x.data() + this->LastRow(tile));
      rows.resize(this->RowsOfTile + 1, Row(0));
      for (int slice = this->FirstSlice(tile); slice < this->LastSlice(tile); ++slice)
      {
        const Factors factors(this->Units.data() + RowsOfSlice * slice, rows.data(),
          this->RowsAt.data() + RowsOfSlice * slice);
        for (int s = this->StepBegins[slice]; s < this->StepBegins[slice + 1]; ++s)
        {
          const Step& step = this->Steps[s];
          IntegerPack firstTwo, lastTwo;
          LoadIntegers(step.Components, firstTwo, lastTwo);
          factors.Add(firstTwo, lastTwo, step.Columns, ofTile);
        }
      }
    }
  });
  context.ParallelFor(0, this->Columns(), ColumnGrain, [&](int first, int last) {
    for (int column = first; column < last; ++column)
    {
      DoublePack sum{};
      for (int s = this->SlotBegins[column]; s < this->SlotBegins[column + 1]; ++s)
      {
        const auto* const ofTile = sums.data() + 2 * this->Slots[s];
        sum += DoublePack{ ofTile[0], ofTile[1] };
      }
      StorePack(sum, z + 2 * column);
    }
  });
}

void CompactProlongation::MultiplyAdjoint(const Vector<double>& x, Vector<double>& z,
  Vector<double>& sums, const ExecutionContext& context) const
{
  z.resize(2 * this->Columns());
  this->MultiplyAdjointBySlices<PlanarFactors>(x, z.data(), sums, context);
}

void CompactProlongation::MultiplyAdjoint(const Vector<Plane>& x, Vector<Complex>& z,
  Vector<float>& sums, const ExecutionContext& context) const
{
  z.resize(this->Columns());
  this->MultiplyAdjointBySlices<ComplexFactors>(
    x, reinterpret_cast<double*>(z.data()), sums, context);
}

const SparseRows<Plane>& CompactProlongation::Reader::TileAt(int tile)
{
  if (this->Places[tile] >= 0)
  {
    return this->Unpacked[this->Places[tile]];
  }
  this->Places[tile] = static_cast<int>(this->Tiles.size());
  this->Tiles.push_back(tile);
  this->Unpacked.resize(std::max(this->Unpacked.size(), this->Tiles.size()));
  SparseRows<Plane>& rows = this->Unpacked[this->Places[tile]];
  const int* const columns = this->P.ColumnsOfTiles.data() + this->P.ColumnBegins[tile];
  const int firstSlice = this->P.FirstSlice(tile);
  const auto forEntries = [&](const auto& visit) {
    for (int slice = firstSlice; slice < this->P.LastSlice(tile); ++slice)
    {
      for (int lane = 0; lane < RowsOfSlice; ++lane)
      {
        const int place = RowsOfSlice * slice + lane;
        for (int s = this->P.StepBegins[slice]; s < this->P.StepBegins[slice + 1]; ++s)
        {
          const Step& step = this->P.Steps[s];
          const Plane entry(step.Components[2 * lane], step.Components[2 * lane + 1]);
          if (entry == Plane(0))
          {
            break;
          }
          visit(this->P.RowsAt[place], columns[step.Columns[lane]], this->P.Units[place] * entry);
        }
      }
    }
  };
  rows.Offsets.assign(this->P.LastRow(tile) - this->P.FirstRow(tile) + 1, 0);
  forEntries([&rows](int row, int, Plane) { ++rows.Offsets[row + 1]; });
  rows.Columns.resize(OffsetsFromCounts(rows.Offsets));
  rows.Values.resize(rows.Columns.size());
  std::vector<int> next(rows.Offsets.begin(), rows.Offsets.end() - 1);
  forEntries([&rows, &next](int row, int column, Plane value) {
    rows.Columns[next[row]] = column;
    rows.Values[next[row]++] = value;
  });
  return rows;
}

RowOfBand<Plane> CompactProlongation::Reader::Row(int row)
{
  const int tile = row / this->P.RowsOfTile;
  return this->TileAt(tile).Row(row - this->P.FirstRow(tile));
}

void CompactProlongation::Reader::AdjointRows(
  int firstColumn, int lastColumn, SparseRows<Plane>& restriction)
{
  std::vector<int> tiles;
  for (int s = this->P.SlotBegins[firstColumn]; s < this->P.SlotBegins[lastColumn]; ++s)
  {
    tiles.push_back(static_cast<int>(std::upper_bound(this->P.ColumnBegins.begin(),
                      this->P.ColumnBegins.end(), this->P.Slots[s]) -
      this->P.ColumnBegins.begin() - 1));
  }
  std::sort(tiles.begin(), tiles.end());
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  const auto forEntries = [&](const auto& visit) {
    for (const int tile : tiles)
    {
      const SparseRows<Plane>& rows = this->TileAt(tile);
      for (int i = 0; i < rows.Size(); ++i)
      {
        const RowOfBand<Plane> row = rows.Row(i);
        for (int e = 0; e < row.Size; ++e)
        {
          if (row.Columns[e] >= firstColumn && row.Columns[e] < lastColumn)
          {
            visit(row.Columns[e] - firstColumn, this->P.FirstRow(tile) + i, std::conj(row.Values[e]));
          }
        }
      }
    }
  };
  restriction.Offsets.assign(lastColumn - firstColumn + 1, 0);
  forEntries([&](int column, int, Plane) { ++restriction.Offsets[column + 1]; });
  restriction.Columns.resize(OffsetsFromCounts(restriction.Offsets));
  restriction.Values.resize(restriction.Columns.size());
  std::vector<int> next(restriction.Offsets.begin(), restriction.Offsets.end() - 1);
  forEntries([&](int column, int row, Plane value) {
    restriction.Columns[next[column]] = row;
    restriction.Values[next[column]++] = value;
  });
}

void CompactProlongation::Reader::Clear()
{
  for (const int tile : this->Tiles)
  {
    this->Places[tile] = -1;
  }
  this->Tiles.clear();
}

SparseMatrix<Plane> CompactProlongation::SelectedRows(
  const std::vector<int>& rows, const ExecutionContext& context) const
{
  const auto makeWorker = [&] {
    return [&, reader = Reader(*this)](int first, int last, SparseRows<Plane>& selected) mutable {
      for (int k = first; k < last; ++k)
      {
        const RowOfBand<Plane> row = reader.Row(rows[k]);
        selected.Columns.insert(selected.Columns.end(), row.Columns, row.Columns + row.Size);
        selected.Values.insert(selected.Values.end(), row.Values, row.Values + row.Size);
        selected.EndRow();
      }
      reader.Clear();
    };
  };
  return AssembleInBands<Plane>(
    static_cast<int>(rows.size()), this->Columns(), makeWorker, context);
}

long long CompactProlongation::Bytes() const
{
  const auto bytes = [](const auto& vector) {
    return static_cast<long long>(vector.size() * sizeof(vector[0]));
  };
  return bytes(this->ColumnBegins) + bytes(this->ColumnsOfTiles) + bytes(this->SlotBegins) +
    bytes(this->Slots) + bytes(this->StepBegins) + bytes(this->Steps) + bytes(this->RowsAt) +
    bytes(this->Units);
}

}
