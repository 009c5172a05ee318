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

/// Some rows of a matrix, in the order given.
template <class Scalar>
SparseMatrix<Scalar> SelectRows(const SparseMatrix<Scalar>& matrix, const std::vector<int>& rows)
{
  SparseRows<Scalar> selected;
  selected.Offsets.reserve(rows.size() + 1);
  selected.Offsets.push_back(0);
  for (int row : rows)
  {
    const int first = matrix.outerIndexPtr()[row];
    const int last = matrix.outerIndexPtr()[row + 1];
    selected.Indices.insert(
      selected.Indices.end(), matrix.innerIndexPtr() + first, matrix.innerIndexPtr() + last);
    selected.Entries.insert(
      selected.Entries.end(), matrix.valuePtr() + first, matrix.valuePtr() + last);
    selected.Offsets.push_back(static_cast<int>(selected.Indices.size()));
  }
  return ToMatrix(selected, static_cast<int>(matrix.cols()));
}

/// The matrix whose row \p numbers[i] is row i of \p matrix; \p numbers is a permutation.
template <class Scalar>
SparseMatrix<Scalar> RenumberRows(
  const SparseMatrix<Scalar>& matrix, const std::vector<int>& numbers)
{
  std::vector<int> inverse(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    inverse[numbers[i]] = static_cast<int>(i);
  }
  return SelectRows(matrix, inverse);
}

}

#endif
