#ifndef dmgSparseRows_h
#define dmgSparseRows_h

#include "Support/ExecutionContext.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

// Tools that compute a sparse matrix row by row when its pattern is not known before.
namespace dmg
{

/// A set of indices that keeps the order of their arrival and is cleared at no cost.
class IndexSet
{
public:
  explicit IndexSet(int upperBound)
    : Places(upperBound, 0)
    , Members(upperBound)
  {
  }

  int Size() const { return this->Count; }
  void Clear() { this->Count = 0; }

  /// The place of an index in the order of arrival; Size() if it is no member.
  int Find(int index) const
  {
    const int place = this->Places[index];
    return place < this->Count && this->Members[place] == index ? place : this->Count;
  }

  /// \pre index is no member.
  void Append(int index)
  {
    this->Places[index] = this->Count;
    this->Members[this->Count] = index;
    ++this->Count;
  }

private:
  std::vector<int> Places;
  std::vector<int> Members;
  int Count = 0;
};

/// The entries of a row that others hold.
template <class Scalar>
struct RowOfBand
{
  const int* Columns;
  const Scalar* Values;
  int Size;
};

/// Consecutive rows of a sparse matrix.
template <class Scalar>
struct SparseRows
{
  std::vector<int> Offsets = { 0 };
  std::vector<int> Columns;
  std::vector<Scalar> Values;

  void Clear()
  {
    this->Offsets.resize(1);
    this->Columns.clear();
    this->Values.clear();
  }

  int Size() const { return static_cast<int>(this->Offsets.size()) - 1; }
  RowOfBand<Scalar> Row(int k) const
  {
    const int begin = this->Offsets[k];
    return { this->Columns.data() + begin, this->Values.data() + begin, this->Offsets[k + 1] - begin };
  }

  /// The last row ends here.
  void EndRow() { this->Offsets.push_back(static_cast<int>(this->Columns.size())); }
};

/// Sorts in ascending order; fast for few indices.
void SortIndices(int* indices, int size);

/// A sparse vector that is summed up from multiples of sparse rows. Factors and values may be of other
/// kinds than the sums, as far as there is an AddProduct(sum, factor, value).
template <class Scalar>
class SparseSum
{
public:
  explicit SparseSum(int size)
    : Places(size, 0)
    , Members(size + 1)
    , Sums(size + 1, Scalar(0))
  {
  }

  void Clear()
  {
    std::fill_n(this->Sums.begin(), this->Count, Scalar(0));
    this->Count = 0;
  }

  /// Adds factor times the row with these entries.
  ///
  /// The innermost loop of every sparse product. Whether an index is new is as good as random, so
  /// there is no branch that a processor could mispredict; and what changes stands in local
  /// variables, which the stores cannot alias.
  template <class Factor, class Value>
  void Add(Factor factor, const int* indices, const Value* values, int size)
  {
    int* places = this->Places.data();
    int* members = this->Members.data();
    Scalar* sums = this->Sums.data();
    int count = this->Count;
    for (int k = 0; k < size; ++k)
    {
      const int index = indices[k];
      const int former = places[index];
      const int isNew = (former >= count) | (members[former] != index);
      const int place = former + isNew * (count - former);
      places[index] = place;
      members[place] = index;
      count += isNew;
      AddProduct(sums[place], factor, values[k]);
    }
    this->Count = count;
  }

  /// Indices and values by place, in the order of their arrival.
  int Size() const { return this->Count; }
  const int* Indices() const { return this->Members.data(); }
  const Scalar* Values() const { return this->Sums.data(); }

  /// Appends the sum as a row, columns ascending.
  void AppendTo(SparseRows<Scalar>& rows) const
  {
    const std::size_t begin = rows.Columns.size();
    rows.Columns.insert(rows.Columns.end(), this->Members.begin(), this->Members.begin() + this->Count);
    SortIndices(rows.Columns.data() + begin, this->Count);
    for (std::size_t k = begin; k < rows.Columns.size(); ++k)
    {
      rows.Values.push_back((*this)[rows.Columns[k]]);
    }
    rows.EndRow();
  }

  /// \pre index occurs.
  Scalar operator[](int index) const { return this->Sums[this->Places[index]]; }

private:
  std::vector<int> Places;
  std::vector<int> Members;
  std::vector<Scalar> Sums; ///< zero beyond the count
  int Count = 0;
};

/// A pool of objects that are expensive to make. A thread takes one and gives it back, so that there are no more objects
/// than threads. Objects are indexed by place and taken again near it, so that caches stay warm.
template <class Thing>
class Pool
{
public:
  /// The nearest object; null if all are taken.
  std::unique_ptr<Thing> Take(int place)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Things.empty())
    {
      return nullptr;
    }
    const auto nearest = std::min_element(this->Things.begin(), this->Things.end(),
      [place](const auto& a, const auto& b) { return std::abs(a.first - place) < std::abs(b.first - place); });
    std::unique_ptr<Thing> thing = std::move(nearest->second);
    this->Things.erase(nearest);
    return thing;
  }

  void GiveBack(int place, std::unique_ptr<Thing> thing)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Things.emplace_back(place, std::move(thing));
  }

