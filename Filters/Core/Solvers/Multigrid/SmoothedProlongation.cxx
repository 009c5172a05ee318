#include "Solvers/Multigrid/SmoothedProlongation.h"

#include "Support/SparseRows.h"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

constexpr double Damping = 2.0 / 3.0; // the largest eigenvalue of D^{-1} A is at most 2
constexpr double SmallestShare = 0.05;

/// One step for row i: fills \p sum with row i of (I - 2/3 D^{-1} A) P.
template <class Scalar>
void SmoothRow(const SparseMatrix<Scalar>& A, const SparseMatrix<Scalar>& P, int i, SparseSum<Scalar>& sum)
{
  double diagonal = 0.0;
  for (int k = A.outerIndexPtr()[i]; k < A.outerIndexPtr()[i + 1]; ++k)
  {
    if (A.innerIndexPtr()[k] == i)
    {
      diagonal = Eigen::numext::real(A.valuePtr()[k]);
    }
  }
  const auto addRow = [&P, &sum](int row, Scalar factor)
  {
    const int begin = P.outerIndexPtr()[row];
    const int size = P.outerIndexPtr()[row + 1] - begin;
    sum.Add(factor, P.innerIndexPtr() + begin, P.valuePtr() + begin, size);
  };
  sum.Clear();
  if (!(diagonal > 0.0))
  {
    addRow(i, Scalar(1.0));
    return;
  }
  const double factor = -Damping / diagonal;
  for (int k = A.outerIndexPtr()[i]; k < A.outerIndexPtr()[i + 1]; ++k)
  {
    const int column = A.innerIndexPtr()[k];
    addRow(column, (column == i ? 1.0 : 0.0) + factor * A.valuePtr()[k]);
  }
}

/// Appends the larger entries of a row, enlarged to make up for the smaller.
template <class Scalar>
void AppendTruncated(const SparseSum<Scalar>& sum, std::vector<double>& sizes, SparseRows<Scalar>& rows)
{
  sizes.clear();
  double all = 0.0;
  for (int k = 0; k < sum.Size(); ++k)
  {
    sizes.push_back(std::sqrt(Eigen::numext::abs2(sum.Values()[k])));
    all += sizes.back();
  }
  double kept = 0.0;
  const std::size_t begin = rows.Columns.size();
  for (int k = 0; k < sum.Size(); ++k)
  {
    if (sizes[k] > SmallestShare * all)
    {
      kept += sizes[k];
      rows.Columns.push_back(sum.Indices()[k]);
    }
  }
  SortIndices(rows.Columns.data() + begin, static_cast<int>(rows.Columns.size() - begin));
  for (std::size_t k = begin; k < rows.Columns.size(); ++k)
  {
    rows.Values.push_back(sum[rows.Columns[k]] * (all / kept));
  }
  rows.EndRow();
}

template <class Scalar>
SparseMatrix<Scalar> Step(const SparseMatrix<Scalar>& A, const SparseMatrix<Scalar>& P, const ExecutionContext& context)
{
  const int columns = static_cast<int>(P.cols());
  const auto makeWorker = [&A, &P, columns]
  {
    return [&A, &P, sum = SparseSum<Scalar>(columns), sizes = std::vector<double>()](
             int firstRow, int lastRow, SparseRows<Scalar>& rows) mutable
    {
      for (int i = firstRow; i < lastRow; ++i)
      {
        SmoothRow(A, P, i, sum);
        AppendTruncated(sum, sizes, rows);
      }
    };
  };
  return AssembleInBands<Scalar>(static_cast<int>(P.rows()), columns, makeWorker, context);
}

}

template <class Scalar>
void SmoothProlongation(
  const SparseMatrix<Scalar>& A, SparseMatrix<Scalar>& P, int steps, const ExecutionContext& context)
{
  assert(A.rows() == A.cols() && A.cols() == P.rows());
  for (int step = 0; step < steps; ++step)
  {
    SparseMatrix<Scalar> next = Step(A, P, context);
    P.swap(next); // an assignment would copy
  }
}

template void SmoothProlongation(const SparseMatrix<double>&, SparseMatrix<double>&, int, const ExecutionContext&);
template void SmoothProlongation(const SparseMatrix<Complex>&, SparseMatrix<Complex>&, int, const ExecutionContext&);

}
