#ifndef dmgSparseRows_h
#define dmgSparseRows_h

#include "Support/ExecutionContext.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <algorithm>
#include <vector>

/// What it takes to compute a sparse matrix row by row when its pattern is not known before.
namespace dmg
{

/// A set of indices that keeps the order of their arrival and is cleared at no cost.
///
/// Whether an index is new is as good as random in a sparse product, so Insert has no branch that a
/// processor could mispredict.
class IndexSet
{
public:
  explicit IndexSet(int upperBound)
    : Places(upperBound, 0)
    , Members(upperBound + 1)
  {
  }

  int Size() const { return this->Count; }
  void Clear() { this->Count = 0; }
  const int* begin() const { return this->Members.data(); }
  const int* end() const { return this->Members.data() + this->Count; }

  /// The place of an index in the order of arrival; Size() if it is no member.
  int Find(int index) const
  {
    const int place = this->Places[index];
    const bool isMember = (place < this->Count) & (this->Members[place] == index);
    return isMember ? place : this->Count;
  }

  /// The place of an index, which is a member afterwards.
  int Insert(int index)
  {
    const int place = this->Find(index);
    this->Places[index] = place;
    this->Members[place] = index;
    this->Count += place == this->Count ? 1 : 0;
    return place;
  }

private:
  std::vector<int> Places;
  std::vector<int> Members;
  int Count = 0;
};

/// A sparse vector that is summed up product by product.
template <class Scalar>
class SparseSum
{
public:
  explicit SparseSum(int size)
    : Indices(size)
    , Values(size, Scalar(0))
  {
  }

  void Clear()
  {
    std::fill_n(this->Values.begin(), this->Indices.Size(), Scalar(0));
    this->Indices.Clear();
  }

  void AddProduct(int index, Scalar a, Scalar b)
  {
    dmg::AddProduct(this->Values[this->Indices.Insert(index)], a, b);
  }

  /// The indices, and with begin() and end() their values, in the order of their arrival.
  const IndexSet& Support() const { return this->Indices; }
  const Scalar* begin() const { return this->Values.data(); }
  const Scalar* end() const { return this->Values.data() + this->Indices.Size(); }

  /// \pre index is in the support.
  Scalar operator[](int index) const { return this->Values[this->Indices.Find(index)]; }

private:
  IndexSet Indices;
  std::vector<Scalar> Values; ///< zero beyond the support
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

  void Append(int column, Scalar value)
  {
    this->Columns.push_back(column);
    this->Values.push_back(value);
  }
  void EndRow() { this->Offsets.push_back(static_cast<int>(this->Columns.size())); }
};

/// Ascending; mostly few.
void SortIndices(std::vector<int>& indices);

/// A sparse matrix in bands of rows, several at the same time.
/// \param makeWorker called as makeWorker(), gives a function worker(firstRow, lastRow, rows) that
///   appends these rows to the empty \p rows, columns ascending. Each worker serves many bands, one
///   after the other, and may own a workspace.
/// \throw InvalidInput more than 2^31 non-zeros.
template <class Scalar, class MakeWorker>
SparseMatrix<Scalar> AssembleInBands(
  int numberOfRows, int numberOfColumns, const MakeWorker& makeWorker, const ExecutionContext& context)
{
  constexpr int bandSize = 512;
  const int numberOfBands = (numberOfRows + bandSize - 1) / bandSize;
  std::vector<SparseRows<Scalar>> bands(numberOfBands);
  const int grain = std::max(1, numberOfBands / (8 * context.NumberOfThreads()));
  context.ParallelFor(0, numberOfBands, grain,
    [numberOfRows, &makeWorker, &bands](int firstBand, int lastBand)
    {
      auto worker = makeWorker();
      for (int band = firstBand; band < lastBand; ++band)
      {
        const int firstRow = band * bandSize;
        worker(firstRow, std::min(firstRow + bandSize, numberOfRows), bands[band]);
      }
    });

  std::vector<int> offsets(numberOfRows + 1, 0);
  for (int row = 0; row < numberOfRows; ++row)
  {
    const std::vector<int>& inBand = bands[row / bandSize].Offsets;
    offsets[row + 1] = inBand[row % bandSize + 1] - inBand[row % bandSize];
  }
  SparseMatrix<Scalar> A(numberOfRows, numberOfColumns);
  A.resizeNonZeros(OffsetsFromCounts(offsets));
  std::copy(offsets.begin(), offsets.end(), A.outerIndexPtr());
  context.ParallelFor(0, numberOfBands, grain,
    [&bands, &offsets, &A](int firstBand, int lastBand)
    {
      for (int band = firstBand; band < lastBand; ++band)
      {
        const int begin = offsets[band * bandSize];
        const SparseRows<Scalar>& rows = bands[band];
        std::copy(rows.Columns.begin(), rows.Columns.end(), A.innerIndexPtr() + begin);
        std::copy(rows.Values.begin(), rows.Values.end(), A.valuePtr() + begin);
      }
    });
  return A;
}

}

#endif
