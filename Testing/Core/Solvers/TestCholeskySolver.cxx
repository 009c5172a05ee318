#include "Solvers/Direct/CholeskySolver.h"

#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
class AnyCholeskySolver : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyCholeskySolver, Scalars);

}

TYPED_TEST(AnyCholeskySolver, SolvesWithEveryOrdering)
{
  const auto A = test::MakeGridProblem<TypeParam>(6, 1).A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 2701);
  for (const FillOrdering ordering : { FillOrdering::AMD, FillOrdering::METIS, FillOrdering::Best })
  {
    CholeskySolver<TypeParam> solver(A, ordering);
    Vector<TypeParam> x;
    solver.Solve(b, x);
    // Backward stability: the residual is at rounding level of |A| |x|, whatever the condition.
    EXPECT_LE((b - A * x).norm(), 100 * Epsilon * 8.0 * x.norm());
    EXPECT_EQ(solver.NumberOfUnknowns(), A.rows());
    EXPECT_GT(solver.NonZeros(), A.nonZeros() / 2);
    EXPECT_GE(solver.Bytes(), solver.NonZeros() * static_cast<long long>(sizeof(TypeParam)));
  }
}

TYPED_TEST(AnyCholeskySolver, CanBeStoppedBeforeTheFactor)
{
  const auto A = test::MakeGridProblem<TypeParam>(6, 1).A;
  test::TbbContext watched(1);
  CholeskySolver<TypeParam>(A, FillOrdering::AMD, watched);
  EXPECT_EQ(watched.Progress().size(), 2U);
  for (const int stop : { 1, 2 })
  {
    test::TbbContext stopped(1);
    stopped.CancelAfter(stop);
    EXPECT_THROW(CholeskySolver<TypeParam>(A, FillOrdering::AMD, stopped), Cancelled);
  }
}

TYPED_TEST(AnyCholeskySolver, ReadsTheLowerTriangleOnly)
{
  const auto A = test::MakeGridProblem<TypeParam>(3, 1).A;
  SparseMatrix<TypeParam> lower = A.template triangularView<Eigen::Lower>();
  const auto b = test::RandomVector<TypeParam>(A.rows(), 2702);
  Vector<TypeParam> x, y;
  CholeskySolver<TypeParam>(A).Solve(b, x);
  CholeskySolver<TypeParam>(lower).Solve(b, y);
  EXPECT_EQ(x, y);
}

TYPED_TEST(AnyCholeskySolver, UpdateFactorsOtherValues)
{
  auto A = test::MakeGridProblem<TypeParam>(5, 1).A;
  CholeskySolver<TypeParam> updated(A);
  for (int i = 0; i < A.rows(); i += 3)
  {
    A.coeffRef(i, i) += 2.0;
  }
  updated.Update(A);
  CholeskySolver<TypeParam> fresh(A);
  const auto b = test::RandomVector<TypeParam>(A.rows(), 2703);
  Vector<TypeParam> x, y;
  updated.Solve(b, x);
  fresh.Solve(b, y);
  EXPECT_EQ(x, y);
}

TYPED_TEST(AnyCholeskySolver, KnowsTheConditionOfADiagonalMatrix)
{
  SparseMatrix<TypeParam> A(3, 3);
  A.insert(0, 0) = 4.0;
  A.insert(1, 1) = 1.0;
  A.insert(2, 2) = 64.0;
  A.makeCompressed();
  EXPECT_NEAR(CholeskySolver<TypeParam>(A).ReciprocalCondition(), 1.0 / 64.0, 10 * Epsilon);
}

TYPED_TEST(AnyCholeskySolver, AnIndefiniteMatrixIsNamed)
{
  // One unknown has a negative diagonal and no neighbours: it is the one to be named.
  SparseMatrix<TypeParam> A(4, 4);
  for (int i = 0; i < 4; ++i)
  {
    A.insert(i, i) = i == 2 ? -1.0 : 1.0;
  }
  A.makeCompressed();
  try
  {
    CholeskySolver<TypeParam> solver(A);
    FAIL() << "accepted";
  }
  catch (const SolverFailure& failure)
  {
    EXPECT_NE(std::string(failure.what()).find("unknown 2"), std::string::npos) << failure.what();
  }
}

TYPED_TEST(AnyCholeskySolver, UpdateRefusesAnIndefiniteMatrix)
{
  auto A = test::MakeGridProblem<TypeParam>(4, 1).A;
  CholeskySolver<TypeParam> solver(A);
  A *= TypeParam(-1.0);
  EXPECT_THROW(solver.Update(A), SolverFailure);
}
