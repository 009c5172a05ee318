#include "Levels/TransportOperator.h"

#include "Support/SparseAssembly.h"

#include <cmath>

namespace dmg
{
namespace
{

Complex OnPowers(Complex entry, int N)
{
  const double weight = std::sqrt(std::norm(entry));
  const Complex turn = N > 1 && weight > 0.0 ? entry / weight : Complex(1.0);
  for (int n = 1; n < N; ++n)
  {
    entry *= turn;
  }
  return entry;
}

}

SparseMatrix<Complex> OnPowers(const TransportOperator& transport, int N, const ExecutionContext& context)
{
  const int* const offsets = transport.outerIndexPtr();
  return FillRows<Complex>(
    static_cast<int>(transport.rows()), static_cast<int>(transport.cols()), context,
    [offsets](int row) { return offsets[row + 1] - offsets[row]; },
    [&](int row, int* columns, Complex* values)
    {
      for (int i = offsets[row]; i < offsets[row + 1]; ++i)
      {
        *columns++ = transport.innerIndexPtr()[i];
        *values++ = OnPowers(transport.valuePtr()[i], N);
      }
    });
}

SparseMatrix<Complex> RowsOfComponents(const TransportOperator& transport, const ExecutionContext& context)
{
  const int* const offsets = transport.outerIndexPtr();
  const auto sizeOf = [offsets](int row) { return offsets[row / 2 + 1] - offsets[row / 2]; };
  return FillRows<Complex>(2 * static_cast<int>(transport.rows()), static_cast<int>(transport.cols()), context, sizeOf,
    [&](int row, int* columns, Complex* values)
    {
      // The components of w z are the real parts of w z and -i w z.
      const Complex component = row % 2 == 0 ? Complex(1.0, 0.0) : Complex(0.0, 1.0);
      for (int i = offsets[row / 2]; i < offsets[row / 2 + 1]; ++i)
      {
        *columns++ = transport.innerIndexPtr()[i];
        *values++ = component * std::conj(transport.valuePtr()[i]);
      }
    });
}

SparseMatrix<double> OnComponents(const TransportOperator& transport, const ExecutionContext& context)
{
  const int* const offsets = transport.outerIndexPtr();
  const auto sizeOf = [offsets](int row) { return 2 * (offsets[row / 2 + 1] - offsets[row / 2]); };
  return FillRows<double>(2 * static_cast<int>(transport.rows()), 2 * static_cast<int>(transport.cols()), context,
    sizeOf,
    [&](int row, int* columns, double* values)
    {
      for (int i = offsets[row / 2]; i < offsets[row / 2 + 1]; ++i)
      {
        const int column = transport.innerIndexPtr()[i];
        const Complex z = transport.valuePtr()[i];
        *columns++ = 2 * column;
        *columns++ = 2 * column + 1;
        *values++ = row % 2 == 0 ? z.real() : z.imag();
        *values++ = row % 2 == 0 ? -z.imag() : z.real();
      }
    });
}

std::vector<SparseMatrix<Complex>> OnPowers(
  const std::vector<TransportOperator>& transports, int N, const ExecutionContext& context)
{
  std::vector<SparseMatrix<Complex>> result(transports.size());
  for (std::size_t level = 0; level < transports.size(); ++level)
  {
    SparseMatrix<Complex> powers = OnPowers(transports[level], N, context);
    result[level].swap(powers); // an assignment would copy
  }
  return result;
}

std::vector<SparseMatrix<double>> OnComponents(
  const std::vector<TransportOperator>& transports, const ExecutionContext& context)
{
  std::vector<SparseMatrix<double>> result(transports.size());
  for (std::size_t level = 0; level < transports.size(); ++level)
  {
    SparseMatrix<double> components = OnComponents(transports[level], context);
    result[level].swap(components); // an assignment would copy
  }
  return result;
}

}
