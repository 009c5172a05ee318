#include "Support/SparseKernels.h"

#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/SparseRows.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace dmg
{
namespace
{

constexpr int RowGrain = 4096;

}

int OffsetsFromCounts(int* counts, int size)
{
  long long total = 0;
  counts[0] = 0;
  for (int i = 1; i < size; ++i)
  {
    total += counts[i];
    if (total > std::numeric_limits<int>::max())
    {
      throw InvalidInput(
        "a sparse matrix would have more than 2147483647 non-zeros; " + TextOf(Remedy::FewerTriangles));
    }
    counts[i] = static_cast<int>(total);
  }
  return static_cast<int>(total);
}

template <class Scalar>
void Multiply(
  const SparseMatrix<Scalar>& A, const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext& context)
{
  assert(A.isCompressed() && x.size() == A.cols());
  y.resize(A.rows());
  context.ParallelFor(0, static_cast<int>(A.rows()), RowGrain,
    [&A, &x, &y](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        y[i] = RowTimes(A, i, x.data());
      }
    });
}

template <class Scalar>
Scalar Dot(const Vector<Scalar>& x, const Vector<Scalar>& y, const ExecutionContext& context)
{
  return SumOverBlocks<Scalar>(static_cast<int>(x.size()), context,
    [&x, &y](int first, int last) -> Scalar
    { return x.segment(first, last - first).dot(y.segment(first, last - first)); });
}

template <class Scalar>
double SquaredNorm(const Vector<Scalar>& x, const ExecutionContext& context)
{
  return SumOverBlocks<double>(static_cast<int>(x.size()), context,
    [&x](int first, int last) { return x.segment(first, last - first).squaredNorm(); });
}

template <class Scalar>
SparseMatrix<Scalar> Adjoint(const SparseMatrix<Scalar>& A, const ExecutionContext& context)
{
  assert(A.isCompressed());
  const int rows = static_cast<int>(A.rows());
  const int columns = static_cast<int>(A.cols());
  const int* const offsetsOfA = A.outerIndexPtr();
  const int* const columnsOfA = A.innerIndexPtr();

  // Bands of rows of A are counted and scattered side by side. Each band's part of a row of the
  // adjoint follows that of the band before it, so the result does not depend on their number.
  const int numberOfBands = A.nonZeros() < RowGrain ? 1 : std::min(context.NumberOfThreads(), 16);
  std::vector<std::vector<int>> places(numberOfBands); // by column of A: first counts, then where entries go
  const auto forBands = [&](const auto& visit)
  {
    const auto begin = [&](int band) { return static_cast<int>(static_cast<long long>(rows) * band / numberOfBands); };
    context.ParallelFor(0, numberOfBands, 1,
      [&](int first, int last)
      {
        for (int band = first; band < last; ++band)
        {
          visit(places[band], begin(band), begin(band + 1));
        }
      });
  };
  forBands(
    [=](std::vector<int>& counts, int firstRow, int lastRow)
    {
      counts.assign(columns, 0);
      std::for_each(columnsOfA + offsetsOfA[firstRow], columnsOfA + offsetsOfA[lastRow],
        [&counts](int column) { ++counts[column]; });
    });

  SparseMatrix<Scalar> adjoint(columns, rows);
  adjoint.resizeNonZeros(A.nonZeros());
  int next = 0;
  for (int j = 0; j < columns; ++j)
  {
    adjoint.outerIndexPtr()[j] = next;
    for (std::vector<int>& ofBand : places)
    {
      next += std::exchange(ofBand[j], next);
    }
  }
  adjoint.outerIndexPtr()[columns] = next;

  forBands(
    [&](std::vector<int>& ofBand, int firstRow, int lastRow)
    {
      for (int i = firstRow; i < lastRow; ++i)
      {
        for (int k = offsetsOfA[i]; k < offsetsOfA[i + 1]; ++k)
        {
          const int to = ofBand[columnsOfA[k]]++;
          adjoint.innerIndexPtr()[to] = i;
          adjoint.valuePtr()[to] = Eigen::numext::conj(A.valuePtr()[k]);
        }
      }
    });
  return adjoint;
}

template <class Scalar>
SparseMatrix<Scalar> SymmetricFromLower(const SparseMatrix<Scalar>& lower, const ExecutionContext& context)
{
  const int rows = static_cast<int>(lower.rows());
  const SparseMatrix<Scalar> upper = Adjoint(lower, context);
  const int* const offsetsOfLower = lower.outerIndexPtr();
  const int* const offsetsOfUpper = upper.outerIndexPtr();
  // The diagonal is the first entry of a row of the upper triangle, if there.
  const auto beyondDiagonal = [&](int i)
  {
    const int begin = offsetsOfUpper[i];
    return begin + (begin < offsetsOfUpper[i + 1] && upper.innerIndexPtr()[begin] == i);
  };
  SparseMatrix<Scalar> A(rows, rows);
  MakeRoom(A, context,
    [&](int i) { return offsetsOfLower[i + 1] - offsetsOfLower[i] + offsetsOfUpper[i + 1] - beyondDiagonal(i); });
  context.ParallelFor(0, rows, RowGrain,
    [&](int first, int last)
    {
      const auto copy = [](const SparseMatrix<Scalar>& from, int begin, int end, SparseMatrix<Scalar>& to, int at)
      {
        std::copy(from.innerIndexPtr() + begin, from.innerIndexPtr() + end, to.innerIndexPtr() + at);
        std::copy(from.valuePtr() + begin, from.valuePtr() + end, to.valuePtr() + at);
        return at + end - begin;
      };
      for (int i = first; i < last; ++i)
      {
        const int at = copy(lower, offsetsOfLower[i], offsetsOfLower[i + 1], A, A.outerIndexPtr()[i]);
        copy(upper, beyondDiagonal(i), offsetsOfUpper[i + 1], A, at);
      }
    });
  return A;
}

