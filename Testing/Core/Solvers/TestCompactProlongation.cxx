#include "Solvers/CompactProlongation.h"

#include "Bands.h"
#include "GridProblem.h"
#include "Support/Errors.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace dmg;

namespace
{

// Half a unit of a row's largest component, and what single precision makes of 32,767 of them.
constexpr double Rounding = 0.51 / 32767.0;

/// Each row takes some coarse vectors near its place, entries of all sizes; every ninth row is empty.
SparseMatrix<Plane> Interpolation(int rows, int columns)
{
  test::Random random(3701);
  std::vector<Eigen::Triplet<Plane>> entries;
  for (int i = 0; i < rows; ++i)
  {
    const double size = std::pow(10.0, random.Uniform(-6.0, 3.0));
    for (int k = 0; k < 7 && i % 9 != 5; ++k)
    {
      const int j = (static_cast<int>(static_cast<long long>(i) * columns / rows) + 3 * k) % columns;
      entries.emplace_back(i, j, Plane(size * std::pow(10.0, -k) * random.Number()));
    }
  }
  return test::FromTriplets(rows, columns, entries);
}

Eigen::MatrixXd OnPairs(const SparseMatrix<Plane>& P)
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

TEST(TestCompactProlongation, RoundsToUnitsOfTheRow)
{
  const SparseMatrix<Plane> P = Interpolation(5000, 600);
  const CompactProlongation compact = test::Compact(P);
  EXPECT_EQ(compact.Rows(), 5000);
  EXPECT_EQ(compact.Columns(), 600);
  const SparseMatrix<Plane> rounded = test::AllRows(compact);
  EXPECT_EQ(compact.NonZeros(), rounded.nonZeros());
  for (int i = 0; i < P.rows(); ++i)
  {
    double largest = 0.0;
    for (SparseMatrix<Plane>::InnerIterator entry(P, i); entry; ++entry)
    {
      largest = std::max({ largest, std::abs(static_cast<double>(entry.value().real())),
        std::abs(static_cast<double>(entry.value().imag())) });
    }
    SparseMatrix<Plane>::InnerIterator after(rounded, i);
    for (SparseMatrix<Plane>::InnerIterator entry(P, i); entry; ++entry)
    {
      Plane value(0); // what rounds to nothing is left out
      if (after && after.col() == entry.col())
      {
        value = after.value();
        EXPECT_NE(value, Plane(0));
        ++after;
      }
      EXPECT_LE(std::abs(value.real() - entry.value().real()), Rounding * largest);
      EXPECT_LE(std::abs(value.imag() - entry.value().imag()), Rounding * largest);
    }
    EXPECT_FALSE(after);
  }
  EXPECT_LT(rounded.nonZeros(), P.nonZeros());
  // What is rounded already stays.
  const SparseMatrix<Plane> again = test::AllRows(test::Compact(rounded));
  EXPECT_LE((again - rounded).norm(), 4 * std::numeric_limits<float>::epsilon() * rounded.norm());
}

TEST(TestCompactProlongation, ProductsAreThoseOfTheRoundedMatrix)
{
  const CompactProlongation compact = test::Compact(Interpolation(5000, 600));
  const Eigen::MatrixXd P = OnPairs(test::AllRows(compact));
  const auto z = test::RandomVector<double>(1200, 3702);
  const auto start = test::RandomVector<double>(5000, 3703);
  Vector<double> x = start;
  compact.AddProduct(z, x, SerialContext());
  const Vector<double> sizes = P.cwiseAbs() * z.cwiseAbs(); // of the terms of each row
  for (int i = 0; i < 5000; ++i)
  {
    EXPECT_NEAR(x[i], start[i] + P.row(i).dot(z), 1e-6 * sizes[i] + 1e-15);
  }
  Vector<double> adjoint, sums;
  compact.MultiplyAdjoint(start, adjoint, sums, SerialContext());
  const Vector<double> expected = P.transpose() * start;
  EXPECT_LE((adjoint - expected).norm(), 1e-6 * expected.norm());
}

TEST(TestCompactProlongation, ProductsWithComplexNumbers)
{
  const CompactProlongation compact = test::Compact(Interpolation(5000, 600));
  const Eigen::MatrixXcd P = Eigen::MatrixXcf(test::AllRows(compact)).cast<Complex>();
  const auto z = test::RandomVector<Complex>(600, 3710);
  const Vector<Plane> start = test::RandomVector<Complex>(5000, 3711).cast<Plane>();
  Vector<Plane> x = start;
  compact.AddProduct(z, x, SerialContext());
  const Vector<double> sizes = P.cwiseAbs() * z.cwiseAbs(); // of the terms of each row
  for (int i = 0; i < 5000; ++i)
  {
    const Complex expected = Complex(start[i]) + P.row(i).transpose().cwiseProduct(z).sum();
    EXPECT_LE(std::abs(Complex(x[i]) - expected), 2e-6 * (sizes[i] + std::abs(Complex(start[i]))));
  }
  Vector<Complex> adjoint;
  Vector<float> sums;
  compact.MultiplyAdjoint(start, adjoint, sums, SerialContext());
  const Vector<Complex> expected = P.adjoint() * start.cast<Complex>();
  EXPECT_LE((adjoint - expected).norm(), 1e-6 * expected.norm());
}

TEST(TestCompactProlongation, RoundedMatricesArePackedAsTheyAre)
{
  SparseMatrix<Complex> P = Interpolation(5000, 600).cast<Complex>();
  const SparseMatrix<Complex> given = P;
  CompactProlongation::Round(P, test::TbbContext(2));
  EXPECT_GT((P - given).norm(), 0.0);
  EXPECT_LE((P - given).norm(), Rounding * std::sqrt(14.0) * given.norm());
  const SparseMatrix<Plane> packed =
    test::AllRows(test::Compact(SparseMatrix<Plane>(P.cast<Plane>())));
  const SparseMatrix<Complex> difference = P - SparseMatrix<Complex>(packed.cast<Complex>());
  EXPECT_LE(difference.norm(), 2 * std::numeric_limits<float>::epsilon() * P.norm());
}

TEST(TestCompactProlongation, RowsOfNearlyNothing)
{
  // Units of these would be below the smallest numbers.
  const SparseMatrix<Plane> P = test::FromTriplets(
    2, 1, std::vector<Eigen::Triplet<Plane>>{ { 0, 0, Plane(3e-41f, -1e-42f) }, { 1, 0, Plane(1e-36f) } });
  const SparseMatrix<Plane> rounded = test::AllRows(test::Compact(P));
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_LE(std::abs(rounded.coeff(i, 0) - P.coeff(i, 0)), 1e-34f);
  }
}

