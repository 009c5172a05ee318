#include "Solvers/Kernels/SparseDiagonal.h"

#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <limits>

using namespace dmg;

TEST(SparseDiagonal, AddsTheProductAndHoldsUnknowns)
{
  Vector<double> D(5);
  D << 2.0, 0.0, std::numeric_limits<double>::infinity(), 0.5, 0.0;
  Vector<double> x(5);
  x << 3.0, 4.0, 0.0, -2.0, 1.0;
  Vector<double> y = Vector<double>::Ones(5);
  EXPECT_EQ(SparseDiagonal(D, SerialContext()).AddProduct(x, y, SerialContext()), 2.0 * 9.0 + 0.5 * 4.0);
  Vector<double> expected(5);
  expected << 7.0, 1.0, 0.0, 0.0, 1.0;
  EXPECT_EQ(y, expected);
}

TEST(SparseDiagonal, HasTheSameBitsForAnyNumberOfThreads)
{
  constexpr int Size = 100000; // several pieces of a loop
  const SparseDiagonal D(Vector<double>::LinSpaced(Size, 0.1, 3.0), SerialContext());
  const Vector<double> x = Vector<double>::LinSpaced(Size, -1.0, 0.7);
  Vector<double> expected = Vector<double>::Zero(Size);
  const double product = D.AddProduct(x, expected, SerialContext());
  for (const int threads : { 2, 3 })
  {
    Vector<double> y = Vector<double>::Zero(Size);
    EXPECT_EQ(D.AddProduct(x, y, test::TbbContext(threads)), product) << threads;
    EXPECT_EQ(y, expected) << threads;
  }
}
