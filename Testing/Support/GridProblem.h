#ifndef dmgTestGridProblem_h
#define dmgTestGridProblem_h

#include "Support/Random.h"
#include "Support/Types.h"

#include <complex>
#include <type_traits>
#include <vector>

namespace dmg::test
{

/// A Laplacian on a square grid with bilinear prolongations: what multigrid solves in textbooks.
template <class Scalar>
struct GridProblem
{
  SparseMatrix<Scalar> A;
  std::vector<SparseMatrix<Scalar>> P;
};

template <class Scalar>
SparseMatrix<Scalar> FromTriplets(int rows, int columns, const std::vector<Eigen::Triplet<Scalar>>& entries);

/// e^{i angle}, or 1 where only real numbers are.
template <class Scalar>
Scalar Phase([[maybe_unused]] double angle)
{
  if constexpr (std::is_same<Scalar, Complex>::value)
  {
    return std::polar(1.0, angle);
  }
  else
  {
    return 1.0;
  }
}

/// 2^depth - 1 interior nodes a side, zero values on the boundary; \p levels levels.
///
/// real: the 5-point Laplacian. complex: the connection Laplacian of a constant magnetic field with
/// two flux quanta through the square (Peierls' phases), in a random gauge on every level. Its
/// entries have no pattern of phases left, and it is Hermitian positive definite.
template <class Scalar>
GridProblem<Scalar> MakeGridProblem(int depth, int levels);

template <class Scalar>
Vector<Scalar> RandomVector(int size, unsigned seed);

}

#endif
