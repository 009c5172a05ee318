#include "Solvers/Kernels/SplitMatrix.h"

#include "GridProblem.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace dmg;
using Dense = Eigen::MatrixXcd;

namespace
{

const double Epsilon = std::ldexp(1.0, -49);

/// Hermitian, with uneven entries.
SparseMatrix<Complex> UnevenMatrix()
{
  SparseMatrix<Complex> A = test::MakeGridProblem<Complex>(5, 1).A;
  const Vector<double> scale = (4.0 * test::RandomVector<double>(A.rows(), 5101)).array().exp();
  return scale.asDiagonal() * A * scale.asDiagonal();
}

/// A by colours.
Dense InColours(const SparseMatrix<Complex>& A, const SweepOrder& colours)
{
  return Dense(A)(colours.Unknowns, colours.Unknowns);
}

}

TEST(TestSplitMatrix, HoldsEveryEntry)
{
  const SparseMatrix<Complex> A = UnevenMatrix();
  const SweepOrder colours = Colouring(A);
  const SplitMatrix split(A, colours, SerialContext());
  EXPECT_EQ(split.Size(), A.rows());
  EXPECT_EQ(split.NonZeros(), A.nonZeros());
  EXPECT_EQ(split.Rounded.Begins, colours.Begins);

  const Dense expected = InColours(A, colours);
  const Dense whole(split.Whole(SerialContext()));
  const Dense lower(split.Rounded.Lower.cast<Complex>());
  const Dense upper(split.Rounded.Upper.cast<Complex>());
  for (int i = 0; i < split.Size(); ++i)
  {
    EXPECT_EQ(split.Diagonal[i], expected(i, i).real());
    for (int j = 0; j < split.Size(); ++j)
    {
      const Complex entry = expected(i, j);
      EXPECT_LE(std::abs(whole(i, j).real() - entry.real()), Epsilon * std::abs(entry.real()));
      EXPECT_LE(std::abs(whole(i, j).imag() - entry.imag()), Epsilon * std::abs(entry.imag()));
      using Single = SplitMatrix::Single;
      EXPECT_EQ(lower(i, j), j < i ? Complex(Single(entry)) : Complex(0.0));
      EXPECT_EQ(upper(i, j), j > i ? Complex(Single(entry)) : Complex(0.0));
    }
  }
}

TEST(TestSplitMatrix, MultipliesInDoublePrecision)
{
  const SparseMatrix<Complex> A = UnevenMatrix();
  const SweepOrder colours = Colouring(A);
  const SplitMatrix split(A, colours, SerialContext());
  const SplitMatrix::Operator times(split);
  const Vector<Complex> x = test::RandomVector<Complex>(split.Size(), 5102);
  const Vector<Complex> expected = InColours(A, colours) * x;
  const Vector<double> sizes = InColours(A, colours).cwiseAbs() * x.cwiseAbs();
  Vector<Complex> y(split.Size());
  for (const int middle : { 0, 7, split.Size() })
  {
    y.setZero();
    const double product = times.Multiply(0, middle, x.data(), y.data()) +
      times.Multiply(middle, split.Size(), x.data(), y.data());
    EXPECT_LE(((y - expected).cwiseAbs().array() / sizes.array()).maxCoeff(), 4 * Epsilon);
    EXPECT_NEAR(product, x.dot(expected).real(), 16 * Epsilon * x.cwiseAbs().dot(sizes));
  }
}

TEST(TestSplitMatrix, SameBitsForAnyNumberOfThreads)
{
  const SparseMatrix<Complex> A = UnevenMatrix();
  const SweepOrder colours = Colouring(A);
  const Dense expected(SplitMatrix(A, colours, SerialContext()).Whole(SerialContext()));
  for (const int threads : { 2, 3, 8 })
  {
    const test::TbbContext context(threads);
    EXPECT_EQ(Dense(SplitMatrix(A, colours, context).Whole(context)), expected);
  }
}
