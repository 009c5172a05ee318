#ifndef dmgSparseAssembly_h
#define dmgSparseAssembly_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace dmg
{

/// Compressed rows of any kind of entry.
template <class Entry>
struct SparseRows
{
  std::vector<int> Offsets; ///< number of rows + 1
  std::vector<int> Indices; ///< columns, ascending in each row
  std::vector<Entry> Entries;
};

/// Calls appendRow(row, entries) for every row; it adds pairs (column, entry), each column once, in
/// any order. Rows are computed in parallel, and the result does not depend on the threads.
template <class Entry, class AppendRow>
SparseRows<Entry> AssembleRows(int rows, const ExecutionContext& context, AppendRow appendRow)
{
  constexpr int RowsPerPiece = 2048;
  struct Piece
  {
    std::vector<int> Sizes;
    std::vector<int> Indices;
    std::vector<Entry> Entries;
    int Offset;
  };
  const int numberOfPieces = (rows + RowsPerPiece - 1) / RowsPerPiece;
  std::vector<Piece> pieces(numberOfPieces);
  context.ParallelFor(0, numberOfPieces, 1, [&](int firstPiece, int lastPiece) {
    std::vector<std::pair<int, Entry>> row;
    for (int p = firstPiece; p < lastPiece; ++p)
    {
      const int end = std::min(rows, (p + 1) * RowsPerPiece);
      for (int r = p * RowsPerPiece; r < end; ++r)
      {
        row.clear();
        appendRow(r, row);
        std::sort(row.begin(), row.end(),
          [](const auto& a, const auto& b) { return a.first < b.first; });
        pieces[p].Sizes.push_back(static_cast<int>(row.size()));
        for (const auto& [column, entry] : row)
        {
          pieces[p].Indices.push_back(column);
          pieces[p].Entries.push_back(entry);
        }
      }
    }
  });

  int nonZeros = 0;
  for (Piece& piece : pieces)
  {
    piece.Offset = nonZeros;
    nonZeros += static_cast<int>(piece.Indices.size());
  }
  SparseRows<Entry> result;
  result.Offsets.resize(rows + 1);
  result.Indices.resize(nonZeros);
  result.Entries.resize(nonZeros);
  result.Offsets[rows] = nonZeros;
  context.ParallelFor(0, numberOfPieces, 1, [&](int firstPiece, int lastPiece) {
    for (int p = firstPiece; p < lastPiece; ++p)
    {
      int offset = pieces[p].Offset;
      std::copy(pieces[p].Indices.begin(), pieces[p].Indices.end(), result.Indices.begin() + offset);
      std::copy(pieces[p].Entries.begin(), pieces[p].Entries.end(), result.Entries.begin() + offset);
      for (std::size_t i = 0; i < pieces[p].Sizes.size(); ++i)
      {
        result.Offsets[p * RowsPerPiece + i] = offset;
        offset += pieces[p].Sizes[i];
      }
    }
  });
  return result;
}

/// The same rows as a matrix.
template <class Scalar>
SparseMatrix<Scalar> ToMatrix(const SparseRows<Scalar>& rows, int columns)
{
  const int numberOfRows = static_cast<int>(rows.Offsets.size()) - 1;
  SparseMatrix<Scalar> matrix(numberOfRows, columns);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(rows.Indices.size()));
  std::copy(rows.Offsets.begin(), rows.Offsets.end(), matrix.outerIndexPtr());
  std::copy(rows.Indices.begin(), rows.Indices.end(), matrix.innerIndexPtr());
  std::copy(rows.Entries.begin(), rows.Entries.end(), matrix.valuePtr());
  return matrix;
}

/// Rows of a matrix to be: columns and entries.
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

/// A matrix whose row r holds \p sizeOf(r) entries, written by \p fillRow(r, columns, values), columns
/// ascending. Rows are filled in parallel.
template <class Scalar, class SizeOf, class FillRow>
SparseMatrix<Scalar> FillRows(
  int rows, int columns, const ExecutionContext& context, SizeOf sizeOf, FillRow fillRow)
{
  constexpr int Grain = 4096;
  SparseMatrix<Scalar> matrix(rows, columns);
  int* const offsets = matrix.outerIndexPtr();
  offsets[0] = 0;
  for (int r = 0; r < rows; ++r)
  {
    offsets[r + 1] = offsets[r] + sizeOf(r);
  }
  matrix.resizeNonZeros(offsets[rows]);
  context.ParallelFor(0, rows, Grain, [&](int first, int last) {
    for (int r = first; r < last; ++r)
    {
      fillRow(r, matrix.innerIndexPtr() + offsets[r], matrix.valuePtr() + offsets[r]);
    }
  });
  return matrix;
}

/// The matrix whose rows \p appendRow(r, row) adds, each column once, in any order. Rows are computed
/// in parallel, and the result does not depend on the threads.
template <class Scalar, class AppendRow>
SparseMatrix<Scalar> AssembleMatrix(
  int rows, int columns, const ExecutionContext& context, AppendRow appendRow)
{
  // The size of a row is known only once it is computed, so pieces of rows are kept until all are.
  constexpr int RowsPerPiece = 2048;
  struct Piece
  {
    std::vector<int> Offsets;
    RowEntries<Scalar> Entries;
  };
  std::vector<Piece> pieces((rows + RowsPerPiece - 1) / RowsPerPiece);
  context.ParallelFor(0, static_cast<int>(pieces.size()), 1, [&](int firstPiece, int lastPiece) {
    RowEntries<Scalar> row;
    for (int p = firstPiece; p < lastPiece; ++p)
    {
      Piece& piece = pieces[p];
      const int end = std::min(rows, (p + 1) * RowsPerPiece);
      piece.Offsets.assign(1, 0);
      for (int r = p * RowsPerPiece; r < end; ++r)
      {
        row.clear();
        appendRow(r, row);
        std::sort(row.begin(), row.end(),
          [](const auto& a, const auto& b) { return a.first < b.first; });
        piece.Entries.insert(piece.Entries.end(), row.begin(), row.end());
        piece.Offsets.push_back(static_cast<int>(piece.Entries.size()));
      }
    }
  });
  const auto beginOf = [&](int r) { return pieces[r / RowsPerPiece].Offsets[r % RowsPerPiece]; };
  const auto endOf = [&](int r) { return pieces[r / RowsPerPiece].Offsets[r % RowsPerPiece + 1]; };
  return FillRows<Scalar>(
    rows, columns, context, [&](int r) { return endOf(r) - beginOf(r); },
    [&](int r, int* rowColumns, Scalar* values) {
      const RowEntries<Scalar>& entries = pieces[r / RowsPerPiece].Entries;
      for (int i = beginOf(r); i < endOf(r); ++i)
      {
        *rowColumns++ = entries[i].first;
        *values++ = entries[i].second;
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
    [&](int r, int* columns, Scalar* values) {
      const int first = offsets[rows[r]];
      const int last = offsets[rows[r] + 1];
      std::copy(matrix.innerIndexPtr() + first, matrix.innerIndexPtr() + last, columns);
      std::copy(matrix.valuePtr() + first, matrix.valuePtr() + last, values);
    });
}

/// The matrix whose row \p numbers[i] is row i of \p matrix; \p numbers is a permutation.
template <class Scalar>
SparseMatrix<Scalar> RenumberRows(const SparseMatrix<Scalar>& matrix,
  const std::vector<int>& numbers, const ExecutionContext& context)
{
  std::vector<int> inverse(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    inverse[numbers[i]] = static_cast<int>(i);
  }
  return SelectRows(matrix, inverse, context);
}

}

#endif
