#include "Support/HarmonicSystem.h"

#include "Support/DenseAlgebra.h"
#include "Support/Identities.h"
#include "Support/Random.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace
{

using namespace dmg;
using namespace dmg::test;

Complex RandomScalar(Random& random, Complex*)
{
  return random.Number();
}
double RandomScalar(Random& random, double*)
{
  return random.Number().real();
}

/// Hermitian positive semi-definite, three blocks that are not connected: [0, 6), [6, 10), [10,
/// 12). In each block the sum of w |x_i - u x_j|^2 over a chain with phases u, so that the kernel
/// has one dimension per block.
template <class Scalar>
SparseMatrix<Scalar> ThreeChains(Random& random)
{
  Eigen::Matrix<Scalar, -1, -1> L = Eigen::Matrix<Scalar, -1, -1>::Zero(12, 12);
  for (int i = 0; i + 1 < 12; ++i)
  {
    if (i == 5 || i == 9)
    {
      continue;
    }
    Scalar u = RandomScalar(random, static_cast<Scalar*>(nullptr));
    u /= std::abs(u);
    const double w = random.Uniform(0.5, 2.0);
    L(i, i) += w;
    L(i + 1, i + 1) += w;
    L(i, i + 1) -= w * u;
    L(i + 1, i) -= w * Eigen::numext::conj(u);
  }
  return L.sparseView();
}

template <class Scalar>
class AnyHarmonicSystem : public ::testing::Test
{
protected:
  using Dense = Eigen::Matrix<Scalar, -1, -1>;

  Random Numbers{ 31 };
  const SparseMatrix<Scalar> L = ThreeChains<Scalar>(this->Numbers);
  const Vector<double> M = Vector<double>::LinSpaced(12, 1.0, 2.0);

  Vector<Scalar> RandomVector(int size)
  {
    Vector<Scalar> values(size);
    for (Scalar& value : values)
    {
      value = RandomScalar(this->Numbers, static_cast<Scalar*>(nullptr));
    }
    return values;
  }

  Vector<Scalar> Solve(const HarmonicSystem<Scalar>& system, const Vector<Scalar>& values) const
  {
    const Vector<Scalar> free = Solved(Densified(system.Matrix()), system.RightHandSide(values));
    return system.Expand(free, values);
  }

  double Energy(const Vector<Scalar>& x) const { return std::real(x.dot(this->L * x)); }
};

using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyHarmonicSystem, Scalars);

TYPED_TEST(AnyHarmonicSystem, SoftMinimisesItsEnergy)
{
  const std::vector<int> prescribed = { 1, 4, 8 };
  const Vector<double> alignment = Eigen::Vector3d(0.7, 2.0, 0.3);
  const auto system = HarmonicSystem<TypeParam>::Soft(this->L, this->M, prescribed, alignment);
  EXPECT_EQ(system.NumberOfUnknowns(), 12);
  EXPECT_EQ(system.NumberOfFree(), 10);
  EXPECT_EQ(system.NumberOfUnreached(), 2);
  EXPECT_EQ(system.RowsOfUnknowns()[10], -1);
  EXPECT_EQ(system.RowsOfUnknowns()[11], -1);

  const Vector<TypeParam> y = this->RandomVector(3);
  const Vector<TypeParam> x = this->Solve(system, y);
  EXPECT_EQ(x[10], TypeParam(0));
  EXPECT_EQ(x[11], TypeParam(0));

  const auto energy = [&](const Vector<TypeParam>& z)
  {
    double sum = this->Energy(z);
    for (int b = 0; b < 3; ++b)
    {
      sum += alignment[b] * std::norm(z[prescribed[b]] - y[b]);
    }
    return sum;
  };
  // At the minimum of a quadratic energy, a step s changes it by exactly the energy of s.
  for (int trial = 0; trial < 20; ++trial)
  {
    const Vector<TypeParam> step = this->RandomVector(12);
    double quadratic = this->Energy(step);
    for (int b = 0; b < 3; ++b)
    {
      quadratic += alignment[b] * std::norm(step[prescribed[b]]);
    }
    EXPECT_NEAR(energy(x + step) - energy(x), quadratic, 1e3 * MachinePrecision * quadratic);
  }
}

TYPED_TEST(AnyHarmonicSystem, HardMinimisesAmongWhatHoldsTheValues)
{
  const std::vector<int> prescribed = { 2, 3, 9 };
  const auto system = HarmonicSystem<TypeParam>::Hard(this->L, this->M, prescribed);
  EXPECT_EQ(system.FreeUnknowns(), (std::vector<int>{ 0, 1, 4, 5, 6, 7, 8 }));
  EXPECT_EQ(system.NumberOfUnreached(), 2);

  const Vector<TypeParam> y = this->RandomVector(3);
  const Vector<TypeParam> x = this->Solve(system, y);
  for (int b = 0; b < 3; ++b)
  {
    EXPECT_EQ(x[prescribed[b]], y[b]);
  }
  for (int trial = 0; trial < 20; ++trial)
  {
    Vector<TypeParam> step = this->RandomVector(12);
    for (int unknown : prescribed)
    {
      step[unknown] = 0.0;
    }
    const double quadratic = this->Energy(step);
    EXPECT_NEAR(this->Energy(x + step) - this->Energy(x), quadratic, 1e3 * MachinePrecision * quadratic);
  }
}