template <class Scalar>
SparseMatrix<Scalar> Permuted(const SparseMatrix<Scalar>& A, const std::vector<int>& rowOrder,
  const std::vector<int>& columnPlaces, const ExecutionContext& context)
{
  assert(A.isCompressed());
  const int rows = static_cast<int>(rowOrder.size());
  const int* offsetsOfA = A.outerIndexPtr();
  const int* columnsOfA = A.innerIndexPtr();
  const Scalar* valuesOfA = A.valuePtr();
  SparseMatrix<Scalar> B(rows, A.cols());
  MakeRoom(
    B, context, [offsetsOfA, &rowOrder](int k) { return offsetsOfA[rowOrder[k] + 1] - offsetsOfA[rowOrder[k]]; });
  const int* offsets = B.outerIndexPtr();
  int* columns = B.innerIndexPtr();
  Scalar* values = B.valuePtr();
  context.ParallelFor(0, rows, RowGrain,
    [=, &rowOrder, &columnPlaces](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        int end = offsets[k];
        const int i = rowOrder[k];
        for (int m = offsetsOfA[i]; m < offsetsOfA[i + 1]; ++m, ++end)
        {
          const int column = columnPlaces[columnsOfA[m]];
          int place = end;
          for (; place > offsets[k] && columns[place - 1] > column; --place)
          {
            columns[place] = columns[place - 1];
            values[place] = values[place - 1];
          }
          columns[place] = column;
          values[place] = valuesOfA[m];
        }
      }
    });
  return B;
}

template <class Scalar>
SparseMatrix<Scalar> TripleProduct(const SparseMatrix<Scalar>& R, const SparseMatrix<Scalar>& A,
  const SparseMatrix<Scalar>& P, const ExecutionContext& context)
{
  assert(R.isCompressed() && A.isCompressed() && P.isCompressed());
  assert(R.cols() == A.rows() && A.cols() == P.rows());
  const int* offsetsOfR = R.outerIndexPtr();
  const int* columnsOfR = R.innerIndexPtr();
  const Scalar* valuesOfR = R.valuePtr();
  const int* offsetsOfA = A.outerIndexPtr();
  const int* columnsOfA = A.innerIndexPtr();
  const Scalar* valuesOfA = A.valuePtr();
  const int* offsetsOfP = P.outerIndexPtr();
  const int* columnsOfP = P.innerIndexPtr();
  const Scalar* valuesOfP = P.valuePtr();
  const int rowsOfA = static_cast<int>(A.rows());
  const int columns = static_cast<int>(P.cols());

  const auto makeWorker = [=]
  {
    return [=, rowsOfAP = IndexSet(rowsOfA), AP = SparseRows<Scalar>(), sum = SparseSum<Scalar>(columns)](
             int firstRow, int lastRow, SparseRows<Scalar>& result) mutable
    {
      rowsOfAP.Clear();
      AP.Clear();
      for (int k = offsetsOfR[firstRow]; k < offsetsOfR[lastRow]; ++k)
      {
        const int i = columnsOfR[k];
        if (rowsOfAP.Find(i) < rowsOfAP.Size())
        {
          continue;
        }
        rowsOfAP.Append(i);
        sum.Clear();
        for (int m = offsetsOfA[i]; m < offsetsOfA[i + 1]; ++m)
        {
          const int begin = offsetsOfP[columnsOfA[m]];
          const int size = offsetsOfP[columnsOfA[m] + 1] - begin;
          sum.Add(valuesOfA[m], columnsOfP + begin, valuesOfP + begin, size);
        }
        AP.Columns.insert(AP.Columns.end(), sum.Indices(), sum.Indices() + sum.Size());
        AP.Values.insert(AP.Values.end(), sum.Values(), sum.Values() + sum.Size());
        AP.EndRow();
      }
      for (int row = firstRow; row < lastRow; ++row)
      {
        sum.Clear();
        for (int k = offsetsOfR[row]; k < offsetsOfR[row + 1]; ++k)
        {
          const int i = rowsOfAP.Find(columnsOfR[k]);
          const int begin = AP.Offsets[i];
          const int size = AP.Offsets[i + 1] - begin;
          sum.Add(valuesOfR[k], AP.Columns.data() + begin, AP.Values.data() + begin, size);
        }
        sum.AppendTo(result);
      }
    };
  };
  return AssembleInBands<Scalar>(static_cast<int>(R.rows()), columns, makeWorker, context);
}

