#include "Solvers/Kernels/RowRuns.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace dmg;

namespace
{

Complex Any(Complex, test::Random& random)
{
  return random.Number();
}
double Any(double, test::Random& random)
{
  return random.Uniform(-1.0, 1.0);
}

/// Runs of rows of all short lengths and some longer ones; the columns of a row are equally far apart.
template <class Value>
SparseMatrix<Value> MatrixOfRuns(test::Random& random)
{
  std::vector<Eigen::Triplet<Value>> entries;
  int row = 0;
  for (const int length : { 3, 0, 1, 4, 2, 9, 5, 8, 6, 12, 7, 1, 0 })
  {
    for (int end = row + 1 + random.Index(6); row < end; ++row)
    {
      for (int k = 0; k < length; ++k)
      {
        entries.emplace_back(row, (row + 5 * k) % 60, Any(Value(), random));
      }
    }
  }
  SparseMatrix<Value> matrix(row, 60);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Runs of rows of pairs of neighbouring columns, at even and at odd places; after one run a row of as many entries has
/// none, after another one that begins with some.
SparseMatrix<double> MatrixOfPairs(test::Random& random)
{
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (const int pairs : { 1, 3, 0, 2, 9, 6, 8, 4, 10 })
  {
    for (int end = row + 1 + random.Index(6); row < end; ++row)
    {
      for (int k = 0; k < pairs; ++k)
      {
        for (const int column : { 5 * k + row % 4, 5 * k + row % 4 + 1 })
        {
          entries.emplace_back(row, column, random.Uniform(-1.0, 1.0));
        }
      }
    }
    if (pairs == 2 || pairs == 6)
    {
      for (int k = 0; k < 2 * pairs; ++k)
      {
        entries.emplace_back(row, pairs == 2 || k > 6 ? 3 * k : k, random.Uniform(-1.0, 1.0));
      }
      ++row;
    }
  }
  SparseMatrix<double> matrix(row, 60);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Value>
void ExpectRowsTimes(const SparseMatrix<Value>& matrix, test::Random& random)
{
  const RowRuns<Value> runs(matrix);
  Vector<Value> x(matrix.cols());
  for (Value& entry : x)
  {
    entry = Any(Value(), random);
  }
  const int rows = static_cast<int>(matrix.rows());
  for (int first = 0; first <= rows; ++first)
  {
    for (int last = first; last <= rows; ++last)
    {
      int next = first;
      runs.Multiply(first, last, x.data(),
        [&](int row, Value product)
        {
          EXPECT_EQ(row, next++);
          EXPECT_LE(std::abs(product - RowTimes(matrix, row, x.data())), 1e-14);
        });
      EXPECT_EQ(next, last);
    }
  }
}

}

TEST(RowRuns, MultipliesPiecesOfRowsAsRowTimesDoes)
{
  test::Random random(2802);
  ExpectRowsTimes(MatrixOfRuns<Complex>(random), random);
  ExpectRowsTimes(MatrixOfRuns<double>(random), random);
  ExpectRowsTimes(MatrixOfPairs(random), random);
}

TEST(RowRuns, LaterRowsSeeWhatEarlierOnesChange)
{
  // x_{i+1} = 2 x_i makes powers of two.
  constexpr int size = 20;
  SparseMatrix<double> matrix(size, size + 1);
  for (int i = 0; i < size; ++i)
  {
    matrix.insert(i, i) = 2.0;
  }
  matrix.makeCompressed();
  Vector<double> x = Vector<double>::Zero(size + 1);
  x[0] = 1.0;
  RowRuns<double>(matrix).Multiply(0, size, x.data(), [&x](int row, double product) { x[row + 1] = product; });
  EXPECT_EQ(x[size], std::ldexp(1.0, size));
}

TEST(RowRuns, AddsProductsWithTheTranspose)
{
  test::Random random(2803);
  for (const SparseMatrix<double>& matrix : { MatrixOfRuns<double>(random), MatrixOfPairs(random) })
  {
    const RowRuns<double> runs(matrix);
    const int rows = static_cast<int>(matrix.rows());
    Vector<double> u(rows), x(matrix.cols()), start(matrix.cols());
    for (Vector<double>* vector : { &u, &x, &start })
    {
      for (double& entry : *vector)
      {
        entry = random.Uniform(-1.0, 1.0);
      }
    }
    for (const auto& [first, last] : { std::pair(0, rows), std::pair(2, rows - 7), std::pair(5, 5) })
    {
      const SparseMatrix<double> piece = matrix.middleRows(first, last - first);
      Vector<double> y = start;
      runs.AddAdjoint(
        first, last, [&u](int row) { return u[row]; }, y.data());
      const Vector<double> expected = start + piece.transpose() * u.segment(first, last - first);
      EXPECT_LE((y - expected).cwiseAbs().maxCoeff(), 1e-13);

      y = start;
      const double squares = runs.AddGram(first, last, x.data(), y.data());
      const Vector<double> product = piece * x;
      EXPECT_NEAR(squares, product.squaredNorm(), 1e-12 * (1.0 + product.squaredNorm()));
      EXPECT_LE((y - start - piece.transpose() * product).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}
