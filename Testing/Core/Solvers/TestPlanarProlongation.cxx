#include "Solvers/LeastSquares/PlanarProlongation.h"

#include "LeastSquaresProblem.h"
#include "Support/DenseAlgebra.h"
#include "Support/SparseKernels.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();
constexpr double SingleEpsilon = std::numeric_limits<float>::epsilon();

/// Differences along a ring and a few diagonals of it, scaled so that no eigenvalue of B^T B is above 1
/// (Gershgorin).
SparseMatrix<double> Squares(int size)
{
  test::Random random(3201);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(2 * size, size);
  for (int i = 0; i < size; ++i)
  {
    B(i, i) = 1.0;
    B(i, (i + 1) % size) -= random.Uniform(0.5, 1.5);
    B(size + i, (i + 2) % size) += random.Uniform(-0.5, 0.5);
    B(size + i, (i + 5) % size) += random.Uniform(-0.5, 0.5);
  }
  const Vector<double> columnSums = B.cwiseAbs().colwise().sum().transpose();
  const Vector<double> rowSums = B.cwiseAbs().rowwise().sum();
  B /= std::sqrt(columnSums.maxCoeff() * rowSums.maxCoeff());
  SparseMatrix<double> result = B.sparseView();
  result.makeCompressed();
  return result;
}

/// Vectors of \p size / 6 coarse unknowns, linearly interpolated along the ring and turned anyhow.
PlanarProlongation Interpolation(int size)
{
  test::Random random(3202);
  std::vector<Eigen::Triplet<Complex>> entries;
  const int coarse = size / 6;
  for (int i = 0; i < size; ++i)
  {
    const double weight = (i % 6) / 6.0;
    const double angle = random.Uniform(-3.0, 3.0);
    entries.emplace_back(i, i / 6 % coarse, std::polar(1.0 - weight, angle));
    if (weight > 0.0)
    {
      entries.emplace_back(i, (i / 6 + 1) % coarse, std::polar(weight, angle + 0.3));
    }
  }
  return test::FromTriplets(size, coarse, entries);
}

/// The real matrix on pairs of components, columns 2 j and 2 j + 1 for the vector j: the product of
/// the vectors p and z is Re p Re z + Im p Im z.
template <class Scalar>
Eigen::MatrixXd OnPairs(const SparseMatrix<Scalar>& P)
{
  const Eigen::MatrixXcd dense = SparseMatrix<Complex>(P.template cast<Complex>());
  Eigen::MatrixXd pairs(P.rows(), 2 * P.cols());
  for (int j = 0; j < P.cols(); ++j)
  {
    pairs.col(2 * j) = dense.col(j).real();
    pairs.col(2 * j + 1) = dense.col(j).imag();
  }
  return pairs;
}

SparseMatrix<Complex32> Smoothed(const SparseMatrix<double>& B, const PlanarProlongation& P, int degree, double dropped,
  const ExecutionContext& context)
{
  const SparseMatrix<double> Bt = B.transpose();
  return Adjoint(Joined(SmoothedRestriction(B, Bt, PlanarProlongation(P), degree, dropped, context), context), context);
}

/// B^T B.
Eigen::MatrixXd Gram(const Eigen::MatrixXd& B)
{
  return test::Product<double>(B.transpose(), B);
}

template <class Scalar>
void ExpectIdentical(const SparseMatrix<Scalar>& A, const SparseMatrix<Scalar>& B)
{
  ASSERT_EQ(A.rows(), B.rows());
  ASSERT_EQ(A.nonZeros(), B.nonZeros());
  EXPECT_TRUE(std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.rows() + 1, B.outerIndexPtr()));
  EXPECT_TRUE(std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr()));
  EXPECT_TRUE(std::equal(A.valuePtr(), A.valuePtr() + A.nonZeros(), B.valuePtr()));
}

}

TEST(PlanarProlongation, DegreeZeroRoundsOnly)
{
  const PlanarProlongation P = Interpolation(60);
  ExpectIdentical(Smoothed(Squares(60), P, 0, 0.5, SerialContext()), SparseMatrix<Complex32>(P.cast<Complex32>()));
}

