#ifndef dmgRowRuns_h
#define dmgRowRuns_h

#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <algorithm>
#include <vector>

namespace dmg
{

/// A matrix of short rows, where rows of equal length follow each other, as in the order of a Colouring:
/// products with a known number of entries per row take two thirds of the time.
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
    auto run = std::upper_bound(this->Runs.begin(), this->Runs.end(), first,
      [](int row, const Run& candidate) { return row < candidate.End; });
    for (; first < last; first = (run++)->End)
    {
      const int end = std::min(run->End, last);
      switch (run->Length)
      {
        case 0:
          this->MultiplyRun<0>(first, end, x, visit);
          break;
        case 1:
          this->MultiplyRun<1>(first, end, x, visit);
          break;
        case 2:
          this->MultiplyRun<2>(first, end, x, visit);
          break;
        case 3:
          this->MultiplyRun<3>(first, end, x, visit);
          break;
        case 4:
          this->MultiplyRun<4>(first, end, x, visit);
          break;
        default:
          for (int row = first; row < end; ++row)
          {
            visit(row, RowTimes(this->A, row, x));
          }
          break;
      }
    }
  }

private:
  struct Run
  {
    int End;
    int Length;
  };

  template <int Length, class Visit>
  void MultiplyRun(int first, int last, const Value* x, const Visit& visit) const
  {
    const int begin = this->A.outerIndexPtr()[first];
    const int* columns = this->A.innerIndexPtr() + begin;
    const Value* values = this->A.valuePtr() + begin;
    for (int row = first; row < last; ++row, columns += Length, values += Length)
    {
      Value sum(0);
      for (int k = 0; k < Length; ++k)
      {
        AddProduct(sum, values[k], x[columns[k]]);
      }
      visit(row, sum);
    }
  }

  const SparseMatrix<Value>& A;
  std::vector<Run> Runs;
};

}

#endif
