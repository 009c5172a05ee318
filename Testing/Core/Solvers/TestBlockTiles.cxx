#include "Solvers/LeastSquares/BlockTiles.h"

#include "LeastSquaresProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace dmg;

namespace
{

std::set<int> RowsOf(const test::Squares& squares, int firstBlock, int lastBlock)
{
  std::set<int> rows;
  for (int k = firstBlock; k < lastBlock; ++k)
  {
    for (const int unknown : test::MembersOf(squares.Blocks, k))
    {
      for (SparseMatrix<double>::InnerIterator row(squares.Bt, unknown); row; ++row)
      {
        rows.insert(static_cast<int>(row.col()));
      }
    }
  }
  return rows;
}

bool Overlap(const std::set<int>& a, const std::set<int>& b)
{
  return std::any_of(a.begin(), a.end(), [&b](int row) { return b.count(row) > 0; });
}

/// The first colour that no earlier block of the tile with a row in common has.
int GreedyColour(const test::Squares& squares, const BlockTiles& tiles, int firstBlock, int block)
{
  std::set<int> taken;
  for (int k = firstBlock; k < block; ++k)
  {
    if (Overlap(RowsOf(squares, k, k + 1), RowsOf(squares, block, block + 1)))
    {
      taken.insert(tiles.BlockColours()[k]);
    }
  }
  int colour = 0;
  while (taken.count(colour) > 0)
  {
    ++colour;
  }
  return std::min(colour, BlockTiles::LastBlockColour);
}

}

TEST(TestBlockTiles, PartTheBlocksEvenly)
{
  for (const int size : { 20, 200, 2000 })
  {
    const test::Squares ring = test::Ring(size);
    const BlockTiles tiles(ring.Bt, ring.Blocks, SerialContext());
    std::vector<int> tilesOfBlocks(ring.Blocks.Size(), 0);
    const int wanted = BlockTiles::SizeFor(ring.Blocks.Size());
    for (int t = 0; t < tiles.Size(); ++t)
    {
      EXPECT_LE(tiles.Last(t) - tiles.First(t), 1.5 * wanted);
      EXPECT_GE(tiles.Last(t) - tiles.First(t), std::min(wanted / 2, ring.Blocks.Size()));
      for (int k = tiles.First(t); k < tiles.Last(t); ++k)
      {
        ++tilesOfBlocks[k];
      }
    }
    EXPECT_EQ(tilesOfBlocks, std::vector<int>(ring.Blocks.Size(), 1));
  }
}

TEST(TestBlockTiles, TilesOfAColourShareNoRow)
{
  for (const test::Squares& squares : { test::Ring(400), test::Fan(150), test::Wheels(40, 6) })
  {
    const BlockTiles tiles(squares.Bt, squares.Blocks, SerialContext());
    const std::vector<int>& begins = tiles.ColoursOfTiles();
    ASSERT_EQ(begins.back(), tiles.Size());
    for (std::size_t colour = 0; colour + 1 < begins.size(); ++colour)
    {
      ASSERT_LT(begins[colour], begins[colour + 1]);
      for (int a = begins[colour]; a < begins[colour + 1]; ++a)
      {
        for (int b = a + 1; b < begins[colour + 1]; ++b)
        {
          EXPECT_FALSE(
            Overlap(RowsOf(squares, tiles.First(a), tiles.Last(a)), RowsOf(squares, tiles.First(b), tiles.Last(b))));
        }
      }
    }
  }
  // All blocks of a fan share a row.
  const test::Squares fan = test::Fan(150);
  const BlockTiles tiles(fan.Bt, fan.Blocks, SerialContext());
  EXPECT_EQ(static_cast<int>(tiles.ColoursOfTiles().size()), tiles.Size() + 1);
  // A ring needs two or three colours.
  const test::Squares ring = test::Ring(400);
  EXPECT_LE(BlockTiles(ring.Bt, ring.Blocks, SerialContext()).ColoursOfTiles().size(), 4u);
}

TEST(TestBlockTiles, BlocksOfATileHaveGreedyColours)
{
  for (const test::Squares& squares : { test::Ring(100), test::Fan(80), test::Wheels(10, 6) })
  {
    const BlockTiles tiles(squares.Bt, squares.Blocks, SerialContext());
    for (int t = 0; t < tiles.Size(); ++t)
    {
      for (int k = tiles.First(t); k < tiles.Last(t); ++k)
      {
        EXPECT_EQ(tiles.BlockColours()[k], GreedyColour(squares, tiles, tiles.First(t), k));
      }
    }
  }
}

TEST(TestBlockTiles, TheLastColourIsForBlocksThatFindNone)
{
  // 16 or so blocks stand in a tile; one of 100 blocks, all of which share a row, needs many blocks in all.
  const test::Squares fan = test::Fan(100 * 128);
  const BlockTiles tiles(fan.Bt, fan.Blocks, SerialContext());
  for (const int t : { 0, tiles.Size() / 2, tiles.Size() - 1 })
  {
    ASSERT_GT(tiles.Last(t) - tiles.First(t), BlockTiles::LastBlockColour);
    for (int k = tiles.First(t); k < tiles.Last(t); ++k)
    {
      EXPECT_EQ(tiles.BlockColours()[k], std::min(k - tiles.First(t), static_cast<int>(BlockTiles::LastBlockColour)));
    }
  }
}

TEST(TestBlockTiles, NoBlocksHaveNoTiles)
{
  const BlockTiles tiles(SparseMatrix<double>(0, 0), {}, SerialContext());
  EXPECT_EQ(tiles.Size(), 0);
  EXPECT_EQ(tiles.ColoursOfTiles(), std::vector<int>{ 0 });
}

TEST(TestBlockTiles, SameTilesForAnyNumberOfThreads)
{
  const test::Squares ring = test::Ring(2000);
  const BlockTiles expected(ring.Bt, ring.Blocks, SerialContext());
  for (const int threads : { 2, 3, 8 })
  {
    const BlockTiles tiles(ring.Bt, ring.Blocks, test::TbbContext(threads));
    EXPECT_EQ(tiles.BlockColours(), expected.BlockColours());
    EXPECT_EQ(tiles.ColoursOfTiles(), expected.ColoursOfTiles());
  }
}
