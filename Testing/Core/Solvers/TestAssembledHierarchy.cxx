#include "Solvers/Multigrid/AssembledHierarchy.h"

#include "Support/SparseKernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace dmg;

// Second differences of a smooth vector are far smaller than their terms: with the factor, an error of epsilon |B|^T |B x| is
// left of epsilon |B^T B| |x|.
TEST(AssembledHierarchy, ProductsWithTheFactorKeepTheSmoothestFields)
{
  constexpr int size = 1000;
  constexpr double Epsilon = std::numeric_limits<double>::epsilon();
  SparseMatrix<double> B(size - 2, size);
  for (int i = 0; i + 2 < size; ++i)
  {
    B.insert(i, i) = 1.0;
    B.insert(i, i + 1) = -2.0;
    B.insert(i, i + 2) = 1.0;
  }
  B.makeCompressed();
  Vector<double> x(size);
  for (int i = 0; i < size; ++i)
  {
    x[i] = 1.0 / 3.0 + std::sin(1e-3 * i);
  }
  Eigen::Matrix<long double, -1, 1> image = Eigen::Matrix<long double, -1, 1>::Zero(size);
  long double energy = 0.0;
  for (int i = 0; i + 2 < size; ++i)
  {
    const long double difference = (long double)x[i] - 2.0L * x[i + 1] + x[i + 2];
    energy += difference * difference;
    image[i] += difference;
    image[i + 1] -= 2.0L * difference;
    image[i + 2] += difference;
  }
  const Vector<double> expected = image.cast<double>();
  const auto errorOf = [&](const SparseMatrix<double>& factor)
  {
    SparseMatrix<double> R = NormalMatrix(B, SerialContext());
    const AssembledHierarchy<double> hierarchy(R, {}, factor);
    Vector<double> y;
    const double product = hierarchy.Operator()->Apply(x, y, SerialContext());
    if (factor.rows() > 0)
    {
      // Each difference has a rounding error of four epsilon, of about 1e-6.
      EXPECT_NEAR(product, static_cast<double>(energy), size * 2.0 * 1e-6 * 8.0 * Epsilon);
    }
    return (y - expected).cwiseAbs().maxCoeff();
  };
  EXPECT_LE(errorOf(B), 4.0 * 8.0 * Epsilon);
}

// A penalty adds to products, and an infinite one holds its unknown, as without the factor.
TEST(AssembledHierarchy, PenaltiesActAlikeWithAndWithoutTheFactor)
{
  SparseMatrix<double> B(2, 3);
  B.insert(0, 0) = 1.0;
  B.insert(0, 1) = -1.0;
  B.insert(1, 1) = 2.0;
  B.insert(1, 2) = 3.0;
  B.makeCompressed();
  const Vector<double> D = (Vector<double>(3) << 0.0, 5.0, std::numeric_limits<double>::infinity()).finished();
  const Vector<double> x = (Vector<double>(3) << 1.0, 2.0, 0.0).finished();
  for (const SparseMatrix<double>& factor : { B, SparseMatrix<double>() })
  {
    SparseMatrix<double> R = NormalMatrix(B, SerialContext());
    const AssembledHierarchy<double> hierarchy(R, {}, factor);
    const auto A = hierarchy.Operator();
    A->SetDiagonal(D, SerialContext());
    Vector<double> y;
    // B x = (-1, 4), B^T B x = (-1, 9, 12), D x = (0, 10, held)
    EXPECT_DOUBLE_EQ(A->Apply(x, y, SerialContext()), 1.0 + 16.0 + 20.0);
    EXPECT_EQ(y, Vector<double>((Vector<double>(3) << -1.0, 19.0, 0.0).finished()));
  }
}
