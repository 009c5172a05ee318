#include "Support/Types.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace dmg;

TEST(TestUnfilled, VectorsKeepWhatIsWritten)
{
  Unfilled<Complex> numbers(3);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  numbers.resize(1000);
  numbers.push_back({ 0.0, 7.0 });
  EXPECT_EQ(numbers[0], Complex(1.0));
  EXPECT_EQ(numbers[2], Complex(3.0));
  EXPECT_EQ(numbers.back(), Complex(0.0, 7.0));
  EXPECT_EQ(Unfilled<double>(4, 2.5), (Unfilled<double>{ 2.5, 2.5, 2.5, 2.5 }));
}

TEST(TestUnfilled, ComplexMatricesGrowAndMultiplyAsDenseOnesDo)
{
  // Entries one by one in any order make Eigen reallocate and move what is there.
  constexpr int size = 40;
  Eigen::MatrixXcd dense = Eigen::MatrixXcd::Zero(size, size);
  SparseMatrix<Complex> sparse(size, size);
  for (int k = 0; k < 500; ++k)
  {
    const int row = 7 * k % size;
    const int column = (13 * k + k / size) % size;
    const Complex entry(k, -2 * k);
    sparse.coeffRef(row, column) += entry;
    dense(row, column) += entry;
  }
  sparse.makeCompressed();
  EXPECT_EQ((Eigen::MatrixXcd(sparse) - dense).norm(), 0.0);
  const SparseMatrix<Complex> product = sparse * sparse.adjoint();
  EXPECT_LE((Eigen::MatrixXcd(product) - dense * dense.adjoint()).norm(), 1e-12 * product.norm());
}
