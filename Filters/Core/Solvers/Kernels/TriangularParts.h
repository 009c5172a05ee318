#ifndef dmgTriangularParts_h
#define dmgTriangularParts_h

#include "Solvers/Kernels/Packs.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <type_traits>
#include <vector>

namespace dmg
{

/// The strictly lower and the strictly upper triangle of a matrix, stored apart for Gauss-Seidel: half a product touches half
/// the memory. Columns of a row are in any order.
template <class Value>
struct TriangularParts
{
  std::vector<int> Begins;         ///< of the parts of its SweepOrder
  std::vector<int> ColoursOfTiles; ///< if those are tiles
  SparseMatrix<Value> Lower;
  SparseMatrix<Value> Upper;
  /// Columns come in pairs of an even one and the next, as the components of vectors do. Then a row has a zero on
  /// the diagonal in the part where the other unknown of its pair is.
  bool HavePairs = false;

  bool HaveTiles() const { return !this->ColoursOfTiles.empty(); }
  /// The product of row i of a part with x, which is finite.
  Value LowerTimes(int i, const Value* x) const { return this->Times(this->Lower, i, x); }
  Value UpperTimes(int i, const Value* x) const { return this->Times(this->Upper, i, x); }

private:
  Value Times(const SparseMatrix<Value>& part, int i, const Value* x) const
  {
    if constexpr (std::is_same_v<Value, float>)
    {
      if (this->HavePairs)
      {
        const int begin = part.outerIndexPtr()[i];
        return PairsTimes(
          part.innerIndexPtr() + begin, part.valuePtr() + begin, part.outerIndexPtr()[i + 1] - begin, x);
      }
    }
    return RowTimes(part, i, x);
  }

  /// \param size even.
  static float PairsTimes(const int* columns, const float* values, int size, const float* x)
  {
    FloatPack sums[2] = {};
    int k = 0;
    for (; k + 8 <= size; k += 8)
    {
      sums[0] += LoadPack<FloatPack>(values + k) * LoadPairs(x + columns[k], x + columns[k + 2]);
      sums[1] += LoadPack<FloatPack>(values + k + 4) * LoadPairs(x + columns[k + 4], x + columns[k + 6]);
    }
    float sum = 0.0f;
    for (; k < size; ++k)
    {
      sum += values[k] * x[columns[k]];
    }
    return sum + SumOfLanes(sums[0] + sums[1]);
  }
};

}

#endif
