#include "Solvers/Multigrid/LevelStack.h"

#include "Support/DenseAlgebra.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

using namespace dmg;

namespace
{

/// With scalars and values of these kinds.
template <class ScalarAndValue>
class AnyLevelStack : public ::testing::Test
{
public:
  using Scalar = typename ScalarAndValue::first_type;
  using Value = typename ScalarAndValue::second_type;
  using Dense = test::Dense<Scalar>;
  using Levels = LevelStack<Scalar, Value>;

  static constexpr double Tolerance = sizeof(typename Eigen::NumTraits<Value>::Real) == sizeof(float) ? 1e-6 : 1e-12;

  static void ExpectNear(const Vector<Scalar>& x, const Vector<Scalar>& expected)
  {
    EXPECT_LE((x - expected).norm(), Tolerance * expected.norm());
  }

  Vector<Scalar> Stored(Levels& levels) const
  {
    Vector<Scalar> x;
    levels.Store(x, SerialContext());
    return x;
  }

  const test::GridProblem<Scalar> Grid = test::MakeGridProblem<Scalar>(5, 3);
  const Dense A = test::Densified(Grid.A);
  const Dense P0 = test::Densified(Grid.P[0]);
  const Dense P1 = test::Densified(Grid.P[1]);
  const Dense A1 = test::GalerkinProduct(A, P0);
  const Dense A2 = test::GalerkinProduct(A1, P1);
  const Vector<Scalar> b = test::RandomVector<Scalar>(static_cast<int>(A.rows()), 6101);
};

using Kinds = ::testing::Types<std::pair<double, float>, std::pair<double, double>, std::pair<Complex, Complex32>,
  std::pair<Complex, Complex>>;
TYPED_TEST_SUITE(AnyLevelStack, Kinds);

}

// Level l holds D^{1/2} x and D^{-1/2} b, D the diagonal of A_l. In the caller's order and without scales:
TYPED_TEST(AnyLevelStack, TransfersAreThoseOfTheHierarchy)
{
  GalerkinHierarchy<typename TestFixture::Scalar> hierarchy(this->Grid.A, this->Grid.P, {}, SerialContext());
  for (const auto& sweeps : { std::optional<SmootherOptions>(), std::optional(SmootherOptions()) })
  {
    typename TestFixture::Levels levels(hierarchy, sweeps, 1, SerialContext());
    ASSERT_EQ(levels.NumberOfLevels(), 3);
    levels.Load(this->b, SerialContext());
    levels.Restrict(0, levels[0].b, SerialContext());
    levels.Restrict(1, levels[1].b, SerialContext());

    levels[1].x = levels[1].b;
    levels.Prolong(0, SerialContext());
    const auto inverse1 = this->A1.diagonal().cwiseInverse().asDiagonal();
    const auto corrected = (this->P0 * (inverse1 * (this->P0.adjoint() * this->b))).eval();
    this->ExpectNear(this->Stored(levels), corrected);

    levels.Correct(0, SerialContext());
    this->ExpectNear(this->Stored(levels), 2.0 * corrected);

    levels[2].x = levels[2].b;
    levels.ProlongToFinest(2, SerialContext());
    const auto inverse2 = this->A2.diagonal().cwiseInverse().asDiagonal();
    const auto P = test::Product(this->P0, this->P1);
    this->ExpectNear(this->Stored(levels), P * (inverse2 * (P.adjoint() * this->b)));

    levels.SolveCoarsest();
    levels.ProlongToFinest(2, SerialContext());
    const Vector<typename TestFixture::Scalar> coarsest = P.adjoint() * this->b;
    EXPECT_LE((this->Stored(levels) - P * test::Solved(this->A2, coarsest)).norm(),
      100 * TestFixture::Tolerance * this->b.norm());
  }
}

TYPED_TEST(AnyLevelStack, MatricesHaveUnitDiagonals)
{
  GalerkinHierarchy<typename TestFixture::Scalar> hierarchy(this->Grid.A, this->Grid.P, {}, SerialContext());
  typename TestFixture::Levels levels(hierarchy, SmootherOptions(), 1, SerialContext());
  levels.Load(this->b, SerialContext());
  const auto& parts = levels[0].A;
  for (int i = 0; i < parts.Lower.rows(); ++i)
  {
    levels[0].x[i] = levels[0].b[i] + parts.LowerTimes(i, levels[0].b.data()) + parts.UpperTimes(i, levels[0].b.data());
  }
  const auto inverse = this->A.diagonal().cwiseInverse().asDiagonal();
  this->ExpectNear(this->Stored(levels), inverse * (this->A * (inverse * this->b)));
}

TYPED_TEST(AnyLevelStack, UpdateTakesOtherValues)
{
  using Scalar = typename TestFixture::Scalar;
  GalerkinHierarchy<Scalar> hierarchy(this->Grid.A, this->Grid.P, {}, SerialContext());
  typename TestFixture::Levels levels(hierarchy, SmootherOptions(), 1, SerialContext());
  SparseMatrix<Scalar> other = this->Grid.A;
  for (int i = 0; i < other.rows(); i += 3)
  {
    other.coeffRef(i, i) *= 5.0;
  }
  hierarchy.Update(other, SerialContext());
  levels.Update(SerialContext());
  levels.Load(this->b, SerialContext());
  levels[0].x = levels[0].b;
  this->ExpectNear(this->Stored(levels), this->b.cwiseQuotient(other.diagonal()));
}

TYPED_TEST(AnyLevelStack, InactiveUnknownsStayZero)
{
  using Scalar = typename TestFixture::Scalar;
  SparseMatrix<Scalar> A = this->Grid.A;
  A.prune([](Eigen::Index i, Eigen::Index j, const Scalar&) { return i != 7 && j != 7; });
  GalerkinHierarchy<Scalar> hierarchy(A, this->Grid.P, {}, SerialContext());
  typename TestFixture::Levels levels(hierarchy, SmootherOptions(), 1, SerialContext());
  levels.Load(this->b, SerialContext());
  levels[0].x = levels[0].b;
  EXPECT_EQ(this->Stored(levels)[7], Scalar(0.0));
  levels[1].x.setOnes();
  levels.Prolong(0, SerialContext());
  EXPECT_EQ(this->Stored(levels)[7], Scalar(0.0));
}

TYPED_TEST(AnyLevelStack, HasTheSameBitsForAnyNumberOfThreads)
{
  using Scalar = typename TestFixture::Scalar;
  GalerkinHierarchy<Scalar> hierarchy(this->Grid.A, this->Grid.P, {}, SerialContext());
  const auto cycle = [&](const ExecutionContext& context)
  {
    typename TestFixture::Levels levels(hierarchy, SmootherOptions(), 1, context);
    levels.Load(this->b, context);
    levels.Restrict(0, levels[0].b, context);
    levels[1].x = levels[1].b;
    levels.Prolong(0, context);
    return this->Stored(levels);
  };
  const Vector<Scalar> expected = cycle(SerialContext());
  for (const int threads : { 2, 3, 8 })
  {
    EXPECT_EQ(cycle(test::TbbContext(threads)), expected);
  }
}
