#include "Support/SparseRows.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

using namespace dmg;

TEST(SparseRows, SortIndicesSorts)
{
  test::Random random(2701);
  for (const int size : { 0, 1, 2, 7, 40, 500 })
  {
    std::vector<int> indices(size);
    std::iota(indices.begin(), indices.end(), 0);
    const std::vector<int> expected = indices;
    for (int k = size - 1; k > 0; --k)
    {
      std::swap(indices[k], indices[random.Index(k + 1)]);
    }
    SortIndices(indices.data(), size);
    EXPECT_EQ(indices, expected);
  }
}

TEST(SparseRows, SumsAreAppendedAsRows)
{
  // Rows of multiples of random rows, compared with a map; the second of each is empty.
  test::Random random(2702);
  const int columns = 60;
  SparseSum<Complex> sum(columns);
  SparseRows<Complex> rows;
  std::vector<std::map<int, Complex>> expected;
  for (int row = 0; row < 20; ++row)
  {
    sum.Clear();
    expected.emplace_back();
    for (int count = row % 2 == 0 ? 1 + random.Index(5) : 0; count > 0; --count)
    {
      std::vector<int> indices;
      std::vector<Complex> values;
      for (int column = random.Index(7); column < columns; column += 1 + random.Index(20))
      {
        indices.push_back(column);
        values.push_back(random.Number());
      }
      const double factor = random.Uniform(-1.0, 1.0);
      sum.Add(factor, indices.data(), values.data(), static_cast<int>(indices.size()));
      for (std::size_t k = 0; k < indices.size(); ++k)
      {
        expected.back()[indices[k]] += factor * values[k];
      }
    }
    sum.AppendTo(rows);
  }
  ASSERT_EQ(rows.Offsets.size(), expected.size() + 1);
  ASSERT_EQ(rows.Columns.size(), rows.Values.size());
  for (std::size_t row = 0; row < expected.size(); ++row)
  {
    ASSERT_EQ(rows.Offsets[row + 1] - rows.Offsets[row], static_cast<int>(expected[row].size()));
    int k = rows.Offsets[row];
    for (const auto& [column, value] : expected[row]) // a map ascends
    {
      EXPECT_EQ(rows.Columns[k], column);
      EXPECT_LE(std::abs(rows.Values[k] - value), 10 * std::numeric_limits<double>::epsilon());
      ++k;
    }
  }
}
