#include "Levels/TransportOperator.h"

#include "Support/Identities.h"
#include "Support/Pairs.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{

using namespace dmg;
using namespace dmg::test;

/// Weights that sum to 1 in each row, and random turns; some rows hold nothing.
TransportOperator RandomTransport(int rows, int columns, unsigned seed)
{
  Random random(seed);
  std::vector<Eigen::Triplet<Complex>> entries;
  for (int i = 0; i < rows; ++i)
  {
    const int size = random.Index(5);
    for (int k = 0; k < size; ++k)
    {
      const int column = (random.Index(columns / 5) + k * (columns / 5)) % columns;
      entries.emplace_back(i, column, std::polar(1.0 / size, random.Uniform(-3.0, 3.0)));
    }
  }
  TransportOperator transport(rows, columns);
  transport.setFromTriplets(entries.begin(), entries.end());
  return transport;
}

TEST(TransportOperator, OnComponentsIsItselfOnComplexNumbers)
{
  const TransportOperator transport = RandomTransport(80, 30, 1);
  const Vector<Complex> vectors = Random(2).Numbers(30);
  EXPECT_LE(
    RelativeDifference(AsComplex(OnComponents(transport) * AsPairs(vectors)), Vector<Complex>(transport * vectors)),
    10 * MachinePrecision);
}

// x_i = Re sum_j conj(p_ij) z_j, as PlanarProlongation says.
TEST(TransportOperator, RowsOfComponentsActAsOnComponents)
{
  const TransportOperator transport = RandomTransport(80, 30, 3);
  const SparseMatrix<Complex> rows = RowsOfComponents(transport);
  ASSERT_EQ(rows.rows(), 160);
  ASSERT_EQ(rows.cols(), 30);
  EXPECT_EQ(rows.nonZeros(), 2 * transport.nonZeros());
  for (unsigned seed : { 4u, 5u, 6u })
  {
    const Vector<Complex> vectors = Random(seed).Numbers(30);
    const Vector<double> components = (rows.conjugate() * vectors).real();
    const Vector<double> expected = OnComponents(transport) * AsPairs(vectors);
    EXPECT_LE(RelativeDifference(components, expected), 10 * MachinePrecision);
  }
}

TEST(TransportOperator, IsTheSameForAnyNumberOfThreads)
{
  const TransportOperator transport = RandomTransport(20000, 3000, 7);
  for (const int threads : { 2, 5 })
  {
    const TbbContext context(threads);
    EXPECT_EQ(RelativeDifference(RowsOfComponents(transport, context), RowsOfComponents(transport)), 0.0);
    EXPECT_EQ(RelativeDifference(OnComponents(transport, context), OnComponents(transport)), 0.0);
  }
}

}
