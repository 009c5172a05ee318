#include "Prolongation/TransportOperator.h"

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

}
