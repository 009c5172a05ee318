#include "Levels/OperatorsFromOtherSide.h"

#include "Support/Identities.h"
#include "Support/Pairs.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace
{

using namespace dmg;
using namespace dmg::test;

constexpr int First = 5; ///< coarse elements of the first component; twice as many are fine

/// Random entries in both components, none between them.
template <class Scalar, class Number>
SparseMatrix<Scalar> OfTwoComponents(int size, const Number& number)
{
  std::vector<Eigen::Triplet<Scalar>> entries;
  for (int row = 0; row < 4 * First * size; ++row)
  {
    for (int column = 0; column < 2 * First * size; ++column)
    {
      if ((row < 2 * First * size) == (column < First * size))
      {
        entries.emplace_back(row, column, number());
      }
    }
  }
  SparseMatrix<Scalar> matrix(4 * First * size, 2 * First * size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Numbers of the second component in frames whose first axis is reversed.
Vector<Complex> Turned(const Vector<Complex>& numbers)
{
  Vector<Complex> turned = numbers;
  const Eigen::Index half = numbers.size() / 2;
  turned.tail(half) = -numbers.tail(half).conjugate();
  return turned;
}

TEST(OperatorsFromOtherSide, CarryTheSameVectors)
{
  Random random(7);
  ProlongationOperators operators;
  operators.SP = { OfTwoComponents<Complex>(1, [&] { return Complex(random.Uniform(-1, 1), random.Uniform(-1, 1)); }) };
  operators.Linear = operators.SP;
  operators.SX = { OfTwoComponents<double>(2, [&] { return random.Uniform(-1, 1); }) };
  const ProlongationOperators before = operators;
  std::vector<char> isTurned(4 * First, 0);
  std::fill(isTurned.begin() + 2 * First, isTurned.end(), 1);
  const ProlongationOperators after = SeenFromOtherSide(std::move(operators), isTurned);

  const Vector<Complex> coarse = random.Numbers(2 * First);
  const Vector<Complex> powers = Turned(before.SP[0] * coarse),
                        vectors = Turned(AsComplex(before.SX[0] * AsPairs(coarse)));
  EXPECT_LE(RelativeDifference(Vector<Complex>(after.SP[0] * Turned(coarse)), powers), 1e-14);
  EXPECT_LE(RelativeDifference(Vector<Complex>(after.Linear[0] * Turned(coarse)), powers), 1e-14);
  EXPECT_LE(RelativeDifference(AsComplex(after.SX[0] * AsPairs(Turned(coarse))), vectors), 1e-14);
}

TEST(OperatorsFromOtherSide, AreTheSameWhereNothingIsTurned)
{
  ProlongationOperators operators;
  operators.SP = { OfTwoComponents<Complex>(1, [] { return Complex(0.5, 0.25); }) };
  EXPECT_EQ(SeenFromOtherSide(std::move(operators), {}).SP[0].coeff(0, 0), Complex(0.5, 0.25));
}

}