TYPED_TEST(AnyHarmonicSystem, HardIsTheLimitOfSoft)
{
  const std::vector<int> prescribed = { 0, 5, 7, 11 };
  const Vector<TypeParam> y = this->RandomVector(4);
  const auto hard = HarmonicSystem<TypeParam>::Hard(this->L, this->M, prescribed);
  EXPECT_EQ(hard.NumberOfUnreached(), 0);
  const Vector<TypeParam> limit = this->Solve(hard, y);
  double previous = 1e30;
  for (double weight : { 1e2, 1e4, 1e6 })
  {
    const auto soft =
      HarmonicSystem<TypeParam>::Soft(this->L, this->M, prescribed, Vector<double>::Constant(4, weight));
    const double error = (this->Solve(soft, y) - limit).norm();
    EXPECT_LT(error, 0.02 * previous); // a rate of one over the weight
    previous = error;
  }
}

TYPED_TEST(AnyHarmonicSystem, KnowsItsUnknowns)
{
  const auto system = HarmonicSystem<TypeParam>::Hard(this->L, this->M, { 3 });
  ASSERT_EQ(system.FreeUnknowns(), (std::vector<int>{ 0, 1, 2, 4, 5 }));
  for (int row = 0; row < 5; ++row)
  {
    EXPECT_EQ(system.RowsOfUnknowns()[system.FreeUnknowns()[row]], row);
    EXPECT_EQ(system.Mass()[row], this->M[system.FreeUnknowns()[row]]);
  }
  const typename TestFixture::Dense dense = this->L;
  const typename TestFixture::Dense matrix = system.Matrix();
  for (int i = 0; i < 5; ++i)
  {
    for (int j = 0; j < 5; ++j)
    {
      EXPECT_EQ(matrix(i, j), dense(system.FreeUnknowns()[i], system.FreeUnknowns()[j]));
    }
  }
  const Vector<TypeParam> free = this->RandomVector(5);
  const Vector<TypeParam> y = this->RandomVector(1);
  EXPECT_EQ(system.Restrict(system.Expand(free, y)), free);
}

TYPED_TEST(AnyHarmonicSystem, SoftPrescriptionsWithoutMassHoldNothing)
{
  const auto system = HarmonicSystem<TypeParam>::Soft(this->L, this->M, { 1, 8 }, Eigen::Vector2d(0.0, 1.0));
  EXPECT_EQ(system.FreeUnknowns(), (std::vector<int>{ 6, 7, 8, 9 }));
  EXPECT_EQ(system.RightHandSide(this->RandomVector(2)).size(), 4);
}

TYPED_TEST(AnyHarmonicSystem, MakeIsSoftOrHardAsThePrescriptionSays)
{
  using Dense = typename TestFixture::Dense;
  const std::vector<int> prescribed = { 1, 4, 8 };
  const Vector<double> alignment = Eigen::Vector3d(0.7, 2.0, 0.3);
  const Vector<TypeParam> y = this->RandomVector(3);
  const auto expectSame = [&y](const HarmonicSystem<TypeParam>& a, const HarmonicSystem<TypeParam>& b)
  {
    EXPECT_EQ(a.FreeUnknowns(), b.FreeUnknowns());
    EXPECT_EQ(Dense(a.Matrix()), Dense(b.Matrix()));
    EXPECT_EQ(a.RightHandSide(y), b.RightHandSide(y));
  };
  expectSame(HarmonicSystem<TypeParam>::Make(this->L, this->M, { ConstraintKind::Soft, prescribed, alignment }),
    HarmonicSystem<TypeParam>::Soft(this->L, this->M, prescribed, alignment));
  expectSame(HarmonicSystem<TypeParam>::Make(this->L, this->M, { ConstraintKind::Hard, prescribed, {} }),
    HarmonicSystem<TypeParam>::Hard(this->L, this->M, prescribed));
}

TYPED_TEST(AnyHarmonicSystem, EverythingPrescribedHardLeavesNothing)
{
  std::vector<int> all(12);
  for (int i = 0; i < 12; ++i)
  {
    all[i] = i;
  }
  const auto system = HarmonicSystem<TypeParam>::Hard(this->L, this->M, all);
  EXPECT_EQ(system.NumberOfFree(), 0);
  EXPECT_EQ(system.Matrix().rows(), 0);
  const Vector<TypeParam> y = this->RandomVector(12);
  EXPECT_EQ(system.RightHandSide(y).size(), 0);
  EXPECT_EQ(system.Expand({}, y), y);
}

}