TEST(PlanarProlongation, EnergyIsThatOfChebyshevsPolynomial)
{
  // max t p(t)^2 over (0, 1] is 1 / (2 k + 1)^2.
  const int size = 120;
  const SparseMatrix<double> B = Squares(size);
  const PlanarProlongation P = Interpolation(size);
  const Eigen::MatrixXd A = Gram(test::Densified(B));
  const Eigen::MatrixXd before = OnPairs(P);
  const Eigen::MatrixXd lengths = Gram(before);
  for (const int degree : { 1, 2, 3, 4 })
  {
    const Eigen::MatrixXd after = OnPairs(Smoothed(B, P, degree, 0.0, SerialContext()));
    const Vector<double> energies = test::Eigenvalues(test::GalerkinProduct(A, after), lengths);
    const double bound = 1.0 / ((2.0 * degree + 1.0) * (2.0 * degree + 1.0));
    EXPECT_LE(energies.maxCoeff(), (1.0 + 100 * SingleEpsilon) * bound) << "degree " << degree;
  }
}

TEST(PlanarProlongation, IsThePolynomialInTheMatrix)
{
  const SparseMatrix<double> B = Squares(60);
  const Eigen::MatrixXd P = OnPairs(Interpolation(60));
  const Eigen::MatrixXd A = Gram(test::Densified(B));
  const Eigen::MatrixXd AP = test::Product(A, P);
  // t (1 - c t)^2 is the same at its inner maximum, t = 1 / (3 c), and at 1 for c = 4 / 3.
  const Eigen::MatrixXd linear = OnPairs(Smoothed(B, Interpolation(60), 1, 0.0, SerialContext()));
  EXPECT_LE((linear - (P - 4.0 / 3.0 * AP)).norm(), 10 * SingleEpsilon * P.norm());
  // The two roots of degree 2: t p(t)^2 = T_5(sqrt t)^2 / 25 with T_5 = 16 x^5 - 20 x^3 + 5 x.
  const Eigen::MatrixXd quadratic = OnPairs(Smoothed(B, Interpolation(60), 2, 0.0, SerialContext()));
  EXPECT_LE((quadratic - (P - 4.0 * AP + 3.2 * test::Product(A, AP))).norm(), 100 * SingleEpsilon * P.norm());
}

TEST(PlanarProlongation, KernelVectorsStay)
{
  // v is in the kernel of B and v = P z for a z of random vectors.
  const int size = 60;
  test::Random random(3203);
  const Vector<double> v = Vector<double>::NullaryExpr(size, [&random]() { return random.Uniform(0.5, 1.5); });
  // Rows take the component of v out, columns of length 1 then need v longer where they were.
  Eigen::MatrixXd B(Squares(size));
  B -= (B * v) * v.transpose() / v.squaredNorm();
  const Vector<double> lengths = B.colwise().norm().transpose();
  B = 0.3 * B * lengths.cwiseInverse().asDiagonal();
  const Vector<double> kernel = v.cwiseProduct(lengths);
  ASSERT_LE((B * kernel).norm(), 100 * Epsilon * kernel.norm());

  const Vector<Complex> z = random.Numbers(10);
  std::vector<Eigen::Triplet<Complex>> entries;
  for (int i = 0; i < size; ++i)
  {
    const Complex vector = z[i / 6];
    entries.emplace_back(i, i / 6, vector * (kernel[i] / std::norm(vector) + Complex(0.0, random.Uniform(-1.0, 1.0))));
  }
  const PlanarProlongation P = test::FromTriplets(size, 10, entries);
  const auto apply = [&z](const SparseMatrix<Complex>& Q) { return Vector<double>((Q.conjugate() * z).real()); };
  ASSERT_LE((apply(P) - kernel).norm(), 100 * Epsilon * kernel.norm());
  const SparseMatrix<double> sparse = B.sparseView();
  for (const int degree : { 1, 3, 5 })
  {
    const PlanarProlongation Q = Smoothed(sparse, P, degree, 0.0, SerialContext()).cast<Complex>();
    EXPECT_LE((apply(Q) - kernel).norm(), 1e3 * SingleEpsilon * kernel.norm());
    EXPECT_GT((Q - P).norm(), 0.01 * P.norm()) << "what is not in the kernel changes";
  }
}

