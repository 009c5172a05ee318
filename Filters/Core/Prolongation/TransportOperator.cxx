#include "Prolongation/TransportOperator.h"

namespace dmg
{

SparseMatrix<Complex> OnPowers(const TransportOperator& transport, int N)
{
  SparseMatrix<Complex> result = transport;
  for (Eigen::Index i = 0; i < result.nonZeros() && N > 1; ++i)
  {
    Complex& entry = result.valuePtr()[i];
    const double weight = std::abs(entry);
    const Complex turn = weight > 0.0 ? entry / weight : 1.0;
    for (int n = 1; n < N; ++n)
    {
      entry *= turn;
    }
  }
  return result;
}

}
