#ifndef dmgArrangedMatrix_h
#define dmgArrangedMatrix_h

#include "Support/ExecutionContext.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <algorithm>
#include <vector>

/// Parts of matrices in another order, scaled, and in numbers of another kind: what cycles work on.
namespace dmg
{

/// The entries of A with keep(place of row, place of column), in another order and scaled: entry
/// (i, j) becomes rowScale_i a_ij columnScale_j. Columns of a row are in any order.
template <class Value, class Scalar, class Keep>
void Arrange(const SparseMatrix<Scalar>& A, const std::vector<int>& rowOrder, const std::vector<int>& columnPlaces,
  const Vector<double>& rowScale, const Vector<double>& columnScale, const Keep& keep, SparseMatrix<Value>& result,
  const ExecutionContext& context)
{
  const int rows = static_cast<int>(A.rows());
  const int* offsetsOfA = A.outerIndexPtr();
  const int* columnsOfA = A.innerIndexPtr();
  const Scalar* valuesOfA = A.valuePtr();
  constexpr int RowGrain = 4096;
  result.resize(rows, A.cols());
  MakeRoom(result, context,
    [offsetsOfA, columnsOfA, &rowOrder, &columnPlaces, &keep](int k)
    {
      const int i = rowOrder[k];
      int count = 0;
      for (int m = offsetsOfA[i]; m < offsetsOfA[i + 1]; ++m)
      {
        count += keep(k, columnPlaces[columnsOfA[m]]) ? 1 : 0;
      }
      return count;
    });
  const int* offsets = result.outerIndexPtr();
  int* columns = result.innerIndexPtr();
  Value* values = result.valuePtr();
  context.ParallelFor(0, rows, RowGrain,
    [offsetsOfA, columnsOfA, valuesOfA, offsets, columns, values, &rowOrder, &columnPlaces, &rowScale, &columnScale,
      &keep](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        const int i = rowOrder[k];
        int to = offsets[k];
        for (int m = offsetsOfA[i]; m < offsetsOfA[i + 1]; ++m)
        {
          const int j = columnsOfA[m];
          if (keep(k, columnPlaces[j]))
          {
            columns[to] = columnPlaces[j];
            values[to] = static_cast<Value>(valuesOfA[m] * (rowScale[i] * columnScale[j]));
            ++to;
          }
        }
      }
    });
}

struct EveryEntry
{
  bool operator()(int, int) const { return true; }
};

/// The part left of the diagonal in the new order, scaled from both sides.
template <class Value, class Scalar>
void ArrangeLower(const SparseMatrix<Scalar>& A, const std::vector<int>& order, const std::vector<int>& places,
  const Vector<double>& scale, SparseMatrix<Value>& lower, const ExecutionContext& context)
{
  Arrange(
    A, order, places, scale, scale, [](int row, int column) { return column < row; }, lower, context);
}

/// The part right of the diagonal.
template <class Value, class Scalar>
void ArrangeUpper(const SparseMatrix<Scalar>& A, const std::vector<int>& order, const std::vector<int>& places,
  const Vector<double>& scale, SparseMatrix<Value>& upper, const ExecutionContext& context)
{
  Arrange(
    A, order, places, scale, scale, [](int row, int column) { return column > row; }, upper, context);
}

/// The same two parts of a matrix of pairs, so that both are matrices of pairs: a row has its own pair in the part
/// where the other of the two is, and there zero on the diagonal.
template <class Value, class Scalar>
void ArrangePairs(const SparseMatrix<Scalar>& A, const std::vector<int>& order, const std::vector<int>& places,
  const Vector<double>& scale, SparseMatrix<Value>& lower, SparseMatrix<Value>& upper, const ExecutionContext& context)
{
  Arrange(
    A, order, places, scale, scale, [](int row, int column) { return column / 2 < row / 2 + row % 2; }, lower, context);
  Arrange(
    A, order, places, scale, scale, [](int row, int column) { return column / 2 > row / 2 - 1 + row % 2; }, upper,
    context);
  constexpr int RowGrain = 1024;
  for (SparseMatrix<Value>* const part : { &lower, &upper })
  {
    context.ParallelFor(0, static_cast<int>(part->rows()), RowGrain,
      [part](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          const int* const columns = part->innerIndexPtr();
          const int end = part->outerIndexPtr()[i + 1];
          const auto e = std::find(columns + part->outerIndexPtr()[i], columns + end, i) - columns;
          if (e < end)
          {
            part->valuePtr()[e] = Value(0);
          }
        }
      });
  }
}

}

#endif