TEST(PlanarProlongation, DroppedEntriesAreSmall)
{
  const SparseMatrix<double> B = Squares(600);
  const PlanarProlongation P = Interpolation(600);
  const double dropped = 0.05;
  const SparseMatrix<Complex32> full = Smoothed(B, P, 3, 0.0, SerialContext());
  const SparseMatrix<Complex32> Q = Smoothed(B, P, 3, dropped, SerialContext());
  EXPECT_LT(Q.nonZeros(), full.nonZeros());
  EXPECT_LE((Q - full).norm(), 3 * dropped * full.norm());
  for (int i = 0; i < Q.rows(); ++i)
  {
    double largest = 0.0; // of what was interpolated at first
    for (PlanarProlongation::InnerIterator entry(P, i); entry; ++entry)
    {
      largest = std::max(largest, std::abs(entry.value()));
    }
    int previous = -1;
    for (SparseMatrix<Complex32>::InnerIterator entry(Q, i); entry; ++entry)
    {
      ASSERT_GE(std::abs(entry.value()), (1.0 - 10 * SingleEpsilon) * dropped * largest);
      EXPECT_LT(previous, entry.col());
      previous = static_cast<int>(entry.col());
    }
  }
}

TEST(PlanarProlongation, CoarseStiffnessIsTheTripleProductOfPairs)
{
  const SparseMatrix<double> B = Squares(240);
  const SparseMatrix<double> Bt = B.transpose();
  const SparseMatrix<Complex32> P = Smoothed(B, Interpolation(240), 2, 0.01, SerialContext());
  const SparseMatrix<Complex32> adjoint = Adjoint(P, SerialContext());
  // The first coarse vector has nothing left.
  std::vector<int> held = { 100, 101, 177 };
  for (int i = 200; i < 260; ++i)
  {
    held.push_back(i % 240);
  }
  std::sort(held.begin(), held.end());
  const SparseMatrix<double> ofAll = CoarseStiffness(B, Bt, P, adjoint, {}, SerialContext());
  for (const std::vector<int>& rows : { std::vector<int>(), held })
  {
    Eigen::MatrixXd free = OnPairs(P);
    for (const int i : rows)
    {
      free.row(i).setZero();
    }
    const SparseMatrix<double> coarse = CoarseStiffness(B, Bt, P, adjoint, rows, SerialContext());
    const Eigen::MatrixXd expected = Gram(test::Product(test::Densified(B), free)).triangularView<Eigen::Lower>();
    ASSERT_EQ(coarse.rows(), 80);
    EXPECT_LE((Eigen::MatrixXd(coarse) - expected).norm(), 20 * Epsilon * expected.norm());
    EXPECT_EQ(expected.col(0).isZero(), !rows.empty());
    EXPECT_EQ(coarse.coeff(0, 0) == 0.0, !rows.empty());
    EXPECT_EQ(coarse.nonZeros(), ofAll.nonZeros()); // the pattern does not depend on what is held
  }
}

TEST(PlanarProlongation, GramIsTheProductOfPairs)
{
  const SparseMatrix<Complex32> Q = Smoothed(Squares(240), Interpolation(240), 2, 0.01, SerialContext());
  const SparseMatrix<double> gram = GramOfPlanar(Q, SerialContext());
  const Eigen::MatrixXd pairs = OnPairs(Q);
  const Eigen::MatrixXd expected = Gram(pairs);
  ASSERT_EQ(gram.rows(), 80);
  EXPECT_LE((Eigen::MatrixXd(gram) - expected).norm(), 20 * Epsilon * expected.norm());
  for (int i = 0; i < gram.rows(); ++i)
  {
    for (int k = gram.outerIndexPtr()[i] + 1; k < gram.outerIndexPtr()[i + 1]; ++k)
    {
      ASSERT_LT(gram.innerIndexPtr()[k - 1], gram.innerIndexPtr()[k]) << "columns of row " << i;
    }
  }
}

TEST(PlanarProlongation, HasTheSameBitsForAnyNumberOfThreads)
{
  const SparseMatrix<double> B = Squares(6000);
  const PlanarProlongation P = Interpolation(6000);
  const SparseMatrix<double> Bt = B.transpose();
  const SparseMatrix<Complex32> expected = Smoothed(B, P, 3, 0.01, SerialContext());
  const SparseMatrix<Complex32> adjoint = Adjoint(expected, SerialContext());
  const SparseMatrix<double> gram = GramOfPlanar(expected, SerialContext());
  const SparseMatrix<double> coarse = CoarseStiffness(B, Bt, expected, adjoint, { 7, 8 }, SerialContext());
  for (const int threads : { 1, 2, 5 })
  {
    const test::TbbContext context(threads);
    ExpectIdentical(Smoothed(B, P, 3, 0.01, context), expected);
    ExpectIdentical(GramOfPlanar(expected, context), gram);
    ExpectIdentical(CoarseStiffness(B, Bt, expected, adjoint, { 7, 8 }, context), coarse);
  }
}
