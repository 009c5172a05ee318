#ifndef dmgSparseAssembly_h
#define dmgSparseAssembly_h

#include "Support/ExecutionContext.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace dmg
{

/// The columns and entries of a row that is being assembled.
template <class Scalar>
using RowEntries = std::vector<std::pair<int, Scalar>>;

/// Adds to the entry of a column, which may be new.
template <class Scalar>
void AddTo(RowEntries<Scalar>& row, int column, Scalar value)
{
  for (auto& [present, entry] : row)
  {
    if (present == column)
    {
      entry += value;
      return;
    }
  }
  row.emplace_back(column, value);
}

/// A matrix whose row r holds \p sizeOf(r) entries, written by \p fillRow(r, columns, values),
/// columns ascending. Rows are filled in parallel.
template <class Scalar, class SizeOf, class FillRow>
SparseMatrix<Scalar> FillRows(int rows, int columns, const ExecutionContext& context, SizeOf sizeOf, FillRow fillRow)
{
  constexpr int Grain = 4096;
  SparseMatrix<Scalar> matrix(rows, columns);
  MakeRoom(matrix, context, sizeOf);
  const int* const offsets = matrix.outerIndexPtr();
  context.ParallelFor(0, rows, Grain,
    [&](int first, int last)
    {
      for (int r = first; r < last; ++r)
      {
        fillRow(r, matrix.innerIndexPtr() + offsets[r], matrix.valuePtr() + offsets[r]);
      }
    });
  return matrix;
}

/// Rows of unknown size, in the pieces in which they were computed.
template <class Entry>
class AssembledRows
{
public:
  /// Calls appendRow(r, row) for every row; it adds pairs (column, entry), each column once, in any
  /// order. Rows are computed in parallel, and the result does not depend on the threads.
  template <class AppendRow>
  AssembledRows(int rows, const ExecutionContext& context, AppendRow appendRow)
    : Pieces((rows + RowsPerPiece - 1) / RowsPerPiece)
  {
    const int numberOfPieces = static_cast<int>(this->Pieces.size());
    context.ParallelFor(0, numberOfPieces, 1,
      [&](int firstPiece, int lastPiece)
      {
        RowEntries<Entry> row;
        std::size_t size = 0;
        for (int p = firstPiece; p < lastPiece; ++p)
        {
          Piece& piece = this->Pieces[p];
          piece.Entries.reserve(size + size / 8); // pieces are much alike
          const int end = std::min(rows, (p + 1) * RowsPerPiece);
          piece.Offsets.assign(1, 0);
          for (int r = p * RowsPerPiece; r < end; ++r)
          {
            row.clear();
            appendRow(r, row);
            std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
            piece.Entries.insert(piece.Entries.end(), row.begin(), row.end());
            piece.Offsets.push_back(static_cast<int>(piece.Entries.size()));
          }
          size = piece.Entries.size();
        }
      });
  }

  int Size(int row) const { return static_cast<int>(this->End(row) - this->Begin(row)); }
  /// Pairs (column, entry), columns ascending.
  const std::pair<int, Entry>* Begin(int row) const
  {
    const Piece& piece = this->Pieces[row / RowsPerPiece];
    return piece.Entries.data() + piece.Offsets[row % RowsPerPiece];
  }
  const std::pair<int, Entry>* End(int row) const
  {
    const Piece& piece = this->Pieces[row / RowsPerPiece];
    return piece.Entries.data() + piece.Offsets[row % RowsPerPiece + 1];
  }

private:
  static constexpr int RowsPerPiece = 2048;
  struct Piece
  {
    std::vector<int> Offsets;
    RowEntries<Entry> Entries;
  };
  std::vector<Piece> Pieces;
};

/// The matrix whose row r is \p assembled row \p sourceOf(r).
template <class Scalar, class SourceOf>
SparseMatrix<Scalar> MatrixOf(const AssembledRows<Scalar>& assembled, int rows, int columns,
  const ExecutionContext& context, const SourceOf& sourceOf)
{
  return FillRows<Scalar>(
    rows, columns, context, [&](int r) { return assembled.Size(sourceOf(r)); },
    [&](int r, int* rowColumns, Scalar* values)
    {
      const int source = sourceOf(r);
      for (const auto* entry = assembled.Begin(source); entry != assembled.End(source); ++entry)
      {
        *rowColumns++ = entry->first;
        *values++ = entry->second;
      }
    });
}

/// The matrix of the rows that \p appendRow adds; see AssembledRows.
template <class Scalar, class AppendRow>
SparseMatrix<Scalar> AssembleMatrix(int rows, int columns, const ExecutionContext& context, AppendRow appendRow)
{
  const AssembledRows<Scalar> assembled(rows, context, appendRow);
  return MatrixOf(assembled, rows, columns, context, [](int r) { return r; });
}

/// An entry that maps two numbers at one element to two numbers at another.
using Block = Eigen::Matrix2d;

/// The matrix of twice as many rows and columns that consists of the blocks that \p appendRow adds.
template <class AppendRow>
SparseMatrix<double> AssembleBlocks(
  int blockRows, int blockColumns, const ExecutionContext& context, AppendRow appendRow)
{
  const AssembledRows<Block> assembled(blockRows, context, appendRow);
  return FillRows<double>(
    2 * blockRows, 2 * blockColumns, context, [&](int r) { return 2 * assembled.Size(r / 2); },
    [&](int r, int* columns, double* values)
    {
      for (const auto* entry = assembled.Begin(r / 2); entry != assembled.End(r / 2); ++entry)
      {
        for (int k : { 0, 1 })
        {
          *columns++ = 2 * entry->first + k;
          *values++ = entry->second(r % 2, k);
        }
      }
    });
}

/// Some rows of a matrix, in the order given.
template <class Scalar>
SparseMatrix<Scalar> SelectRows(
  const SparseMatrix<Scalar>& matrix, const std::vector<int>& rows, const ExecutionContext& context)
{
  const int* const offsets = matrix.outerIndexPtr();
  return FillRows<Scalar>(
    static_cast<int>(rows.size()), static_cast<int>(matrix.cols()), context,
    [&](int r) { return offsets[rows[r] + 1] - offsets[rows[r]]; },
    [&](int r, int* columns, Scalar* values)
    {
      const int first = offsets[rows[r]];
      const int last = offsets[rows[r] + 1];
      std::copy(matrix.innerIndexPtr() + first, matrix.innerIndexPtr() + last, columns);
      std::copy(matrix.valuePtr() + first, matrix.valuePtr() + last, values);
    });
}

/// The matrix whose row \p numbers[i] is row i of \p matrix; \p numbers is a permutation.
template <class Scalar>
SparseMatrix<Scalar> RenumberRows(
  const SparseMatrix<Scalar>& matrix, const std::vector<int>& numbers, const ExecutionContext& context)
{
  std::vector<int> inverse(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    inverse[numbers[i]] = static_cast<int>(i);
  }
  return SelectRows(matrix, inverse, context);
}

/// Numbers of the rows where each element has two: 2 i and 2 i + 1 for every i.
inline std::vector<int> PairsOf(const std::vector<int>& numbers)
{
  std::vector<int> pairs;
  pairs.reserve(2 * numbers.size());
  for (int i : numbers)
  {
    pairs.push_back(2 * i);
    pairs.push_back(2 * i + 1);
  }
  return pairs;
}

}

#endif