private:
  std::mutex Mutex;
  std::vector<std::pair<int, std::unique_ptr<Thing>>> Things;
};

/// A sparse matrix as bands of consecutive rows.
template <class Scalar>
class RowBands
{
public:
  RowBands(int numberOfRows, int numberOfColumns)
    : NumberOfRows(numberOfRows)
    , NumberOfColumns(numberOfColumns)
    // Long bands cost little to join; short ones of a small matrix are enough for many threads.
    , BandSize(numberOfRows > 16384 ? 512 : 64)
    , Bands((numberOfRows + this->BandSize - 1) / this->BandSize)
  {
  }

  int Rows() const { return this->NumberOfRows; }
  int Columns() const { return this->NumberOfColumns; }
  RowOfBand<Scalar> Row(int row) const { return this->Bands[row / this->BandSize].Row(row % this->BandSize); }

  int NumberOfBands() const { return static_cast<int>(this->Bands.size()); }
  SparseRows<Scalar>& Band(int band) { return this->Bands[band]; }
  int FirstRow(int band) const { return band * this->BandSize; }
  int LastRow(int band) const { return std::min(this->FirstRow(band + 1), this->NumberOfRows); }

  /// The number of bands that a thread should take one after the other.
  int Grain(const ExecutionContext& context) const
  {
    return std::max(1, this->NumberOfBands() / (8 * context.NumberOfThreads()));
  }

private:
  int NumberOfRows;
  int NumberOfColumns;
  int BandSize;
  std::vector<SparseRows<Scalar>> Bands;
};

/// Assembles bands, several at the same time.
/// \param makeWorker called as makeWorker(), gives a function worker(firstRow, lastRow, rows) that
///   appends these rows to the empty \p rows, columns ascending. Each worker serves many bands, one
///   after the other, and may own a workspace. The first row of a band is even.
template <class Scalar, class MakeWorker>
RowBands<Scalar> AssembleBands(
  int numberOfRows, int numberOfColumns, const MakeWorker& makeWorker, const ExecutionContext& context)
{
  RowBands<Scalar> bands(numberOfRows, numberOfColumns);
  using Worker = decltype(makeWorker());
  Pool<Worker> workers;
  context.ParallelFor(0, bands.NumberOfBands(), bands.Grain(context),
    [&makeWorker, &workers, &bands](int firstBand, int lastBand)
    {
      std::unique_ptr<Worker> worker = workers.Take(firstBand);
      if (!worker)
      {
        worker = std::make_unique<Worker>(makeWorker());
      }
      std::size_t size = 0;
      for (int band = firstBand; band < lastBand; ++band)
      {
        // Bands are much alike.
        SparseRows<Scalar>& rows = bands.Band(band);
        rows.Columns.reserve(size + size / 8);
        rows.Values.reserve(size + size / 8);
        (*worker)(bands.FirstRow(band), bands.LastRow(band), rows);
        size = rows.Columns.size();
      }
      workers.GiveBack(lastBand, std::move(worker));
    });
  return bands;
}

/// One matrix; bands give their memory back on the way.
/// \throw InvalidInput more than 2^31 non-zeros.
template <class Scalar>
SparseMatrix<Scalar> Joined(RowBands<Scalar>&& bands, const ExecutionContext& context)
{
  SparseMatrix<Scalar> A(bands.Rows(), bands.Columns());
  MakeRoom(A, context, [&bands](int row) { return bands.Row(row).Size; });
  context.ParallelFor(0, bands.NumberOfBands(), bands.Grain(context),
    [&bands, &A](int firstBand, int lastBand)
    {
      for (int band = firstBand; band < lastBand; ++band)
      {
        const int begin = A.outerIndexPtr()[bands.FirstRow(band)];
        const SparseRows<Scalar> rows = std::move(bands.Band(band));
        std::copy(rows.Columns.begin(), rows.Columns.end(), A.innerIndexPtr() + begin);
        std::copy(rows.Values.begin(), rows.Values.end(), A.valuePtr() + begin);
      }
    });
  return A;
}

/// AssembleBands as one matrix.
template <class Scalar, class MakeWorker>
SparseMatrix<Scalar> AssembleInBands(
  int numberOfRows, int numberOfColumns, const MakeWorker& makeWorker, const ExecutionContext& context)
{
  return Joined(AssembleBands<Scalar>(numberOfRows, numberOfColumns, makeWorker, context), context);
}

}

#endif
