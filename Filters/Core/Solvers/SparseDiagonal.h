#ifndef dmgSparseDiagonal_h
#define dmgSparseDiagonal_h

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
  explicit SparseDiagonal(const Vector<double>& D)
    : Rows(static_cast<int>(D.size()))
  {
    for (int i = 0; i < this->Rows; ++i)
    {
      if (D[i] != 0.0)
      {
        this->Entries.push_back({ i, D[i] });
      }
    }
  }

  int Size() const { return this->Rows; }

  /// y += D x, and zero where unknowns are held.
  /// \return x^T D x.
  /// \pre x is zero where unknowns are held.
  double AddProduct(
    const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const
  {
    return SumOverBlocks<double>(
      static_cast<int>(this->Entries.size()), context, [this, &x, &y](int first, int last) {
        double product = 0.0;
        for (int k = first; k < last; ++k)
        {
          const auto& [i, value] = this->Entries[k];
          const double pull = std::isfinite(value) ? value * x[i] : 0.0;
          y[i] = std::isfinite(value) ? y[i] + pull : 0.0;
          product += x[i] * pull;
        }
        return product;
      });
  }

private:
  struct Entry
  {
    int Index;
    double Value;
  };

  int Rows;
  std::vector<Entry> Entries;
};

}

#endif
