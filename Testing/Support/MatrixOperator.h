#ifndef dmgMatrixOperator_h
#define dmgMatrixOperator_h

#include "Solvers/Krylov/LinearOperator.h"
#include "Support/SparseKernels.h"

namespace dmg::test
{

/// A sparse matrix as operator.
template <class Scalar>
class MatrixOperator : public LinearOperator<Scalar>
{
public:
  /// \param matrix is square. It is borrowed: it must stay where it is.
  explicit MatrixOperator(const SparseMatrix<Scalar>& matrix)
    : A(matrix)
  {
  }

  int Size() const override { return static_cast<int>(this->A.rows()); }

  double Apply(const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext&) const override
  {
    y = this->A * x;
    return Eigen::numext::real(x.dot(y));
  }

private:
  const SparseMatrix<Scalar>& A;
};

}

#endif
