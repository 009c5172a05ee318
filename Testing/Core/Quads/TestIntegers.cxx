// Integers with conditions, and integers near to real numbers.

#include "Quads/Map/ClosestIntegers.h"
#include "Quads/Map/ExactOrder.h"
#include "Quads/Map/IntegerLattice.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// z = B y.
std::vector<long long> Unknowns(const IntegerLattice& lattice, const std::vector<long long>& y)
{
  std::vector<long long> z(lattice.Rows.size(), 0);
  for (std::size_t k = 0; k < z.size(); ++k)
  {
    for (const auto& [parameter, coefficient] : lattice.Rows[k])
    {
      z[k] += coefficient * y[parameter];
    }
  }
  return z;
}

/// All vectors of a size with entries from -range to range.
std::vector<std::vector<long long>> Box(int size, int range)
{
  std::vector<std::vector<long long>> vectors{ {} };
  for (int k = 0; k < size; ++k)
  {
    std::vector<std::vector<long long>> longer;
    for (const auto& vector : vectors)
    {
      for (int entry = -range; entry <= range; ++entry)
      {
        longer.push_back(vector);
        longer.back().push_back(entry);
      }
    }
    vectors = longer;
  }
  return vectors;
}

bool Satisfies(const std::vector<long long>& z, const std::vector<IntegerTerms>& equations)
{
  for (const IntegerTerms& equation : equations)
  {
    long long sum = 0;
    for (const auto& [unknown, coefficient] : equation)
    {
      sum += coefficient * z[unknown];
    }
    if (sum != 0)
    {
      return false;
    }
  }
  return true;
}

TEST(IntegerLattice, HoldsAllSolutionsAndNoOthers)
{
  const std::vector<std::vector<IntegerTerms>> systems{
    { { { 0, 1 }, { 1, -1 }, { 2, -2 } } },                                      // z0 and z1 are both even, or both odd
    { { { 0, 2 }, { 1, 3 } } },                                                  // no coefficient is 1
    { { { 0, 6 }, { 1, 10 }, { 2, 15 } } },                                      // nor in pairs
    { { { 0, 1 }, { 1, 1 } }, { { 1, 2 }, { 2, 2 } }, { { 0, 1 }, { 2, -1 } } }, // one says nothing new
  };
  for (const std::vector<IntegerTerms>& equations : systems)
  {
    const IntegerLattice lattice = SolveOverIntegers(3, equations);
    std::set<std::vector<long long>> reached;
    for (const auto& y : Box(lattice.Dimension, 12))
    {
      reached.insert(Unknowns(lattice, y));
      ASSERT_TRUE(Satisfies(Unknowns(lattice, y), equations));
    }
    for (const auto& z : Box(3, 3))
    {
      EXPECT_TRUE(!Satisfies(z, equations) || reached.count(z) == 1) << z[0] << " " << z[1] << " " << z[2];
    }
  }
}

TEST(IntegerLattice, HasDimensionZeroWhereOnlyZeroIsASolution)
{
  EXPECT_EQ(SolveOverIntegers(2, { { { 0, 3 } }, { { 0, 1 }, { 1, 5 } } }).Dimension, 0);
  EXPECT_EQ(SolveOverIntegers(2, {}).Dimension, 2);
}

TEST(ClosestIntegers, AreNoWorseThanAllThatDifferByOneInOneOrTwoAndMostlyTheBest)
{
  Random random(5);
  int best = 0;
  constexpr int Trials = 40;
  for (int trial = 0; trial < Trials; ++trial)
  {
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(4, 4, [&random]() { return random.Uniform(-1.0, 1.0); });
    const Eigen::MatrixXd S = A * A.transpose() + 0.05 * Eigen::MatrixXd::Identity(4, 4);
    const Vector<double> x = Vector<double>::NullaryExpr(4, [&random]() { return random.Uniform(-2.0, 2.0); });
    const auto energy = [&](const Vector<double>& y) { return (y - x).dot(S * (y - x)); };
    const Vector<double> y = ClosestIntegers(S, InverseOf(S), x);
    EXPECT_EQ(y, Vector<double>(y.array().round()));
    double least = std::numeric_limits<double>::infinity();
    for (const auto& offset : Box(4, 3))
    {
      Vector<double> candidate = x.array().round();
      for (int k = 0; k < 4; ++k)
      {
        candidate[k] += static_cast<double>(offset[k]);
      }
      least = std::min(least, energy(candidate));
    }
    best += energy(y) <= least * (1.0 + 1e-9) ? 1 : 0;
    for (const auto& step : Box(4, 1))
    {
      const Eigen::Map<const Vector<long long>> moves(step.data(), 4);
      if ((moves.array() != 0).count() <= 2)
      {
        EXPECT_GE(energy(y + moves.cast<double>()), energy(y) - 1e-8);
      }
    }
  }
  EXPECT_GE(best, Trials * 3 / 4);
}

TEST(ClosestIntegers, AreRoundedOnesWhereNumbersAreIndependent)
{
  Vector<double> x(3);
  x << 0.4, -2.6, 7.1;
  EXPECT_EQ(ClosestIntegers(Eigen::MatrixXd::Identity(3, 3), Eigen::MatrixXd::Identity(3, 3), x),
    Vector<double>(x.array().round()));
  EXPECT_EQ(ClosestIntegers(Eigen::MatrixXd(0, 0), InverseOf(Eigen::MatrixXd(0, 0)), Vector<double>()).size(), 0);
}

TEST(ExactOrder, TellsProductsApartThatDoublesDoNot)
{
  const long long large = (1LL << 62) - 1;
  EXPECT_EQ(SignOfDifference(large, large, large - 1, large + 1), 1); // n^2 > n^2 - 1
  EXPECT_EQ(SignOfDifference(large - 1, large + 1, large, large), -1);
  EXPECT_EQ(SignOfDifference(-large, large, large - 1, -(large + 1)), -1);
  EXPECT_EQ(SignOfDifference(-large, -large, large, large), 0);
  EXPECT_EQ(SignOfDifference(3, -5, 0, 9), -1);
  EXPECT_EQ(SignOfDifference(0, 5, 7, 0), 0);
}

TEST(ExactOrder, MultipliesAsSmallNumbersDo)
{
  for (const unsigned long long a : { 0ULL, 7ULL, 0xffffffffULL, 0x100000000ULL })
  {
    EXPECT_EQ(WideProduct(a, 3).second, 3 * a);
    EXPECT_EQ(WideProduct(a, 3).first, 0u);
  }
  EXPECT_EQ(WideProduct(~0ULL, ~0ULL).first, ~0ULL - 1);
  EXPECT_EQ(WideProduct(~0ULL, ~0ULL).second, 1u);
}

}
