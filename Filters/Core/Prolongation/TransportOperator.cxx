#include "Prolongation/TransportOperator.h"

#include "Support/SparseAssembly.h"

#include <cmath>

namespace dmg
{

SparseMatrix<Complex> OnPowers(
  const TransportOperator& transport, int N, const ExecutionContext& context)
{
  constexpr int Grain = 16384;
  SparseMatrix<Complex> result = transport;
  Complex* const entries = result.valuePtr();
  const int size = N > 1 ? static_cast<int>(result.nonZeros()) : 0;
  context.ParallelFor(0, size, Grain, [=](int first, int last) {
    for (int i = first; i < last; ++i)
    {
      const double weight = std::sqrt(std::norm(entries[i]));
      const Complex turn = weight > 0.0 ? entries[i] / weight : Complex(1.0);
      for (int n = 1; n < N; ++n)
      {
        entries[i] *= turn;
      }
    }
  });
  return result;
}

SparseMatrix<Complex> RowsOfComponents(
  const TransportOperator& transport, const ExecutionContext& context)
{
  const int* const offsets = transport.outerIndexPtr();
  const auto sizeOf = [offsets](int row) { return offsets[row / 2 + 1] - offsets[row / 2]; };
  return FillRows<Complex>(2 * static_cast<int>(transport.rows()),
    static_cast<int>(transport.cols()), context, sizeOf,
    [&](int row, int* columns, Complex* values) {
      // The components of w z are the real parts of w z and -i w z.
      const Complex component = row % 2 == 0 ? Complex(1.0, 0.0) : Complex(0.0, 1.0);
      for (int i = offsets[row / 2]; i < offsets[row / 2 + 1]; ++i)
      {
        *columns++ = transport.innerIndexPtr()[i];
        *values++ = component * std::conj(transport.valuePtr()[i]);
      }
    });
}

SparseMatrix<double> OnComponents(
  const TransportOperator& transport, const ExecutionContext& context)
{
  const int* const offsets = transport.outerIndexPtr();
  const auto sizeOf = [offsets](int row) { return 2 * (offsets[row / 2 + 1] - offsets[row / 2]); };
  return FillRows<double>(2 * static_cast<int>(transport.rows()),
    2 * static_cast<int>(transport.cols()), context, sizeOf,
    [&](int row, int* columns, double* values) {
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

}
