#ifndef dmgSplitMatrix_h
#define dmgSplitMatrix_h

#include "Solvers/Kernels/RowRuns.h"
#include "Solvers/Kernels/SweepOrder.h"
#include "Solvers/Kernels/TriangularParts.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"
#include "Support/Unfilled.h"

#include <complex>

namespace dmg
{

/// A Hermitian matrix of few entries per row, colour by colour, for sweeps in single precision and products
/// in double. Its entries are held once: rounded for the sweeps, and what rounding took from them, which
/// only products read (Dekker 1971). The two add up to the entry within 2^-49 of it. A matrix in double precision beside
/// the rounded one would take 6 % more memory on the median of 14 surfaces, and as long.
class SplitMatrix
{
public:
  using Single = std::complex<float>;

  SplitMatrix() = default;
  /// \param A Hermitian. Its entries must be within the range of single precision.
  /// \param colours of its unknowns, which stand in that order here.
  SplitMatrix(
    const SparseMatrix<Complex>& A, const SweepOrder& colours, const ExecutionContext& context);
  /// Eigen 3.4 would copy the matrices.
  SplitMatrix(SplitMatrix&& other) noexcept { this->Swap(other); }
  SplitMatrix& operator=(SplitMatrix&& other) noexcept
  {
    this->Swap(other);
    return *this;
  }

  int Size() const { return static_cast<int>(this->Diagonal.size()); }
  long long NonZeros() const 
  {
    return this->Size() + this->Rounded.Lower.nonZeros() + this->Rounded.Upper.nonZeros();
  }

  Vector<double> Diagonal;
  TriangularParts<Single> Rounded;

  /// What multiplies by the matrix in double precision.
  class Operator
  {
  public:
    /// \param matrix borrowed.
    explicit Operator(const SplitMatrix& matrix)
      : A(matrix)
      , Lower(matrix.Rounded.Lower)
      , Upper(matrix.Rounded.Upper)
    {
    }

    /// Rows [first, last) of y = A x. \return their part of Re x^H A x.
    double Multiply(int first, int last, const Complex* x, Complex* y) const;

  private:
    const SplitMatrix& A;
    const RowRuns<Single> Lower;
    const RowRuns<Single> Upper;
  };

  /// The matrix as it was, to rounding.
  SparseMatrix<Complex> Whole(const ExecutionContext& context) const;

  /// Held by this object.
  long long Bytes() const;

private:
  void Swap(SplitMatrix& other) noexcept;

  Unfilled<Single> RestsOfLower; ///< of each entry
  Unfilled<Single> RestsOfUpper;
};

}

#endif