TEST(TestCompactProlongation, SomeRows)
{
  const CompactProlongation compact = test::Compact(Interpolation(5000, 600));
  const Eigen::MatrixXcf all(test::AllRows(compact));
  const std::vector<int> rows = { 4999, 5, 17, 3000, 17 };
  const Eigen::MatrixXcf expected = all(rows, Eigen::all);
  EXPECT_EQ(Eigen::MatrixXcf(compact.SelectedRows(rows, SerialContext())), expected);
  EXPECT_EQ(compact.SelectedRows({}, SerialContext()).rows(), 0);
}

TEST(TestCompactProlongation, ReadsRowsOfTheAdjoint)
{
  const CompactProlongation compact = test::Compact(Interpolation(5000, 600));
  const SparseMatrix<Plane> adjoint = Adjoint(test::AllRows(compact), SerialContext());
  CompactProlongation::Reader reader(compact);
  SparseRows<Plane> rows;
  for (const auto& [first, last] : { std::pair(0, 600), std::pair(593, 600), std::pair(40, 41) })
  {
    reader.AdjointRows(first, last, rows);
    ASSERT_EQ(rows.Size(), last - first);
    for (int j = first; j < last; ++j)
    {
      const RowOfBand<Plane> row = rows.Row(j - first);
      SparseMatrix<Plane>::InnerIterator entry(adjoint, j);
      for (int e = 0; e < row.Size; ++e, ++entry)
      {
        ASSERT_TRUE(entry);
        EXPECT_EQ(row.Columns[e], entry.col());
        EXPECT_EQ(row.Values[e], entry.value());
      }
      EXPECT_FALSE(entry);
    }
    reader.Clear();
  }
}

