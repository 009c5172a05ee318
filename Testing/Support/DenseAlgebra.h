#ifndef dmgTestDenseAlgebra_h
#define dmgTestDenseAlgebra_h

#include "Solvers/Krylov/Preconditioner.h"
#include "Support/Types.h"

/// Dense matrices for expected values, of double and Complex. Bodies are compiled once, since Eigen's products and
/// decompositions take long to compile. Name the scalar to pass an expression: Product<double>(A.transpose(), A).
namespace dmg::test
{

template <class Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

template <class Scalar>
Dense<Scalar> Densified(const SparseMatrix<Scalar>& A);
/// \param size of the vectors.
template <class Scalar>
Dense<Scalar> Densified(Preconditioner<Scalar>& B, int size);

/// A B.
template <class Scalar>
Dense<Scalar> Product(const Dense<Scalar>& A, const Dense<Scalar>& B);
/// P^H A P.
template <class Scalar>
Dense<Scalar> GalerkinProduct(const Dense<Scalar>& A, const Dense<Scalar>& P);
/// I - B A: the errors that a step x += B (b - A x) leaves.
template <class Scalar>
Dense<Scalar> ErrorsOf(const Dense<Scalar>& B, const Dense<Scalar>& A);
/// |A - B| of Frobenius.
template <class Scalar>
double Distance(const Dense<Scalar>& A, const Dense<Scalar>& B);

template <class Scalar>
Dense<Scalar> Inverse(const Dense<Scalar>& A);
/// The inverse of the lower triangle.
template <class Scalar>
Dense<Scalar> InverseOfLower(const Dense<Scalar>& A);
/// A^-1 b.
template <class Scalar>
Vector<Scalar> Solved(const Dense<Scalar>& A, const Vector<Scalar>& b);
/// The pseudo-inverse, of complex matrices.
template <class Scalar>
Dense<Scalar> PseudoInverse(const Dense<Scalar>& A);

/// Ascending. \pre A is symmetric or Hermitian, as are those below.
template <class Scalar>
Vector<double> Eigenvalues(const Dense<Scalar>& A);
/// The lambda of A x = lambda M x, ascending; of real matrices. \pre M is positive definite.
template <class Scalar>
Vector<double> Eigenvalues(const Dense<Scalar>& A, const Dense<Scalar>& M);
/// \pre A is positive definite.
template <class Scalar>
Dense<Scalar> SquareRoot(const Dense<Scalar>& A);

}

#endif
