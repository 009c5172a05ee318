#include "Solvers/Kernels/TriangularParts.h"

#include "Support/GridProblem.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <vector>

using namespace dmg;

namespace
{

/// A few pairs of columns in each row; 0 to 11 pairs, so that loops have all kinds of rests.
SparseMatrix<double> RowsOfPairs()
{
  test::Random random(6201);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < 24; ++i)
  {
    for (int pair = 0; pair < i / 2; ++pair)
    {
      entries.emplace_back(i, 2 * pair, random.Uniform(-1.0, 1.0));
      entries.emplace_back(i, 2 * pair + 1, random.Uniform(-1.0, 1.0));
    }
  }
  return test::FromTriplets(24, 24, entries);
}

template <class Value>
void ExpectProducts(const TriangularParts<Value>& parts, double tolerance)
{
  using Dense = Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic>;
  const Vector<Value> x = Vector<Value>::Random(parts.Lower.cols());
  const Vector<Value> lower = Dense(parts.Lower) * x;
  const Vector<Value> upper = Dense(parts.Upper) * x;
  for (int i = 0; i < parts.Lower.rows(); ++i)
  {
    EXPECT_LE(std::abs(parts.LowerTimes(i, x.data()) - lower[i]), tolerance);
    EXPECT_LE(std::abs(parts.UpperTimes(i, x.data()) - upper[i]), tolerance);
  }
}

}

TEST(TriangularParts, ProductsAreThoseOfTheRows)
{
  TriangularParts<float> parts;
  parts.Lower = RowsOfPairs().cast<float>();
  parts.Upper = SparseMatrix<float>(parts.Lower.transpose());
  ExpectProducts(parts, 1e-5);
  // Columns are pairs in both now.
  parts.HavePairs = true;
  parts.Upper = parts.Lower;
  ExpectProducts(parts, 1e-5);

  TriangularParts<Complex> ofComplex;
  const SparseMatrix<Complex> A = test::MakeGridProblem<Complex>(4, 1).A;
  ofComplex.Lower = A.triangularView<Eigen::StrictlyLower>();
  ofComplex.Upper = A.triangularView<Eigen::StrictlyUpper>();
  ExpectProducts(ofComplex, 1e-14);
}
