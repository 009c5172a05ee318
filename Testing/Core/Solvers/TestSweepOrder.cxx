#include "Solvers/Kernels/SweepOrder.h"

#include "Support/GridProblem.h"
#include "Support/Permutations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace dmg;

namespace
{

template <class Scalar>
class AnySweepOrder : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnySweepOrder, Scalars);

}

TYPED_TEST(AnySweepOrder, ColoursSeparateNeighbours)
{
  const SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(5, 1).A;
  const SparseMatrix<TypeParam> wider = A * A; // neighbours of neighbours
  for (const SparseMatrix<TypeParam>& matrix : { A, wider })
  {
    const SweepOrder order = Colouring(matrix);
    std::vector<int> sorted = order.Unknowns;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> colours(matrix.rows());
    for (int i = 0; i < matrix.rows(); ++i)
    {
      ASSERT_EQ(sorted[i], i);
    }
    for (std::size_t colour = 0; colour + 1 < order.Begins.size(); ++colour)
    {
      ASSERT_LT(order.Begins[colour], order.Begins[colour + 1]);
      for (int k = order.Begins[colour]; k < order.Begins[colour + 1]; ++k)
      {
        colours[order.Unknowns[k]] = static_cast<int>(colour);
      }
    }
    ASSERT_EQ(order.Begins.back(), matrix.rows());
    for (int i = 0; i < matrix.rows(); ++i)
    {
      for (typename SparseMatrix<TypeParam>::InnerIterator entry(matrix, i); entry; ++entry)
      {
        EXPECT_TRUE(entry.col() == i || colours[entry.col()] != colours[i]);
      }
    }
  }
  EXPECT_EQ(Colouring(A).Begins.size(), 3u) << "a chessboard has two colours";
}

TYPED_TEST(AnySweepOrder, TilesAreRangesAndKnowWithWhichTheyAreCoupled)
{
  const SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(6, 1).A;
  const SweepOrder order = Tiling(A);
  ASSERT_FALSE(order.ColoursOfTiles.empty());
  const int tiles = order.ColoursOfTiles.back();
  ASSERT_EQ(order.Begins.size(), tiles + 1u);
  ASSERT_EQ(order.Begins.back(), A.rows());
  EXPECT_GT(tiles, 30);
  std::vector<int> tileOf(A.rows(), -1);
  for (int tile = 0; tile < tiles; ++tile)
  {
    ASSERT_LT(order.Begins[tile], order.Begins[tile + 1]);
    const int first = order.Unknowns[order.Begins[tile]];
    EXPECT_EQ(first % 2, 0);
    for (int k = order.Begins[tile]; k < order.Begins[tile + 1]; ++k)
    {
      EXPECT_EQ(order.Unknowns[k], first + k - order.Begins[tile]);
      EXPECT_EQ(tileOf[order.Unknowns[k]], -1);
      tileOf[order.Unknowns[k]] = tile;
    }
  }
  std::vector<std::set<int>> coupled(tiles);
  for (int i = 0; i < A.rows(); ++i)
  {
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(A, i); entry; ++entry)
    {
      coupled[tileOf[i]].insert(tileOf[entry.col()]);
    }
  }
  const std::vector<int>& colours = order.ColoursOfTiles;
  for (std::size_t colour = 0; colour + 1 < colours.size(); ++colour)
  {
    for (int tile = colours[colour]; tile < colours[colour + 1]; ++tile)
    {
      coupled[tile].erase(tile);
      EXPECT_TRUE(coupled[tile].lower_bound(colours[colour]) == coupled[tile].lower_bound(colours[colour + 1]));
    }
  }
  // Strips of a grid are coupled with the next ones.
  EXPECT_LE(colours.size(), 4u);
}

TYPED_TEST(AnySweepOrder, TakesColoursWhereRowsAreShort)
{
  const SparseMatrix<TypeParam> A = test::MakeGridProblem<TypeParam>(5, 1).A;
  const SweepOrder colours = OrderForSweeps(A);
  EXPECT_TRUE(colours.ColoursOfTiles.empty());
  EXPECT_EQ(colours.Begins, Colouring(A).Begins);
  const SparseMatrix<TypeParam> squared = A * A;
  const SparseMatrix<TypeParam> longRows = squared * squared; // 41 entries inside
  const SweepOrder tiles = OrderForSweeps(longRows);
  EXPECT_FALSE(tiles.ColoursOfTiles.empty());
  EXPECT_EQ(tiles.Begins, Tiling(longRows).Begins);
}

TYPED_TEST(AnySweepOrder, NoUnknownsHaveNoTile)
{
  const SweepOrder order = Tiling(SparseMatrix<TypeParam>(0, 0));
  EXPECT_TRUE(order.Unknowns.empty());
  EXPECT_EQ(order.Begins, std::vector<int>{ 0 });
}
