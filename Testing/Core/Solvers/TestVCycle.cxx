#include "Solvers/Kernels/SweepOrder.h"
#include "Solvers/Multigrid/GalerkinCycle.h"

#include "Support/DenseAlgebra.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

using test::Dense;
using test::Densified;
using test::Distance;
using test::Eigenvalues;
using test::ErrorsOf;
using test::Product;

CycleOptions Options(int preSweeps, int postSweeps, CyclePrecision precision)
{
  CycleOptions options;
  options.Smoothing = { preSweeps, postSweeps };
  options.Precision = precision;
  return options;
}

template <class Scalar>
class AnyVCycle : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyVCycle, Scalars);

}

TYPED_TEST(AnyVCycle, IsHermitianPositiveDefinite)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 3);
  const Dense<TypeParam> A = Densified(problem.A);
  for (const int sweeps : { 1, 2, 3 })
  {
    GalerkinCycle<TypeParam> cycle(SparseMatrix<TypeParam>(problem.A), problem.P, {},
      Options(sweeps, sweeps, CyclePrecision::Double), SerialContext());
    const Dense<TypeParam> B = Densified(cycle, static_cast<int>(A.rows()));
    EXPECT_LE(Distance<TypeParam>(B, B.adjoint()), 50 * Epsilon * B.norm());
    EXPECT_GT(Eigenvalues(B).minCoeff(), 0.0);

    // I - B A is a product of projections and contractions and their adjoints: no eigenvalue of
    // B A exceeds 1, and two sweeps of textbook multigrid leave none below 0.8.
    const Dense<TypeParam> root = test::SquareRoot(B);
    const Vector<double> spectrum = Eigenvalues(test::GalerkinProduct(A, root));
    EXPECT_LE(spectrum.maxCoeff(), 1.0 + 1000 * Epsilon);
    EXPECT_GE(spectrum.minCoeff(), sweeps == 1 ? 0.5 : 0.8);
  }
}

TYPED_TEST(AnyVCycle, TwoGridsAreTheTextbooksFormula)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  const GalerkinHierarchy<TypeParam> hierarchy(problem.A, problem.P, {}, SerialContext());
  const int size = hierarchy.NumberOfUnknowns(0);
  const Dense<TypeParam> A = Densified(problem.A);
  const Dense<TypeParam> P = Densified(problem.P[0]);
  const SweepOrder order = OrderForSweeps(hierarchy.Matrix(0));
  std::vector<int> unknowns; // in the order of sweeps
  for (const int k : order.Unknowns)
  {
    unknowns.push_back(hierarchy.FinestOrder()[k]);
  }
  Dense<TypeParam> forward(size, size);
  forward(unknowns, unknowns) = test::InverseOfLower<TypeParam>(A(unknowns, unknowns));
  const Dense<TypeParam> coarse =
    Product(P, Product<TypeParam>(test::Inverse(test::GalerkinProduct(A, P)), P.adjoint()));

  Dense<TypeParam> error = ErrorsOf(forward, A);
  error = Product(ErrorsOf(coarse, A), error);
  error = Product(ErrorsOf(forward, A), error);
  error = Product(ErrorsOf<TypeParam>(forward.adjoint(), A), error);
  const Dense<TypeParam> identity = Dense<TypeParam>::Identity(size, size);
  const Dense<TypeParam> expected = Product<TypeParam>(identity - error, test::Inverse(A));

  GalerkinCycle<TypeParam> cycle(
    SparseMatrix<TypeParam>(problem.A), problem.P, {}, Options(1, 2, CyclePrecision::Double), SerialContext());
  const Dense<TypeParam> B = Densified(cycle, size);
  // The coarsest matrix is lifted by 1e-12 of its diagonal.
  EXPECT_LE(Distance(B, expected), 1e-10 * expected.norm());
}

TYPED_TEST(AnyVCycle, RepetitionsAreChebyshevsIteration)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 3);
  const Dense<TypeParam> A = Densified(problem.A);
  const Dense<TypeParam> identity = Dense<TypeParam>::Identity(A.rows(), A.cols());
  const auto cycleOf = [&](int repetitions)
  {
    CycleOptions options = Options(1, 1, CyclePrecision::Double);
    options.Repetitions = repetitions;
    GalerkinCycle<TypeParam> cycle(SparseMatrix<TypeParam>(problem.A), problem.P, {}, options, SerialContext());
    return Densified(cycle, static_cast<int>(A.rows()));
  };
  // Chebyshev's polynomials take eigenvalues from 1/2 to 1 to [-1, 1], and zero to 3: T_2(3) = 17, T_3(3) = 99.
  const Dense<TypeParam> Z = 3.0 * identity - 4.0 * Product(cycleOf(1), A);
  const Dense<TypeParam> square = Product(Z, Z);
  const Dense<TypeParam> errorOfTwo = (2.0 * square - identity) / 17.0;
  const Dense<TypeParam> errorOfThree = (4.0 * Product(square, Z) - 3.0 * Z) / 99.0;
  const Dense<TypeParam> inverse = test::Inverse(A);
  for (const auto& [repetitions, error] : { std::pair(2, errorOfTwo), std::pair(3, errorOfThree) })
  {
    const Dense<TypeParam> expected = Product<TypeParam>(identity - error, inverse);
    const Dense<TypeParam> B = cycleOf(repetitions);
    EXPECT_LE(Distance(B, expected), 1e-12 * expected.norm());
    EXPECT_LE(Distance<TypeParam>(B, B.adjoint()), 1e-12 * B.norm());
  }
}

