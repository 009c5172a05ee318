#include "Solvers/Kernels/ArrangedMatrix.h"

#include "Support/GridProblem.h"
#include "Support/Permutations.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace dmg;

namespace
{

/// Symmetric, every second pair of places coupled, by all four entries.
SparseMatrix<double> MatrixOfPairs(int pairs, test::Random& random)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int a = 0; a < pairs; ++a)
  {
    for (int b = a; b < pairs; b += 2)
    {
      for (const int k : { 0, 1, 2, 3 })
      {
        const double value = random.Uniform(0.1, 1.0);
        const int i = 2 * a + k / 2;
        const int j = 2 * b + k % 2;
        if (a < b || i <= j)
        {
          entries.emplace_back(i, j, value);
        }
        if (a < b || i < j)
        {
          entries.emplace_back(j, i, value);
        }
      }
    }
  }
  return test::FromTriplets(2 * pairs, 2 * pairs, entries);
}

}

TEST(ArrangedMatrix, PartsOfPairsAreTheMatrixButForItsDiagonal)
{
  test::Random random(4101);
  const SparseMatrix<double> A = MatrixOfPairs(9, random);
  ASSERT_TRUE(HasPairs(A));
  std::vector<int> order;
  for (const int pair : { 4, 0, 7, 8, 1, 3, 2, 6, 5 })
  {
    order.push_back(2 * pair);
    order.push_back(2 * pair + 1);
  }
  Vector<double> scale(A.rows());
  for (double& factor : scale)
  {
    factor = random.Uniform(0.5, 2.0);
  }
  const Eigen::MatrixXd scaled = scale.asDiagonal() * Eigen::MatrixXd(A) * scale.asDiagonal();
  Eigen::MatrixXd expected = scaled(order, order);
  expected.diagonal().setZero();
  SparseMatrix<double> lower, upper;
  ArrangePairs(A, order, Inverse(order), scale, lower, upper, SerialContext());
  EXPECT_TRUE(HasPairs(lower));
  EXPECT_TRUE(HasPairs(upper));
  const Eigen::MatrixXd left = expected.triangularView<Eigen::StrictlyLower>();
  const Eigen::MatrixXd right = expected.triangularView<Eigen::StrictlyUpper>();
  EXPECT_LE((Eigen::MatrixXd(lower) - left).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LE((Eigen::MatrixXd(upper) - right).cwiseAbs().maxCoeff(), 1e-15);
}
