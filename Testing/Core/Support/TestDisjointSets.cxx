#include "Support/DisjointSets.h"

#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace dmg;

namespace
{

/// Gives all numbers of two sets the smaller name.
void Rename(std::vector<int>& names, int a, int b)
{
  const int to = std::min(names[a], names[b]);
  const int from = std::max(names[a], names[b]);
  std::replace(names.begin(), names.end(), from, to);
}

}

TEST(DisjointSets, AreThoseOfNamesThatAreReplaced)
{
  constexpr int size = 200;
  test::Random random(8201);
  DisjointSets sets(size);
  std::vector<int> names(size);
  std::iota(names.begin(), names.end(), 0);
  EXPECT_EQ(sets.AllSmallest(), names);
  for (int k = 0; k < 2 * size; ++k)
  {
    const int a = random.Index(size);
    const int b = random.Index(size);
    sets.Unite(a, b);
    Rename(names, a, b);
    EXPECT_EQ(sets.AllSmallest(), names);
    EXPECT_EQ(sets.Smallest(b), names[b]);
  }
  EXPECT_EQ(DisjointSets(0).AllSmallest(), std::vector<int>());
}

TEST(DisjointSets, ColumnsAreConnectedThroughRows)
{
  // Columns 0, 3 and 5 by two rows; 1 and 4 by one; 2 alone; an entry that is zero connects nothing.
  SparseMatrix<double> A(5, 6);
  std::vector<Eigen::Triplet<double>> entries = { { 0, 5, 1.0 }, { 0, 3, -1.0 }, { 1, 4, 2.0 }, { 1, 1, 1.0 },
    { 2, 2, 1.0 }, { 3, 0, 1.0 }, { 3, 5, 1.0 }, { 3, 1, 0.0 } };
  A.setFromTriplets(entries.begin(), entries.end());
  EXPECT_EQ(ConnectedColumns(A), (std::vector<int>{ 0, 1, 2, 0, 1, 0 }));
  EXPECT_EQ(ConnectedColumns(SparseMatrix<Complex>(A.cast<Complex>())), ConnectedColumns(A));
}
