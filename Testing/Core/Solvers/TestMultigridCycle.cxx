#include "Solvers/Kernels/SweepOrder.h"
#include "Solvers/Multigrid/MultigridCycle.h"

#include "GridProblem.h"
#include "Support/Errors.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <limits>
#include <utility>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

CycleOptions Options(int preSweeps, int postSweeps, CyclePrecision precision)
{
  CycleOptions options;
  options.Smoothing = { preSweeps, postSweeps };
  options.Precision = precision;
  return options;
}

template <class Scalar>
Matrix<Scalar> Densified(Preconditioner<Scalar>& B, int size)
{
  Matrix<Scalar> dense(size, size);
  for (int j = 0; j < size; ++j)
  {
    Vector<Scalar> z;
    B.Apply(Vector<Scalar>::Unit(size, j), z, SerialContext());
    dense.col(j) = z;
  }
  return dense;
}

template <class Scalar>
class AnyMultigridCycle : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyMultigridCycle, Scalars);

}

TYPED_TEST(AnyMultigridCycle, IsHermitianPositiveDefinite)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 3);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const Matrix<TypeParam> A(problem.A);
  for (const int sweeps : { 1, 2, 3 })
  {
    MultigridCycle<TypeParam> cycle(hierarchy, Options(sweeps, sweeps, CyclePrecision::Double), SerialContext());
    const Matrix<TypeParam> B = Densified(cycle, static_cast<int>(A.rows()));
    EXPECT_LE((B - B.adjoint()).norm(), 50 * Epsilon * B.norm());
    const Eigen::SelfAdjointEigenSolver<Matrix<TypeParam>> spectrum(B);
    EXPECT_GT(spectrum.eigenvalues().minCoeff(), 0.0);

    // I - B A is a product of projections and contractions and their adjoints: no eigenvalue of
    // B A exceeds 1, and two sweeps of textbook multigrid leave none below 0.8.
    const Matrix<TypeParam> root = spectrum.operatorSqrt();
    const Eigen::SelfAdjointEigenSolver<Matrix<TypeParam>> product(root * A * root);
    EXPECT_LE(product.eigenvalues().maxCoeff(), 1.0 + 1000 * Epsilon);
    EXPECT_GE(product.eigenvalues().minCoeff(), sweeps == 1 ? 0.5 : 0.8);
  }
}

TYPED_TEST(AnyMultigridCycle, TwoGridsAreTheTextbooksFormula)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const int size = hierarchy.NumberOfUnknowns(0);
  const Matrix<TypeParam> A(problem.A);
  const Matrix<TypeParam> P(problem.P[0]);
  const Matrix<TypeParam> coarse = P.adjoint() * A * P;
  const SweepOrder order = OrderForSweeps(hierarchy.Matrix(0));
  Eigen::PermutationMatrix<Eigen::Dynamic> toOrder(size);
  for (int k = 0; k < size; ++k)
  {
    toOrder.indices()[hierarchy.FinestOrder()[order.Unknowns[k]]] = k;
  }
  const Matrix<TypeParam> inOrder = toOrder * A * toOrder.transpose();
  const Matrix<TypeParam> inverse =
    inOrder.template triangularView<Eigen::Lower>().solve(Matrix<TypeParam>::Identity(size, size));
  const Matrix<TypeParam> forward = toOrder.transpose() * inverse * toOrder;

  const Matrix<TypeParam> identity = Matrix<TypeParam>::Identity(size, size);
  Matrix<TypeParam> error = identity - forward * A;
  error = (identity - P * coarse.llt().solve(P.adjoint() * A)) * error;
  error = (identity - forward * A) * error;
  error = (identity - forward.adjoint() * A) * error;
  const Matrix<TypeParam> expected = (identity - error) * A.inverse();

  MultigridCycle<TypeParam> cycle(hierarchy, Options(1, 2, CyclePrecision::Double), SerialContext());
  const Matrix<TypeParam> B = Densified(cycle, size);
  // The coarsest matrix is lifted by 1e-12 of its diagonal.
  EXPECT_LE((B - expected).norm(), 1e-10 * expected.norm());
}