TYPED_TEST(AnyVCycle, SinglePrecisionStaysAtItsRounding)
{
  const auto problem = test::MakeGridProblem<TypeParam>(7, 5);
  const auto r = test::RandomVector<TypeParam>(problem.A.rows(), 3001);
  for (const double scale : { 1.0, 1e-20, 1e20 })
  {
    Vector<TypeParam> single, exact;
    GalerkinCycle<TypeParam>(
      SparseMatrix<TypeParam>(problem.A), problem.P, {}, Options(2, 2, CyclePrecision::Single), SerialContext())
      .Apply(scale * r, single, SerialContext());
    GalerkinCycle<TypeParam>(
      SparseMatrix<TypeParam>(problem.A), problem.P, {}, Options(2, 2, CyclePrecision::Double), SerialContext())
      .Apply(scale * r, exact, SerialContext());
    EXPECT_LE((single - exact).norm(), 10 * std::numeric_limits<float>::epsilon() * exact.norm());
    EXPECT_GT((single - exact).norm(), 0.0);
  }
}

TYPED_TEST(AnyVCycle, OneLevelIsTheInverse)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 1);
  GalerkinCycle<TypeParam> cycle(
    SparseMatrix<TypeParam>(problem.A), {}, {}, Options(2, 2, CyclePrecision::Double), SerialContext());
  const auto x = test::RandomVector<TypeParam>(problem.A.rows(), 3002);
  Vector<TypeParam> z;
  cycle.Apply(problem.A * x, z, SerialContext());
  EXPECT_LE((z - x).norm(), 1e-10 * x.norm()); // lifted by 1e-12, condition about 100
}

TYPED_TEST(AnyVCycle, UpdateHasTheBitsOfANewCycle)
{
  auto problem = test::MakeGridProblem<TypeParam>(5, 3);
  const CycleOptions options = Options(2, 2, CyclePrecision::Single);
  GalerkinCycle<TypeParam> updated(SparseMatrix<TypeParam>(problem.A), problem.P, {}, options, SerialContext());
  for (int i = 0; i < problem.A.rows(); i += 5)
  {
    problem.A.coeffRef(i, i) += 1.7;
  }
  updated.Update(SparseMatrix<TypeParam>(problem.A), SerialContext());
  GalerkinCycle<TypeParam> fresh(SparseMatrix<TypeParam>(problem.A), problem.P, {}, options, SerialContext());
  const auto r = test::RandomVector<TypeParam>(problem.A.rows(), 3003);
  Vector<TypeParam> x, y;
  updated.Apply(r, x, SerialContext());
  fresh.Apply(r, y, SerialContext());
  EXPECT_EQ(x, y);
  EXPECT_EQ(updated.Bytes(), fresh.Bytes());
}

TYPED_TEST(AnyVCycle, HasTheSameBitsForAnyNumberOfThreads)
{
  const auto problem = test::MakeGridProblem<TypeParam>(8, 5);
  const auto r = test::RandomVector<TypeParam>(problem.A.rows(), 3004);
  const CycleOptions options = Options(2, 2, CyclePrecision::Single);
  Vector<TypeParam> expected;
  GalerkinCycle<TypeParam>(SparseMatrix<TypeParam>(problem.A), problem.P, {}, options, SerialContext())
    .Apply(r, expected, SerialContext());
  for (const int threads : { 1, 2, 3, 8 })
  {
    const test::TbbContext context(threads);
    Vector<TypeParam> z;
    GalerkinCycle<TypeParam>(SparseMatrix<TypeParam>(problem.A), problem.P, {}, options, context).Apply(r, z, context);
    EXPECT_EQ(z, expected) << threads << " threads";
  }
}

TYPED_TEST(AnyVCycle, NegativeSweepsAreRefused)
{
  const auto problem = test::MakeGridProblem<TypeParam>(3, 2);
  EXPECT_THROW(GalerkinCycle<TypeParam>(SparseMatrix<TypeParam>(problem.A), problem.P, {},
                 Options(-1, 2, CyclePrecision::Single), SerialContext()),
    InvalidInput);
}
