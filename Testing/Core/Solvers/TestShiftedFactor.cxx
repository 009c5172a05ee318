#include "Solvers/Direct/ShiftedFactor.h"

#include "Solvers/Krylov/ConjugateGradient.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/MatrixOperator.h"
#include "Support/Random.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
class AnyShiftedFactor : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyShiftedFactor, Scalars);

/// Differences along rings of so many unknowns, one ring after the other, each with a weight and a gauge: row i of a ring is
/// w_i (conj(g_i) x_i - conj(g_i+1) x_i+1), so that fields c g on a ring cost nothing.
template <class Scalar>
struct Rings
{
  Rings(int count, int length, double smallestWeight)
    : B(count * length, count * length)
    , Gauge(count * length)
  {
    test::Random random(7301);
    std::vector<Eigen::Triplet<Scalar>> entries;
    for (Eigen::Index i = 0; i < this->Gauge.size(); ++i)
    {
      this->Gauge[i] = test::Phase<Scalar>(random.Uniform(-3.0, 3.0));
    }
    for (int i = 0; i < count * length; ++i)
    {
      const int next = i / length * length + (i + 1) % length;
      const double weight = std::pow(smallestWeight, random.Uniform(0.0, 1.0));
      entries.emplace_back(i, i, weight * Eigen::numext::conj(this->Gauge[i]));
      entries.emplace_back(i, next, -weight * Eigen::numext::conj(this->Gauge[next]));
    }
    this->B = test::FromTriplets(count * length, count * length, entries);
  }

  SparseMatrix<Scalar> Matrix() const
  {
    SparseMatrix<Scalar> A = SparseMatrix<Scalar>(this->B.adjoint()) * this->B;
    A.makeCompressed();
    return A;
  }

  SparseMatrix<Scalar> B;
  Vector<Scalar> Gauge;
};

/// B^H B + D without its square.
template <class Scalar>
class SumOfSquares : public LinearOperator<Scalar>
{
public:
  SumOfSquares(const SparseMatrix<Scalar>& B, const Vector<double>& D)
    : B(B)
    , D(D)
  {
  }
  int Size() const override { return static_cast<int>(this->B.cols()); }
  double Apply(const Vector<Scalar>& x, Vector<Scalar>& y, const ExecutionContext&) const override
  {
    const Vector<Scalar> Bx = this->B * x;
    const Vector<Scalar> Dx = this->D.template cast<Scalar>().cwiseProduct(x);
    y = this->B.adjoint() * Bx + Dx;
    return Bx.squaredNorm() + Eigen::numext::real(x.dot(Dx));
  }

private:
  const SparseMatrix<Scalar>& B;
  const Vector<double>& D;
};

template <class Scalar>
SolveReport Solve(const LinearOperator<Scalar>& A, ShiftedFactor<Scalar>& factor, const Vector<Scalar>& b,
  double tolerance, Vector<Scalar>& x)
{
  SolveReport report;
  ConjugateGradient<Scalar>(A, factor, b, { tolerance, 50 }, x, report, SerialContext());
  EXPECT_TRUE(report.Converged) << (report.Warnings.empty() ? "" : report.Warnings[0]);
  return report;
}

int IterationsOf(const SolveReport& report)
{
  return static_cast<int>(report.Iterations.size()) - 1;
}

}

TYPED_TEST(AnyShiftedFactor, InvertsTheMatrixAndAShareOfItsDiagonal)
{
  // Scales over sixteen orders of magnitude.
  SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(4, 1).A;
  Vector<double> scales(A.rows());
  for (Eigen::Index i = 0; i < scales.size(); ++i)
  {
    scales[i] = std::pow(10.0, 8.0 * std::sin(static_cast<double>(i)));
  }
  const auto scale = scales.template cast<TypeParam>().asDiagonal();
  const SparseMatrix<TypeParam> scaled = scale * A * scale;
  ShiftedFactor<TypeParam> factor(scaled);
  EXPECT_EQ(factor.Shift(), ShiftedFactor<TypeParam>::SmallestShift);
  EXPECT_GT(factor.NonZeros(), A.nonZeros() / 2);
  EXPECT_GE(factor.Bytes(), factor.NonZeros() * static_cast<long long>(sizeof(TypeParam)));
  const auto b = test::RandomVector<TypeParam>(A.rows(), 7302);
  Vector<TypeParam> z;
  factor.Apply(scale * b, z, SerialContext());
  // The inverse of the scaled matrix is that of A between inverse scales.
  const Vector<TypeParam> x = scale * z;
  EXPECT_LE((b - A * x).norm(), 10 * factor.Shift() * 4.0 * x.norm());
}

