#ifndef dmgRowRuns_h
#define dmgRowRuns_h

#include "Solvers/Kernels/Packs.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace dmg
{

/// The entries of a row. \tparam Length an int, or an integral constant.
template <class Value, class Length>
struct ShortRow
{
  const int* Columns;
  const Value* Values;
  Length Size;

  Value Times(const Value* x) const
  {
    if constexpr (std::is_same_v<Length, int>)
    {
      return EntriesTimes(this->Columns, this->Values, this->Size, x);
    }
    Value sum(0);
    for (int k = 0; k < this->Size; ++k)
    {
      AddProduct(sum, this->Values[k], x[this->Columns[k]]);
    }
    return sum;
  }

  /// y += factor times the row.
  void AddTo(Value* y, Value factor) const
  {
    for (int k = 0; k < this->Size; ++k)
    {
      AddProduct(y[this->Columns[k]], this->Values[k], factor);
    }
  }
};

/// The entries of a row whose columns are pairs of neighbours, as the two components in a face are.
/// \tparam Length of the pairs.
template <class Length>
struct PairedRow
{
  const int* Columns;
  const double* Values;
  Length Size; ///< pairs

  double Times(const double* x) const
  {
    DoublePack sums{};
    for (int k = 0; k < this->Size; ++k)
    {
      sums += LoadPack<DoublePack>(this->Values + 2 * k) * LoadPack<DoublePack>(x + this->Columns[2 * k]);
    }
    return sums[0] + sums[1];
  }

  void AddTo(double* y, double factor) const
  {
    const DoublePack factors = { factor, factor };
    for (int k = 0; k < this->Size; ++k)
    {
      double* const pair = y + this->Columns[2 * k];
      StorePack(LoadPack<DoublePack>(pair) + LoadPack<DoublePack>(this->Values + 2 * k) * factors, pair);
    }
  }
};

/// A matrix of short rows, sorted in runs of equal length. Loops over a known number of entries are unrolled, and branch prediction
/// serves the others. Pairs of neighbouring real entries are processed together.
template <class Value>
class RowRuns
{
public:
  /// \param matrix borrowed.
  explicit RowRuns(const SparseMatrix<Value>& matrix)
    : A(matrix)
  {
    for (int row = 0; row < static_cast<int>(matrix.rows()); ++row)
    {
      const int length = matrix.outerIndexPtr()[row + 1] - matrix.outerIndexPtr()[row];
      if (this->Runs.empty() || this->Runs.back().Length != length)
      {
        this->Runs.push_back({ row, length, HasPairs });
      }
      Run& run = this->Runs.back();
      run.End = row + 1;
      run.ArePairs = run.ArePairs && ArePairs(matrix.innerIndexPtr() + matrix.outerIndexPtr()[row], length);
    }
  }

  /// Calls visit(row, product of the row and x) for rows [first, last), ascending.
  /// The visitor may change entries of x, which the rows after it will see.
  template <class Visit>
  void Multiply(int first, int last, const Value* x, const Visit& visit) const
  {
    this->ForRows(first, last, [&](int row, const auto& entries) { visit(row, entries.Times(x)); });
  }

  /// y += A^T u for rows [first, last), where u_row = factor(row).
  template <class Factor>
  void AddAdjoint(int first, int last, const Factor& factor, Value* y) const
  {
    this->ForRows(first, last, [&](int row, const auto& entries) { entries.AddTo(y, factor(row)); });
  }

  /// y += A^T A x for rows [first, last), which are read once.
  /// \return the sum of the squares of A x.
  Value AddGram(int first, int last, const Value* x, Value* y) const
  {
    Value squares(0);
    this->ForRows(first, last,
      [&](int, const auto& entries)
      {
        const Value product = entries.Times(x);
        entries.AddTo(y, product);
        squares += product * product;
      });
    return squares;
  }

  /// Calls visit(row, its entries) for rows [first, last), ascending.
  template <class Visit>
  void ForRows(int first, int last, const Visit& visit) const
  {
    auto run = std::upper_bound(
      this->Runs.begin(), this->Runs.end(), first, [](int row, const Run& candidate) { return row < candidate.End; });
    for (; first < last; first = (run++)->End)
    {
      const int end = std::min(run->End, last);
      if constexpr (HasPairs)
      {
        if (run->ArePairs)
        {
          WithLength(run->Length / 2,
            [&](auto pairs) { this->ForRowsOfRun<PairedRow<decltype(pairs)>>(first, end, pairs, 2 * pairs, visit); });
          continue;
        }
      }
      WithLength(run->Length,
        [&](auto length) { this->ForRowsOfRun<ShortRow<Value, decltype(length)>>(first, end, length, length, visit); });
    }
  }

private:
  struct Run
  {
    int End;
    int Length;
    bool ArePairs; ///< in all of its rows
  };

  static constexpr bool HasPairs = std::is_same_v<Value, double>;
  static constexpr int LongestUnrolled = 8;

  static bool ArePairs(const int* columns, int length)
  {
    bool arePairs = length % 2 == 0;
    for (int k = 0; arePairs && k < length; k += 2)
    {
      arePairs = columns[k + 1] == columns[k] + 1;
    }
    return arePairs;
  }

  /// Calls visit(length), an integral constant if it is short.
  template <class Visit>
  static void WithLength(int length, const Visit& visit)
  {
    WithLength(length, visit, std::make_integer_sequence<int, LongestUnrolled + 1>());
  }
  template <class Visit, int... Lengths>
  static void WithLength(int length, const Visit& visit, std::integer_sequence<int, Lengths...>)
  {
    if (!((length == Lengths && (visit(std::integral_constant<int, Lengths>()), true)) || ...))
    {
      visit(length);
    }
  }

  template <class Entries, class Size, class Visit>
  void ForRowsOfRun(int first, int last, Size size, int length, const Visit& visit) const
  {
    const int begin = this->A.outerIndexPtr()[first];
    Entries entries = { this->A.innerIndexPtr() + begin, this->A.valuePtr() + begin, size };
    for (int row = first; row < last; ++row, entries.Columns += length, entries.Values += length)
    {
      visit(row, entries);
    }
  }

  const SparseMatrix<Value>& A;
  std::vector<Run> Runs;
};

}

#endif
