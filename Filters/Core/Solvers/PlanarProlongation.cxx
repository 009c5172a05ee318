#include "Solvers/PlanarProlongation.h"

#include "Support/SparseRows.h"

#include <cmath>

namespace dmg
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// A sum of products of two plane vectors, all with all: the 2 x 2 matrix sum of a b^T.
struct OuterProducts
{
  OuterProducts() = default;
  explicit OuterProducts(int) {}
  double XX = 0.0;
  double XY = 0.0;
  double YX = 0.0;
  double YY = 0.0;
};

inline void AddProduct(OuterProducts& sum, Complex a, Complex b)
{
  sum.XX += a.real() * b.real();
  sum.XY += a.real() * b.imag();
  sum.YX += a.imag() * b.real();
  sum.YY += a.imag() * b.imag();
}

/// Power iterations on B^T B and a margin.
double LargestEigenvalue(const SparseMatrix<double>& B, const SparseMatrix<double>& Bt,
  const ExecutionContext& context)
{
  Vector<double> x(B.cols());
  for (Eigen::Index i = 0; i < x.size(); ++i)
  {
    x[i] = std::fmod(i * 0.6180339887498949, 1.0) - 0.5; // holds all frequencies
  }
  Vector<double> Bx(B.rows());
  double estimate = 1.0;
  for (int iteration = 0; iteration < 8; ++iteration)
  {
    const double norm = std::sqrt(SquaredNorm(x, context));
    if (!(norm > 0.0))
    {
      break;
    }
    x *= 1.0 / norm;
    Multiply(B, x, Bx, context);
    Multiply(Bt, Bx, x, context);
    estimate = std::sqrt(SquaredNorm(x, context));
  }
  return 1.1 * estimate;
}

/// Adds a multiple of row i of P.
void AddRow(SparseSum<Complex>& sum, double factor, const PlanarProlongation& P, int i)
{
  const int begin = P.outerIndexPtr()[i];
  sum.Add(factor, P.innerIndexPtr() + begin, P.valuePtr() + begin, P.outerIndexPtr()[i + 1] - begin);
}

/// Appends what is not small, columns ascending.
void AppendTruncated(const SparseSum<Complex>& sum, double dropped, SparseRows<Complex>& rows)
{
  double largest = 0.0;
  for (int k = 0; k < sum.Size(); ++k)
  {
    largest = std::max(largest, std::norm(sum.Values()[k]));
  }
  const std::size_t begin = rows.Columns.size();
  for (int k = 0; k < sum.Size(); ++k)
  {
    if (std::norm(sum.Values()[k]) > dropped * dropped * largest)
    {
      rows.Columns.push_back(sum.Indices()[k]);
    }
  }
  SortIndices(rows.Columns.data() + begin, static_cast<int>(rows.Columns.size() - begin));
  for (std::size_t k = begin; k < rows.Columns.size(); ++k)
  {
    rows.Values.push_back(sum[rows.Columns[k]]);
  }
  rows.EndRow();
}

/// P - factor B^T Q.
PlanarProlongation Corrected(const PlanarProlongation& P, double factor,
  const SparseMatrix<double>& Bt, const PlanarProlongation& Q, double dropped,
  const ExecutionContext& context)
{
  const auto makeWorker = [&, factor, dropped] {
    return [&, factor, dropped, sum = SparseSum<Complex>(static_cast<int>(P.cols()))](
             int firstRow, int lastRow, SparseRows<Complex>& rows) mutable {
      for (int i = firstRow; i < lastRow; ++i)
      {
        sum.Clear();
        AddRow(sum, 1.0, P, i);
        for (int e = Bt.outerIndexPtr()[i]; e < Bt.outerIndexPtr()[i + 1]; ++e)
        {
          AddRow(sum, -factor * Bt.valuePtr()[e], Q, Bt.innerIndexPtr()[e]);
        }
        AppendTruncated(sum, dropped, rows);
      }
    };
  };
  return AssembleInBands<Complex>(
    static_cast<int>(P.rows()), static_cast<int>(P.cols()), makeWorker, context);
}

}

PlanarProlongation SmoothedPlanar(const SparseMatrix<double>& B, const SparseMatrix<double>& Bt,
  PlanarProlongation P, int degree, double dropped, const ExecutionContext& context)
{
  if (degree == 0)
  {
    return P;
  }
  const double largest = LargestEigenvalue(B, Bt, context);
  for (int k = 1; k <= degree; ++k)
  {
    const double sine = std::sin(Pi * k / (2.0 * degree + 1.0));
    PlanarProlongation next =
      Corrected(P, 1.0 / (largest * sine * sine), Bt, Product(B, P, context), dropped, context);
    P.swap(next); // an assignment would copy
  }
  return P;
}

SparseMatrix<double> GramOfPlanar(const PlanarProlongation& Q, const ExecutionContext& context)
{
  const PlanarProlongation conjugate = Adjoint(Q, context); // its entries turn the other way
  const int columns = static_cast<int>(Q.cols());
  const auto makeWorker = [&, columns] {
    return [&, sum = SparseSum<OuterProducts>(columns), members = std::vector<int>()](
             int firstRow, int lastRow, SparseRows<double>& rows) mutable {
      for (int i = firstRow / 2; i < lastRow / 2; ++i)
      {
        sum.Clear();
        for (int e = conjugate.outerIndexPtr()[i]; e < conjugate.outerIndexPtr()[i + 1]; ++e)
        {
          const int row = conjugate.innerIndexPtr()[e];
          const int begin = Q.outerIndexPtr()[row];
          sum.Add(std::conj(conjugate.valuePtr()[e]), Q.innerIndexPtr() + begin,
            Q.valuePtr() + begin, Q.outerIndexPtr()[row + 1] - begin);
        }
        members.assign(sum.Indices(), sum.Indices() + sum.Size());
        SortIndices(members.data(), static_cast<int>(members.size()));
        for (const bool isY : { false, true })
        {
          for (const int j : members)
          {
            const OuterProducts& products = sum[j];
            rows.Columns.push_back(2 * j);
            rows.Columns.push_back(2 * j + 1);
            rows.Values.push_back(isY ? products.YX : products.XX);
            rows.Values.push_back(isY ? products.YY : products.XY);
          }
          rows.EndRow();
        }
      }
    };
  };
  return AssembleInBands<double>(2 * columns, 2 * columns, makeWorker, context);
}

}
