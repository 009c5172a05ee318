#include "Solvers/Krylov/LinearOperator.h"

#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
class AnyLinearOperator : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyLinearOperator, Scalars);

}

TYPED_TEST(AnyLinearOperator, AMatrixIsItsProduct)
{
  const SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(5, 1).A;
  const MatrixOperator<TypeParam> linear(A);
  ASSERT_EQ(linear.Size(), A.rows());
  for (unsigned seed = 3501; seed < 3505; ++seed)
  {
    const auto x = test::RandomVector<TypeParam>(linear.Size(), seed);
    const Vector<TypeParam> expected = A * x;
    Vector<TypeParam> y; // of any size
    const double energy = linear.Apply(x, y, SerialContext());
    ASSERT_EQ(y.size(), x.size());
    EXPECT_LE((y - expected).norm(), 10 * Epsilon * 8.0 * x.norm()); // 8 bounds the eigenvalues
    const TypeParam product = x.dot(expected);
    EXPECT_NEAR(energy, Eigen::numext::real(product), 100 * Epsilon * 8.0 * x.squaredNorm());
    EXPECT_NEAR(Eigen::numext::imag(product), 0.0, 100 * Epsilon * 8.0 * x.squaredNorm());
    EXPECT_GT(energy, 0.0);
  }
}

TYPED_TEST(AnyLinearOperator, AMatrixMustBeSquare)
{
  const SparseMatrix<TypeParam> wide(3, 4);
  const SparseMatrix<TypeParam> tall(4, 3);
  EXPECT_THROW(MatrixOperator<TypeParam>{ wide }, InvalidInput);
  EXPECT_THROW(MatrixOperator<TypeParam>{ tall }, InvalidInput);
}

TYPED_TEST(AnyLinearOperator, HasTheSameBitsForAnyNumberOfThreads)
{
  const SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(8, 1).A;
  const MatrixOperator<TypeParam> linear(A);
  const auto x = test::RandomVector<TypeParam>(linear.Size(), 3506);
  Vector<TypeParam> expected;
  const double energy = linear.Apply(x, expected, SerialContext());
  for (const int threads : { 1, 2, 5 })
  {
    Vector<TypeParam> y;
    EXPECT_EQ(linear.Apply(x, y, test::TbbContext(threads)), energy);
    EXPECT_EQ(y, expected);
  }
}
