#ifndef dmgTestBands_h
#define dmgTestBands_h

#include "Solvers/CompactProlongation.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"
#include "Support/SparseRows.h"

namespace dmg::test
{

template <class Scalar>
RowBands<Scalar> InBands(const SparseMatrix<Scalar>& A)
{
  const auto makeWorker = [&A] {
    return [&A](int firstRow, int lastRow, SparseRows<Scalar>& rows) {
      for (int i = firstRow; i < lastRow; ++i)
      {
        for (typename SparseMatrix<Scalar>::InnerIterator entry(A, i); entry; ++entry)
        {
          rows.Columns.push_back(static_cast<int>(entry.col()));
          rows.Values.push_back(entry.value());
        }
        rows.EndRow();
      }
    };
  };
  return AssembleBands<Scalar>(
    static_cast<int>(A.rows()), static_cast<int>(A.cols()), makeWorker, SerialContext());
}

inline CompactProlongation Compact(
  const SparseMatrix<Plane>& P, const ExecutionContext& context = SerialContext())
{
  return CompactProlongation(InBands(Adjoint(P, context)), context);
}

/// As they are after rounding.
inline SparseMatrix<Plane> AllRows(const CompactProlongation& P)
{
  return P.SelectedRows(Identity(P.Rows()), SerialContext());
}

}

#endif
