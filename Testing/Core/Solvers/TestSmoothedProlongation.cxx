#include "Solvers/Multigrid/SmoothedProlongation.h"

#include "Support/GridProblem.h"
#include "Support/SparseKernels.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
class AnySmoothedProlongation : public ::testing::Test
{
};
template <class Scalar>
SparseMatrix<Scalar> Smoothed(
  const SparseMatrix<Scalar>& A, SparseMatrix<Scalar> P, int steps, const ExecutionContext& context)
{
  SmoothProlongation(A, P, steps, context);
  return P;
}

using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnySmoothedProlongation, Scalars);

}

TYPED_TEST(AnySmoothedProlongation, OneStepIsThatByHand)
{
  // A path of four with unit diagonal and couplings -1/2, and an injection of its two ends:
  // (I - 2/3 A) P has the rows (1/3, 0), (1/3, 0), (0, 1/3), (0, 1/3).
  const TypeParam i = test::Phase<TypeParam>(0.3); // any gauge
  std::vector<Eigen::Triplet<TypeParam>> entries;
  for (int k = 0; k < 4; ++k)
  {
    entries.emplace_back(k, k, TypeParam(2.0));
    if (k < 3)
    {
      entries.emplace_back(k, k + 1, -i);
      entries.emplace_back(k + 1, k, -Eigen::numext::conj(i));
    }
  }
  const auto A = test::FromTriplets(4, 4, entries);
  const auto P = test::FromTriplets<TypeParam>(4, 2, { { 0, 0, 1.0 }, { 3, 1, 1.0 } });
  const auto smoothed = Smoothed(A, P, 1, SerialContext());
  ASSERT_EQ(smoothed.nonZeros(), 4);
  EXPECT_LE(std::abs(smoothed.coeff(0, 0) - TypeParam(1.0 / 3.0)), Epsilon);
  EXPECT_LE(std::abs(smoothed.coeff(1, 0) - Eigen::numext::conj(i) / 3.0), Epsilon);
  EXPECT_LE(std::abs(smoothed.coeff(2, 1) - i / 3.0), Epsilon);
  EXPECT_LE(std::abs(smoothed.coeff(3, 1) - TypeParam(1.0 / 3.0)), Epsilon);
}

TYPED_TEST(AnySmoothedProlongation, NoStepChangesNothing)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  const auto P = Smoothed(problem.A, problem.P[0], 0, SerialContext());
  EXPECT_EQ((P - problem.P[0]).norm(), 0.0);
  EXPECT_EQ(P.nonZeros(), problem.P[0].nonZeros());
}

TYPED_TEST(AnySmoothedProlongation, SmallEntriesAreDroppedAndMadeUpFor)
{
  const auto problem = test::MakeGridProblem<TypeParam>(5, 2);
  const SparseMatrix<TypeParam> AP = problem.A * problem.P[0];
  const SparseMatrix<TypeParam> full = problem.P[0] - TypeParam(2.0 / 3.0 / 4.0) * AP;
  const auto smoothed = Smoothed(problem.A, problem.P[0], 1, SerialContext());
  EXPECT_LT(smoothed.nonZeros(), full.nonZeros());
  for (int row = 0; row < full.rows(); ++row)
  {
    double before = 0.0;
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(full, row); entry; ++entry)
    {
      before += std::abs(entry.value());
    }
    double after = 0.0;
    double smallest = before;
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(smoothed, row); entry; ++entry)
    {
      after += std::abs(entry.value());
      smallest = std::min(smallest, std::abs(entry.value()));
      // Kept entries have the phase that they had.
      const TypeParam old = full.coeff(row, entry.col());
      EXPECT_LE(std::abs(entry.value() / std::abs(entry.value()) - old / std::abs(old)), 20 * Epsilon);
    }
    EXPECT_NEAR(after, before, 20 * Epsilon * before);
    EXPECT_GT(smallest, 0.05 * before);
  }
}

TYPED_TEST(AnySmoothedProlongation, CoarseFunctionsLoseEnergyWhereCoefficientsJump)
{
  // Couplings of random size, 1 to 10^4: bilinear functions have far too much energy.
  auto problem = test::MakeGridProblem<TypeParam>(5, 2);
  SparseMatrix<TypeParam>& A = problem.A;
  test::Random random(3501);
  std::vector<double> sums(A.rows(), 0.0);
  for (int i = 0; i < A.rows(); ++i)
  {
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(A, i); entry; ++entry)
    {
      if (entry.col() < i)
      {
        const double weight = std::pow(10.0, random.Uniform(0.0, 4.0));
        entry.valueRef() *= weight;
        A.coeffRef(entry.col(), i) *= weight;
        sums[i] += weight;
        sums[entry.col()] += weight;
      }
    }
  }
  for (int i = 0; i < A.rows(); ++i)
  {
    A.coeffRef(i, i) = sums[i] + 1.0;
  }
  const auto energy = [&A](const SparseMatrix<TypeParam>& P)
  {
    const SparseMatrix<TypeParam> AP = A * P;
    return std::abs(SparseMatrix<TypeParam>(P.adjoint() * AP).diagonal().sum());
  };
  double before = energy(problem.P[0]);
  for (const int steps : { 1, 2, 3 })
  {
    const double after = energy(Smoothed(A, problem.P[0], steps, SerialContext()));
    EXPECT_LT(after, before) << steps << " steps";
    before = after;
  }
}

TYPED_TEST(AnySmoothedProlongation, HasTheSameBitsForAnyNumberOfThreads)
{
  const auto problem = test::MakeGridProblem<TypeParam>(7, 2);
  const auto expected = Smoothed(problem.A, problem.P[0], 2, SerialContext());
  for (const int threads : { 1, 2, 3, 8 })
  {
    const auto P = Smoothed(problem.A, problem.P[0], 2, test::TbbContext(threads));
    ASSERT_EQ(P.nonZeros(), expected.nonZeros());
    EXPECT_TRUE(std::equal(P.valuePtr(), P.valuePtr() + P.nonZeros(), expected.valuePtr()));
    EXPECT_TRUE(std::equal(P.innerIndexPtr(), P.innerIndexPtr() + P.nonZeros(), expected.innerIndexPtr()));
  }
}
