#ifndef dmgSparseDiagonal_h
#define dmgSparseDiagonal_h

#include "Support/CountingSort.h"
#include "Support/ExecutionContext.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <cmath>
#include <vector>

namespace dmg
{

/// A diagonal matrix D >= 0 that is zero in most places. Infinite entries hold unknowns at zero.
class SparseDiagonal
{
public:
  /// Zero.
  SparseDiagonal() = default;
  SparseDiagonal(const Vector<double>& D, const ExecutionContext& context)
    : Indices(Choose(
        static_cast<int>(D.size()), [&D](int i) { return D[i] != 0.0; }, context))
    , Values(D(this->Indices))
  {
  }

  /// y += D x, and zero where unknowns are held.
  /// \return x^T D x, where unknowns are not held.
  double AddProduct(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const
  {
    return SumOverBlocks<double>(static_cast<int>(this->Indices.size()), context,
      [this, &x, &y](int first, int last)
      {
        double product = 0.0;
        for (int k = first; k < last; ++k)
        {
          const int i = this->Indices[k];
          const double value = this->Values[k];
          const double term = std::isfinite(value) ? value * x[i] : 0.0;
          y[i] = std::isfinite(value) ? y[i] + term : 0.0;
          product += x[i] * term;
        }
        return product;
      });
  }

private:
  std::vector<int> Indices;
  Vector<double> Values;
};

}

#endif