template <class Scalar>
SparseMatrix<Complex> Product(
  const SparseMatrix<Scalar>& A, const SparseMatrix<Complex>& B, const ExecutionContext& context)
{
  assert(A.cols() == B.rows());
  const auto makeWorker = [&]
  {
    return [&, sum = SparseSum<Complex>(static_cast<int>(B.cols()))](
             int firstRow, int lastRow, SparseRows<Complex>& rows) mutable
    {
      for (int i = firstRow; i < lastRow; ++i)
      {
        sum.Clear();
        for (int e = A.outerIndexPtr()[i]; e < A.outerIndexPtr()[i + 1]; ++e)
        {
          const int row = A.innerIndexPtr()[e];
          const int begin = B.outerIndexPtr()[row];
          sum.Add(A.valuePtr()[e], B.innerIndexPtr() + begin, B.valuePtr() + begin, B.outerIndexPtr()[row + 1] - begin);
        }
        sum.AppendTo(rows);
      }
    };
  };
  return AssembleInBands<Complex>(static_cast<int>(A.rows()), static_cast<int>(B.cols()), makeWorker, context);
}

template SparseMatrix<Complex> Product(
  const SparseMatrix<double>&, const SparseMatrix<Complex>&, const ExecutionContext&);
template SparseMatrix<Complex> Product(
  const SparseMatrix<Complex>&, const SparseMatrix<Complex>&, const ExecutionContext&);

template <class Scalar>
SparseMatrix<Scalar> NormalMatrix(const SparseMatrix<Scalar>& B, const ExecutionContext& context)
{
  const SparseMatrix<Scalar> adjoint = Adjoint(B, context);
  const int columns = static_cast<int>(B.cols());
  const auto makeWorker = [&, columns]
  {
    return [&, sum = SparseSum<Scalar>(columns)](int firstRow, int lastRow, SparseRows<Scalar>& result) mutable
    {
      for (int i = firstRow; i < lastRow; ++i)
      {
        sum.Clear();
        for (int e = adjoint.outerIndexPtr()[i]; e < adjoint.outerIndexPtr()[i + 1]; ++e)
        {
          const int row = adjoint.innerIndexPtr()[e];
          const int begin = B.outerIndexPtr()[row];
          sum.Add(
            adjoint.valuePtr()[e], B.innerIndexPtr() + begin, B.valuePtr() + begin, B.outerIndexPtr()[row + 1] - begin);
        }
        sum.AppendTo(result);
      }
    };
  };
  return AssembleInBands<Scalar>(columns, columns, makeWorker, context);
}

template SparseMatrix<double> NormalMatrix(const SparseMatrix<double>&, const ExecutionContext&);
template SparseMatrix<Complex> NormalMatrix(const SparseMatrix<Complex>&, const ExecutionContext&);
template void Multiply(const SparseMatrix<double>&, const Vector<double>&, Vector<double>&, const ExecutionContext&);
template void Multiply(const SparseMatrix<Complex>&, const Vector<Complex>&, Vector<Complex>&, const ExecutionContext&);
template double Dot(const Vector<double>&, const Vector<double>&, const ExecutionContext&);
template Complex Dot(const Vector<Complex>&, const Vector<Complex>&, const ExecutionContext&);
template double SquaredNorm(const Vector<double>&, const ExecutionContext&);
template double SquaredNorm(const Vector<Complex>&, const ExecutionContext&);
template SparseMatrix<double> Adjoint(const SparseMatrix<double>&, const ExecutionContext&);
template SparseMatrix<Complex> Adjoint(const SparseMatrix<Complex>&, const ExecutionContext&);
template SparseMatrix<float> Adjoint(const SparseMatrix<float>&, const ExecutionContext&);
template SparseMatrix<std::complex<float>> Adjoint(const SparseMatrix<std::complex<float>>&, const ExecutionContext&);
template SparseMatrix<double> SymmetricFromLower(const SparseMatrix<double>&, const ExecutionContext&);
template SparseMatrix<Complex> SymmetricFromLower(const SparseMatrix<Complex>&, const ExecutionContext&);
template SparseMatrix<double> Permuted(
  const SparseMatrix<double>&, const std::vector<int>&, const std::vector<int>&, const ExecutionContext&);
template SparseMatrix<Complex> Permuted(
  const SparseMatrix<Complex>&, const std::vector<int>&, const std::vector<int>&, const ExecutionContext&);
template SparseMatrix<double> TripleProduct(
  const SparseMatrix<double>&, const SparseMatrix<double>&, const SparseMatrix<double>&, const ExecutionContext&);
template SparseMatrix<Complex> TripleProduct(
  const SparseMatrix<Complex>&, const SparseMatrix<Complex>&, const SparseMatrix<Complex>&, const ExecutionContext&);

}
