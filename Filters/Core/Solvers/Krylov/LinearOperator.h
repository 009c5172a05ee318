#ifndef dmgLinearOperator_h
#define dmgLinearOperator_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// A Hermitian positive semi-definite matrix, known by what it makes of a vector.
template <class Scalar>
class LinearOperator
{
public:
  virtual ~LinearOperator() = default;

  /// Rows, and columns.
  virtual int Size() const = 0;

  /// y = A x. May use a workspace of the operator: one application at a time.
  /// \return x^H A x.
  virtual double Apply(const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext& context) const = 0;

  /// 1 / A_ii, one per row, 0 where it is not defined; null where it is not known.
  virtual const Vector<double>* InverseDiagonal() const { return nullptr; }
};

/// A sparse matrix as operator.
template <class Scalar>
class MatrixOperator : public LinearOperator<Scalar>
{
public:
  /// \param matrix is borrowed: it must stay where it is.
  /// \throw InvalidInput it is not square.
  explicit MatrixOperator(const SparseMatrix<Scalar>& matrix);

  int Size() const override { return static_cast<int>(this->A.rows()); }
  double Apply(const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext& context) const override;

private:
  const SparseMatrix<Scalar>& A;
};

}

#endif
