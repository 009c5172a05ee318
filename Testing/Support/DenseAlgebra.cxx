#include "Support/DenseAlgebra.h"

#include "Support/ExecutionContext.h"

#include <Eigen/Dense>

namespace dmg::test
{

template <class Scalar>
Dense<Scalar> Densified(const SparseMatrix<Scalar>& A)
{
  return Dense<Scalar>(A);
}

template <class Scalar>
Dense<Scalar> Densified(Preconditioner<Scalar>& B, int size)
{
  Dense<Scalar> dense(size, size);
  Vector<Scalar> z;
  for (int j = 0; j < size; ++j)
  {
    B.Apply(Vector<Scalar>::Unit(size, j), z, SerialContext());
    dense.col(j) = z;
  }
  return dense;
}

template <class Scalar>
Dense<Scalar> Product(const Dense<Scalar>& A, const Dense<Scalar>& B)
{
  return A * B;
}

template <class Scalar>
Dense<Scalar> GalerkinProduct(const Dense<Scalar>& A, const Dense<Scalar>& P)
{
  return Product<Scalar>(P.adjoint(), Product(A, P));
}

template <class Scalar>
Dense<Scalar> ErrorsOf(const Dense<Scalar>& B, const Dense<Scalar>& A)
{
  return Dense<Scalar>::Identity(A.rows(), A.cols()) - Product(B, A);
}

template <class Scalar>
double Distance(const Dense<Scalar>& A, const Dense<Scalar>& B)
{
  return (A - B).norm();
}

template <class Scalar>
Dense<Scalar> Inverse(const Dense<Scalar>& A)
{
  return A.inverse();
}

template <class Scalar>
Dense<Scalar> InverseOfLower(const Dense<Scalar>& A)
{
  Dense<Scalar> inverse = Dense<Scalar>::Identity(A.rows(), A.cols());
  A.template triangularView<Eigen::Lower>().solveInPlace(inverse);
  return inverse;
}

template <class Scalar>
Vector<Scalar> Solved(const Dense<Scalar>& A, const Vector<Scalar>& b)
{
  return A.partialPivLu().solve(b);
}

template <class Scalar>
Dense<Scalar> PseudoInverse(const Dense<Scalar>& A)
{
  return A.completeOrthogonalDecomposition().pseudoInverse();
}

template <class Scalar>
Vector<double> Eigenvalues(const Dense<Scalar>& A)
{
  return Eigen::SelfAdjointEigenSolver<Dense<Scalar>>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

template <class Scalar>
Vector<double> Eigenvalues(const Dense<Scalar>& A, const Dense<Scalar>& M)
{
  return Eigen::GeneralizedSelfAdjointEigenSolver<Dense<Scalar>>(A, M, Eigen::EigenvaluesOnly).eigenvalues();
}

template <class Scalar>
Dense<Scalar> SquareRoot(const Dense<Scalar>& A)
{
  return Eigen::SelfAdjointEigenSolver<Dense<Scalar>>(A).operatorSqrt();
}

#define DMG_INSTANTIATE(Scalar)                                                       \
  template Dense<Scalar> Densified(const SparseMatrix<Scalar>&);                      \
  template Dense<Scalar> Densified(Preconditioner<Scalar>&, int);                     \
  template Dense<Scalar> Product(const Dense<Scalar>&, const Dense<Scalar>&);         \
  template Dense<Scalar> GalerkinProduct(const Dense<Scalar>&, const Dense<Scalar>&); \
  template Dense<Scalar> ErrorsOf(const Dense<Scalar>&, const Dense<Scalar>&);        \
  template double Distance(const Dense<Scalar>&, const Dense<Scalar>&);               \
  template Dense<Scalar> Inverse(const Dense<Scalar>&);                               \
  template Dense<Scalar> InverseOfLower(const Dense<Scalar>&);                        \
  template Vector<Scalar> Solved(const Dense<Scalar>&, const Vector<Scalar>&);        \
  template Vector<double> Eigenvalues(const Dense<Scalar>&);                          \
  template Dense<Scalar> SquareRoot(const Dense<Scalar>&)

DMG_INSTANTIATE(double);
DMG_INSTANTIATE(Complex);

template Dense<Complex> PseudoInverse(const Dense<Complex>&);
template Vector<double> Eigenvalues(const Dense<double>&, const Dense<double>&);

#undef DMG_INSTANTIATE

}