// Fields that cost nothing make it singular; nobody says which. Right-hand sides in its range determine the rest.
TYPED_TEST(AnyShiftedFactor, ASingularMatrixIsSolvedWithoutItsKernel)
{
  const int length = 60;
  const Rings<TypeParam> rings(5, length, 1.0);
  const SparseMatrix<TypeParam> A = rings.Matrix();
  const auto any = test::RandomVector<TypeParam>(A.rows(), 7303);
  const Vector<TypeParam> b = A * any;
  ShiftedFactor<TypeParam> factor(A);
  Vector<TypeParam> x;
  const SolveReport report = Solve<TypeParam>(test::MatrixOperator<TypeParam>(A), factor, b, 1e-10, x);
  EXPECT_LE(IterationsOf(report), 3);
  // The least solution: all diagonal entries are equal, so what x has of the kernel is nothing.
  Vector<TypeParam> expected = any;
  for (int ring = 0; ring < 5; ++ring)
  {
    const auto gauge = rings.Gauge.segment(ring * length, length);
    EXPECT_LE(std::abs(gauge.dot(x.segment(ring * length, length))),
      100 * Epsilon / factor.Shift() * std::sqrt(length) * x.norm());
    const TypeParam share = gauge.dot(any.segment(ring * length, length)) / double(length);
    expected.segment(ring * length, length) -= share * gauge;
  }
  EXPECT_LE((x - expected).norm(), 1e-2 * expected.norm());
}

// The energies of what is prescribed are 1e-13 of the diagonal, and those of some fields far less than
// rounding errors of the matrix; but not of its factor.
TYPED_TEST(AnyShiftedFactor, ANearlySingularMatrixIsSolvedByItsRoot)
{
  const Rings<TypeParam> rings(4, 50, 1e-6);
  Vector<double> D = Vector<double>::Zero(rings.B.cols());
  for (int i = 7; i < D.size(); i += 50)
  {
    D[i] = 1e-4;
  }
  SparseMatrix<TypeParam> A = rings.Matrix();
  A += SparseMatrix<TypeParam>(D.template cast<TypeParam>().asDiagonal());
  A.makeCompressed();
  const SumOfSquares<TypeParam> squares(rings.B, D);
  const auto exact = test::RandomVector<TypeParam>(A.rows(), 7304);
  Vector<TypeParam> b, x;
  squares.Apply(exact, b, SerialContext());
  ShiftedFactor<TypeParam> factor(A);
  const SolveReport report = Solve<TypeParam>(squares, factor, b, 1e-10, x);
  EXPECT_LE(IterationsOf(report), 20);
  Vector<TypeParam> image;
  const Vector<TypeParam> error = x - exact;
  const double energy = squares.Apply(exact, image, SerialContext());
  EXPECT_LE(squares.Apply(error, image, SerialContext()), 1e-10 * energy);
}

TYPED_TEST(AnyShiftedFactor, AnUnknownWithoutAnEquationStaysZero)
{
  SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(3, 1).A;
  const int alone = 5;
  A.prune([](Eigen::Index i, Eigen::Index j, const TypeParam&) { return i != alone && j != alone; });
  A.makeCompressed();
  Vector<TypeParam> b = test::RandomVector<TypeParam>(A.rows(), 7305);
  b[alone] = 0.0;
  ShiftedFactor<TypeParam> factor(A);
  Vector<TypeParam> x;
  factor.Apply(b, x, SerialContext());
  EXPECT_EQ(x[alone], TypeParam(0.0));
  EXPECT_LE((b - A * x).norm(), 10 * factor.Shift() * 8.0 * x.norm());
}

// A ring's Laplacian less 1e-10 of its diagonal is indefinite by as much as rounding errors might make it.
TYPED_TEST(AnyShiftedFactor, ABreakdownMakesTheShiftLarger)
{
  const auto lessShare = [](double share)
  {
    SparseMatrix<TypeParam> A = Rings<TypeParam>(2, 40, 1.0).Matrix();
    for (int i = 0; i < A.rows(); ++i)
    {
      A.coeffRef(i, i) *= 1.0 - share;
    }
    return A;
  };
  ShiftedFactor<TypeParam> factor(lessShare(1e-10));
  EXPECT_NEAR(factor.Shift(), 1e-9, 1e-15);
  factor.Update(lessShare(0.0));
  EXPECT_LE(factor.Shift(), 1e-11);
  EXPECT_THROW(factor.Update(lessShare(1e-3)), NotPositiveDefinite);
  EXPECT_THROW(ShiftedFactor<TypeParam>(lessShare(1e-3)), NotPositiveDefinite);
}

TYPED_TEST(AnyShiftedFactor, UpdateIsANewFactor)
{
  SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(5, 1).A;
  ShiftedFactor<TypeParam> updated(A);
  for (int i = 0; i < A.rows(); i += 3)
  {
    A.coeffRef(i, i) += 2.0;
  }
  updated.Update(A);
  ShiftedFactor<TypeParam> fresh(A);
  const auto b = test::RandomVector<TypeParam>(A.rows(), 7306);
  Vector<TypeParam> x, y;
  updated.Apply(b, x, SerialContext());
  fresh.Apply(b, y, SerialContext());
  EXPECT_EQ(x, y);
}