TEST(TestCompactProlongation, TilesOfManyEntries)
{
  // 65,536 columns are reached long before 2048 rows.
  std::vector<Eigen::Triplet<Plane>> entries;
  test::Random random(3704);
  for (int i = 0; i < 40; ++i)
  {
    for (int j = i; j < 70000; j += 9)
    {
      entries.emplace_back(i, j, Plane(random.Number()));
    }
  }
  const SparseMatrix<Plane> P = test::FromTriplets(40, 70000, entries);
  const CompactProlongation compact = test::Compact(P);
  const SparseMatrix<Plane> rounded = test::AllRows(compact);
  EXPECT_LE((rounded - P).norm(), 2 * Rounding * P.norm());
  const auto x = test::RandomVector<double>(40, 3705);
  Vector<double> z, sums;
  compact.MultiplyAdjoint(x, z, sums, SerialContext());
  const Eigen::VectorXcf expected = rounded.transpose() * x.cast<Plane>();
  for (int j = 0; j < 70000; ++j)
  {
    ASSERT_NEAR(z[2 * j], expected[j].real(), 1e-5);
    ASSERT_NEAR(z[2 * j + 1], expected[j].imag(), 1e-5);
  }
}

TEST(TestCompactProlongation, RefusesRowsOfTooManyEntries)
{
  std::vector<Eigen::Triplet<Plane>> entries;
  for (int j = 0; j < 65537; ++j)
  {
    entries.emplace_back(1, j, Plane(1.0f));
  }
  EXPECT_THROW(test::Compact(test::FromTriplets(3, 65537, entries)), InvalidInput);
  entries.pop_back();
  EXPECT_EQ(test::Compact(test::FromTriplets(3, 65537, entries)).NonZeros(), 65536);
}

TEST(TestCompactProlongation, EmptyOnes)
{
  const CompactProlongation none = test::Compact(SparseMatrix<Plane>(0, 0));
  EXPECT_EQ(none.Rows(), 0);
  EXPECT_EQ(none.Columns(), 0);
  const CompactProlongation zero = test::Compact(SparseMatrix<Plane>(3, 2));
  Vector<double> x = Vector<double>::Ones(3);
  zero.AddProduct(Vector<double>::Ones(4), x, SerialContext());
  EXPECT_EQ(x, Vector<double>::Ones(3));
  Vector<double> z, sums;
  zero.MultiplyAdjoint(x, z, sums, SerialContext());
  EXPECT_EQ(z, Vector<double>::Zero(4));
}

TEST(TestCompactProlongation, SameBitsForAnyNumberOfThreads)
{
  const SparseMatrix<Plane> P = Interpolation(30000, 4000);
  const CompactProlongation expected = test::Compact(P);
  const auto z = test::RandomVector<double>(8000, 3706);
  const auto x = test::RandomVector<double>(30000, 3707);
  Vector<double> product = x;
  expected.AddProduct(z, product, SerialContext());
  Vector<double> adjoint, sums;
  expected.MultiplyAdjoint(x, adjoint, sums, SerialContext());
  for (const int threads : { 1, 2, 5 })
  {
    const test::TbbContext context(threads);
    const CompactProlongation compact = test::Compact(P, context);
    Vector<double> y = x;
    compact.AddProduct(z, y, context);
    EXPECT_EQ(y, product);
    compact.MultiplyAdjoint(x, y, sums, context);
    EXPECT_EQ(y, adjoint);
    EXPECT_EQ(compact.Bytes(), expected.Bytes());
  }
  EXPECT_GT(expected.Bytes(), 6 * expected.NonZeros());
  EXPECT_LT(expected.Bytes(), 10 * expected.NonZeros());
}
