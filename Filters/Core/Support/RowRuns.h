#ifndef dmgRowRuns_h
#define dmgRowRuns_h

#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace dmg
{

/// A matrix of short rows, where rows of equal length follow each other: loops over a known number of
/// entries are unrolled, and a processor foresees where the others end.
template <class Value>
class RowRuns
{
public:
  /// \param matrix borrowed.
  explicit RowRuns(const SparseMatrix<Value>& matrix)
    : A(matrix)
  {
    const int* const offsets = matrix.outerIndexPtr();
    for (int row = 0; row < static_cast<int>(matrix.rows()); ++row)
    {
      const int length = offsets[row + 1] - offsets[row];
      if (this->Runs.empty() || this->Runs.back().Length != length)
      {
        this->Runs.push_back({ row, length });
      }
      this->Runs.back().End = row + 1;
    }
  }

  /// Calls visit(row, product of the row and x) for rows [first, last), ascending.
  /// The visitor may change entries of x, which the rows after it will see.
  template <class Visit>
  void Multiply(int first, int last, const Value* x, const Visit& visit) const
  {
    this->ForRows(first, last, [&](int row, const int* columns, const Value* values, auto length) {
      visit(row, Product(columns, values, length, x));
    });
  }

  /// y += A^T u for rows [first, last), where u_row = factor(row).
  template <class Factor>
  void AddAdjoint(int first, int last, const Factor& factor, Value* y) const
  {
    this->ForRows(first, last, [&](int row, const int* columns, const Value* values, auto length) {
      AddMultiple(columns, values, length, factor(row), y);
    });
  }

  /// y += A^T A x for rows [first, last), which are read once.
  /// \return the sum of the squares of A x.
  Value AddGram(int first, int last, const Value* x, Value* y) const
  {
    Value squares(0);
    this->ForRows(first, last, [&](int, const int* columns, const Value* values, auto length) {
      const Value product = Product(columns, values, length, x);
      AddMultiple(columns, values, length, product, y);
      squares += product * product;
    });
    return squares;
  }

  /// Calls visit(row, columns, values, length) for rows [first, last), ascending; short lengths are integral
  /// constants.
  template <class Visit>
  void ForRows(int first, int last, const Visit& visit) const
  {
    auto run = std::upper_bound(this->Runs.begin(), this->Runs.end(), first,
      [](int row, const Run& candidate) { return row < candidate.End; });
    for (; first < last; first = (run++)->End)
    {
      const int end = std::min(run->End, last);
      WithLength(run->Length,
        [&](auto length) { this->ForRowsOfRun(first, end, length, visit); },
        std::make_integer_sequence<int, LongestUnrolled + 1>());
    }
  }

private:
  struct Run
  {
    int End;
    int Length;
  };

  static constexpr int LongestUnrolled = 8;

  template <class Length>
  static Value Product(const int* columns, const Value* values, Length length, const Value* x)
  {
    Value sum(0);
    for (int k = 0; k < length; ++k)
    {
      AddProduct(sum, values[k], x[columns[k]]);
    }
    return sum;
  }

  template <class Length>
  static void AddMultiple(
    const int* columns, const Value* values, Length length, Value factor, Value* y)
  {
    for (int k = 0; k < length; ++k)
    {
      AddProduct(y[columns[k]], values[k], factor);
    }
  }

  /// Calls visit(length), an integral constant if it is one of those.
  template <class Visit, int... Lengths>
  static void WithLength(
    int length, const Visit& visit, std::integer_sequence<int, Lengths...>)
  {
    if (!((length == Lengths && (visit(std::integral_constant<int, Lengths>()), true)) || ...))
    {
      visit(length);
    }
  }

  template <class Length, class Visit>
  void ForRowsOfRun(int first, int last, Length length, const Visit& visit) const
  {
    const int begin = this->A.outerIndexPtr()[first];
    const int* columns = this->A.innerIndexPtr() + begin;
    const Value* values = this->A.valuePtr() + begin;
    for (int row = first; row < last; ++row, columns += length, values += length)
    {
      visit(row, columns, values, length);
    }
  }

  const SparseMatrix<Value>& A;
  std::vector<Run> Runs;
};

}

#endif
