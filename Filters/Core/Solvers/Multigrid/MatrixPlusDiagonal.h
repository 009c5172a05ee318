#ifndef dmgMatrixPlusDiagonal_h
#define dmgMatrixPlusDiagonal_h

#include "Solvers/Kernels/SparseDiagonal.h"
#include "Solvers/Multigrid/StiffnessHierarchy.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"
#include "Support/Types.h"

#include <type_traits>

namespace dmg
{

/// Real unknowns of a row.
template <class Scalar>
constexpr int PartsOf = std::is_same<Scalar, Complex>::value ? 2 : 1;

template <class Scalar>
const Scalar* AsRows(const Vector<double>& unknowns)
{
  return reinterpret_cast<const Scalar*>(unknowns.data());
}

template <class Scalar>
Scalar* AsRows(Vector<double>& unknowns)
{
  return reinterpret_cast<Scalar*>(unknowns.data());
}

/// A matrix on real unknowns: a complex entry z becomes the rows (re z, -im z) and (im z, re z).
template <class Scalar>
SparseMatrix<double> OnRealUnknowns(const SparseMatrix<Scalar>& A, const ExecutionContext& context)
{
  if constexpr (PartsOf<Scalar> == 1)
  {
    return A;
  }
  else
  {
    const int* const offsets = A.outerIndexPtr();
    return FillRows<double>(
      2 * static_cast<int>(A.rows()), 2 * static_cast<int>(A.cols()), context,
      [offsets](int row) { return 2 * (offsets[row / 2 + 1] - offsets[row / 2]); },
      [&A, offsets](int row, int* columns, double* values)
      {
        for (int e = offsets[row / 2]; e < offsets[row / 2 + 1]; ++e)
        {
          const Complex z = A.valuePtr()[e];
          *columns++ = 2 * A.innerIndexPtr()[e];
          *columns++ = 2 * A.innerIndexPtr()[e] + 1;
          *values++ = row % 2 == 0 ? z.real() : z.imag();
          *values++ = row % 2 == 0 ? -z.imag() : z.real();
        }
      });
  }
}

/// A preconditioner of complex vectors on their real unknowns.
class PreconditionerOnPairs : public Preconditioner<double>
{
public:
  /// \param ofComplex is borrowed.
  explicit PreconditionerOnPairs(Preconditioner<Complex>& ofComplex)
    : OfComplex(ofComplex)
  {
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override
  {
    this->Right = Eigen::Map<const Vector<Complex>>(AsRows<Complex>(r), r.size() / 2);
    this->OfComplex.Apply(this->Right, this->Solution, context);
    z = Eigen::Map<const Vector<double>>(reinterpret_cast<const double*>(this->Solution.data()), r.size());
  }

private:
  Preconditioner<Complex>& OfComplex;
  Vector<Complex> Right;
  Vector<Complex> Solution;
};

/// R + D as operator on real unknowns, where R is a matrix.
template <class Scalar>
class MatrixPlusDiagonal : public StiffnessOperator
{
public:
  /// \param matrix Hermitian; borrowed.
  explicit MatrixPlusDiagonal(const SparseMatrix<Scalar>& matrix)
    : R(matrix)
  {
  }

  int Size() const override { return PartsOf<Scalar> * static_cast<int>(this->R.rows()); }

  void SetDiagonal(const Vector<double>& diagonal, const ExecutionContext& context) override
  {
    this->D = SparseDiagonal(diagonal, context);
  }

  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override
  {
    y.resize(x.size());
    const Scalar* const from = AsRows<Scalar>(x);
    Scalar* const to = AsRows<Scalar>(y);
    const double ofR = SumOverBlocks<double>(static_cast<int>(this->R.rows()), context,
      [this, from, to](int first, int last)
      {
        double product = 0.0;
        for (int i = first; i < last; ++i)
        {
          to[i] = RowTimes(this->R, i, from);
          product += Eigen::numext::real(Eigen::numext::conj(from[i]) * to[i]);
        }
        return product;
      });
    return ofR + this->D.AddProduct(x, y, context);
  }

private:
  const SparseMatrix<Scalar>& R;
  SparseDiagonal D;
};

}

#endif