TYPED_TEST(AnyMultigridCycle, RepetitionsAreChebyshevsIteration)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 3);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const Matrix<TypeParam> A(problem.A);
  const Matrix<TypeParam> identity = Matrix<TypeParam>::Identity(A.rows(), A.cols());
  const auto cycleOf = [&](int repetitions)
  {
    CycleOptions options = Options(1, 1, CyclePrecision::Double);
    options.Repetitions = repetitions;
    MultigridCycle<TypeParam> cycle(hierarchy, options, SerialContext());
    return Densified(cycle, static_cast<int>(A.rows()));
  };
  // Chebyshev's polynomials take eigenvalues from 1/2 to 1 to [-1, 1], and zero to 3: T_2(3) = 17, T_3(3) = 99.
  const Matrix<TypeParam> Z = 3.0 * identity - 4.0 * cycleOf(1) * A;
  const Matrix<TypeParam> errorOfTwo = (2.0 * Z * Z - identity) / 17.0;
  const Matrix<TypeParam> errorOfThree = (4.0 * Z * Z * Z - 3.0 * Z) / 99.0;
  for (const auto& [repetitions, error] : { std::pair(2, errorOfTwo), std::pair(3, errorOfThree) })
  {
    const Matrix<TypeParam> expected = (identity - error) * A.inverse();
    const Matrix<TypeParam> B = cycleOf(repetitions);
    EXPECT_LE((B - expected).norm(), 1e-12 * expected.norm());
    EXPECT_LE((B - B.adjoint()).norm(), 1e-12 * B.norm());
  }
}

TYPED_TEST(AnyMultigridCycle, SinglePrecisionStaysAtItsRounding)
{
  const auto problem = test::MakeGridProblem<TypeParam>(7, 5);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const auto r = test::RandomVector<TypeParam>(problem.A.rows(), 3001);
  for (const double scale : { 1.0, 1e-20, 1e20 })
  {
    Vector<TypeParam> single, exact;
    MultigridCycle<TypeParam>(hierarchy, Options(2, 2, CyclePrecision::Single), SerialContext())
      .Apply(scale * r, single, SerialContext());
    MultigridCycle<TypeParam>(hierarchy, Options(2, 2, CyclePrecision::Double), SerialContext())
      .Apply(scale * r, exact, SerialContext());
    EXPECT_LE((single - exact).norm(), 10 * std::numeric_limits<float>::epsilon() * exact.norm());
    EXPECT_GT((single - exact).norm(), 0.0);
  }
}

TYPED_TEST(AnyMultigridCycle, OneLevelIsTheInverse)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 1);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, {}, {}, SerialContext());
  MultigridCycle<TypeParam> cycle(hierarchy, Options(2, 2, CyclePrecision::Double), SerialContext());
  const auto x = test::RandomVector<TypeParam>(problem.A.rows(), 3002);
  Vector<TypeParam> z;
  cycle.Apply(problem.A * x, z, SerialContext());
  EXPECT_LE((z - x).norm(), 1e-10 * x.norm()); // lifted by 1e-12, condition about 100
}

TYPED_TEST(AnyMultigridCycle, UpdateHasTheBitsOfANewCycle)
{
  auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const CycleOptions options = Options(2, 2, CyclePrecision::Single);
  MultigridCycle<TypeParam> updated(hierarchy, options, SerialContext());
  for (int i = 0; i < problem.A.rows(); i += 5)
  {
    problem.A.coeffRef(i, i) += 1.7;
  }
  hierarchy.Update(problem.A, SerialContext());
  updated.Update(SerialContext());
  GalerkinHierarchy<TypeParam> freshHierarchy(problem.A, problem.P, {}, SerialContext());
  MultigridCycle<TypeParam> fresh(freshHierarchy, options, SerialContext());
  const auto r = test::RandomVector<TypeParam>(problem.A.rows(), 3003);
  Vector<TypeParam> x, y;
  updated.Apply(r, x, SerialContext());
  fresh.Apply(r, y, SerialContext());
  EXPECT_EQ(x, y);
  EXPECT_EQ(updated.Bytes(), fresh.Bytes());
}

TYPED_TEST(AnyMultigridCycle, HasTheSameBitsForAnyNumberOfThreads)
{
  const auto problem = test::MakeGridProblem<TypeParam>(8, 5);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const auto r = test::RandomVector<TypeParam>(problem.A.rows(), 3004);
  const CycleOptions options = Options(2, 2, CyclePrecision::Single);
  Vector<TypeParam> expected;
  MultigridCycle<TypeParam>(hierarchy, options, SerialContext()).Apply(r, expected, SerialContext());
  for (const int threads : { 1, 2, 3, 8 })
  {
    const test::TbbContext context(threads);
    Vector<TypeParam> z;
    MultigridCycle<TypeParam>(hierarchy, options, context).Apply(r, z, context);
    EXPECT_EQ(z, expected) << threads << " threads";
  }
}

TYPED_TEST(AnyMultigridCycle, NegativeSweepsAreRefused)
{
  const auto problem = test::MakeGridProblem<TypeParam>(3, 2);
  GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  EXPECT_THROW(
    MultigridCycle<TypeParam>(hierarchy, Options(-1, 2, CyclePrecision::Single), SerialContext()), InvalidInput);
}
