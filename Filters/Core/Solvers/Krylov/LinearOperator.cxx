#include "Solvers/Krylov/LinearOperator.h"

#include "Support/Errors.h"
#include "Support/SparseKernels.h"

namespace dmg
{

template <class Scalar>
MatrixOperator<Scalar>::MatrixOperator(const SparseMatrix<Scalar>& matrix)
  : A(matrix)
{
  if (matrix.rows() != matrix.cols())
  {
    throw InvalidInput("the matrix of a linear system must be square");
  }
}

template <class Scalar>
double MatrixOperator<Scalar>::Apply(const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext& context) const
{
  y.resize(x.size());
  return SumOverBlocks<double>(static_cast<int>(x.size()), context,
    [this, &x, &y](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        y[i] = RowTimes(this->A, i, x.data());
      }
      const int count = last - first;
      return Eigen::numext::real(x.segment(first, count).dot(y.segment(first, count)));
    });
}

template class MatrixOperator<double>;
template class MatrixOperator<Complex>;

}
