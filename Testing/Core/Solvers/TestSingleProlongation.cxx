#include "Solvers/Kernels/SingleProlongation.h"

#include "Support/AllIndices.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

using namespace dmg;

namespace
{

/// Each row takes some coarse vectors near its place, entries of all sizes; every ninth row is empty.
SparseMatrix<Complex32> Interpolation(int rows, int columns)
{
  test::Random random(3701);
  std::vector<Eigen::Triplet<Complex32>> entries;
  for (int i = 0; i < rows; ++i)
  {
    const double size = std::pow(10.0, random.Uniform(-6.0, 3.0));
    for (int k = 0; k < 7 && i % 9 != 5; ++k)
    {
      const int j = (static_cast<int>(static_cast<long long>(i) * columns / rows) + 3 * k) % columns;
      entries.emplace_back(i, j, Complex32(size * std::pow(10.0, -k) * random.Number()));
    }
  }
  return test::FromTriplets(rows, columns, entries);
}

SingleProlongation Single(SparseMatrix<Complex32> P)
{
  return SingleProlongation(std::move(P));
}

Eigen::MatrixXd OnPairs(const SparseMatrix<Complex32>& P)
{
  const Eigen::MatrixXcf dense(P);
  Eigen::MatrixXd pairs(P.rows(), 2 * P.cols());
  for (int j = 0; j < P.cols(); ++j)
  {
    pairs.col(2 * j) = dense.col(j).real().cast<double>();
    pairs.col(2 * j + 1) = dense.col(j).imag().cast<double>();
  }
  return pairs;
}

}

TEST(SingleProlongation, ProductsAreThoseOfTheMatrix)
{
  const SingleProlongation single = Single(Interpolation(5000, 600));
  const Eigen::MatrixXd P = OnPairs(single.Matrix());
  const auto z = test::RandomVector<double>(1200, 3702);
  const auto start = test::RandomVector<double>(5000, 3703);
  Vector<double> x = start;
  single.AddProduct(z, x, SerialContext());
  const Vector<double> sizes = P.cwiseAbs() * z.cwiseAbs(); // of the terms of each row
  for (int i = 0; i < 5000; ++i)
  {
    EXPECT_NEAR(x[i], start[i] + P.row(i).dot(z), 1e-6 * sizes[i] + 1e-15);
  }
  Vector<double> adjoint, sums;
  single.MultiplyAdjoint(start, adjoint, sums, SerialContext());
  const Vector<double> expected = P.transpose() * start;
  EXPECT_LE((adjoint - expected).norm(), 1e-6 * expected.norm());
}

TEST(SingleProlongation, ProductsWithComplexNumbersAreThoseOfTheMatrix)
{
  const SingleProlongation single = Single(Interpolation(5000, 600));
  const Eigen::MatrixXcd P = Eigen::MatrixXcf(single.Matrix()).cast<Complex>();
  const auto z = test::RandomVector<Complex>(600, 3710);
  const Vector<Complex32> start = test::RandomVector<Complex>(5000, 3711).cast<Complex32>();
  Vector<Complex32> x = start;
  single.AddProduct(z, x, SerialContext());
  const Vector<double> sizes = P.cwiseAbs() * z.cwiseAbs(); // of the terms of each row
  for (int i = 0; i < 5000; ++i)
  {
    const Complex expected = Complex(start[i]) + P.row(i).transpose().cwiseProduct(z).sum();
    EXPECT_LE(std::abs(Complex(x[i]) - expected), 2e-6 * (sizes[i] + std::abs(Complex(start[i]))));
  }
  Vector<Complex> adjoint;
  Vector<float> sums;
  single.MultiplyAdjoint(start, adjoint, sums, SerialContext());
  const Vector<Complex> expected = P.adjoint() * start.cast<Complex>();
  EXPECT_LE((adjoint - expected).norm(), 1e-6 * expected.norm());
}

TEST(SingleProlongation, SelectedRowsAreThoseOfTheMatrix)
{
  const SingleProlongation single = Single(Interpolation(5000, 600));
  const Eigen::MatrixXcf all(single.Matrix());
  const std::vector<int> rows = { 4999, 5, 17, 3000, 17 };
  const Eigen::MatrixXcf expected = all(rows, All);
  EXPECT_EQ(Eigen::MatrixXcf(single.SelectedRows(rows, SerialContext())), expected);
  EXPECT_EQ(single.SelectedRows({}, SerialContext()).rows(), 0);
}

TEST(SingleProlongation, MayBeEmpty)
{
  const SingleProlongation none = Single(SparseMatrix<Complex32>(0, 0));
  EXPECT_EQ(none.Rows(), 0);
  EXPECT_EQ(none.Columns(), 0);
  const SingleProlongation zero = Single(SparseMatrix<Complex32>(3, 2));
  Vector<double> x = Vector<double>::Ones(3);
  zero.AddProduct(Vector<double>::Ones(4), x, SerialContext());
  EXPECT_EQ(x, Vector<double>::Ones(3));
  Vector<double> z, sums;
  zero.MultiplyAdjoint(x, z, sums, SerialContext());
  EXPECT_EQ(z, Vector<double>::Zero(4));
}

TEST(SingleProlongation, HasTheSameBitsForAnyNumberOfThreads)
{
  const SparseMatrix<Complex32> P = Interpolation(30000, 4000);
  const SingleProlongation single = Single(P);
  const auto z = test::RandomVector<double>(8000, 3706);
  const auto x = test::RandomVector<double>(30000, 3707);
  Vector<double> product = x;
  single.AddProduct(z, product, SerialContext());
  Vector<double> adjoint, sums;
  single.MultiplyAdjoint(x, adjoint, sums, SerialContext());
  for (const int threads : { 1, 2, 5 })
  {
    const test::TbbContext context(threads);
    Vector<double> y = x;
    single.AddProduct(z, y, context);
    EXPECT_EQ(y, product);
    single.MultiplyAdjoint(x, y, sums, context);
    EXPECT_EQ(y, adjoint);
  }
  EXPECT_GE(single.Bytes(), 12 * single.NonZeros());
}
