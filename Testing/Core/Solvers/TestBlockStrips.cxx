#include "Solvers/BlockStrips.h"

#include "Support/Permutations.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

using namespace dmg;

namespace
{

/// A band of width x length unknowns, row by row, each of which takes from itself and the next ones in its row
/// and its column; each is a block.
struct Band
{
  Band(int width, int length)
    : Width(width)
    , Length(length)
    , P(width * length, width * length)
  {
    std::vector<Eigen::Triplet<Complex>> entries;
    for (int i = 0; i < width * length; ++i)
    {
      for (const int j : { i, i % width + 1 < width ? i + 1 : i, i + width < width * length ? i + width : i })
      {
        entries.emplace_back(i, j, 1.0);
      }
      this->Blocks.Unknowns.push_back(i);
      this->Blocks.EndBlock();
    }
    this->P.setFromTriplets(entries.begin(), entries.end());
  }

  int Width;
  int Length;
  PlanarProlongation P;
  UnknownBlocks Blocks;
};

/// Of each block.
std::vector<int> StripsOfBlocks(const BlockStrips& strips)
{
  std::vector<int> ofBlocks(strips.Order.size(), -1);
  for (std::size_t strip = 0; strip + 1 < strips.Begins.size(); ++strip)
  {
    for (int k = strips.Begins[strip]; k < strips.Begins[strip + 1]; ++k)
    {
      ofBlocks[strips.Order[k]] = static_cast<int>(strip);
    }
  }
  return ofBlocks;
}

void ExpectPermutation(const BlockStrips& strips, int size)
{
  std::vector<int> sorted = strips.Order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, Identity(size));
  EXPECT_EQ(strips.Begins.front(), 0);
  EXPECT_EQ(strips.Begins.back(), size);
  for (std::size_t strip = 0; strip + 1 < strips.Begins.size(); ++strip)
  {
    EXPECT_TRUE(std::is_sorted(strips.Order.begin() + strips.Begins[strip],
      strips.Order.begin() + strips.Begins[strip + 1]));
  }
}

}

TEST(TestBlockStrips, BlocksThatTakeFromTheSameAreInTheSameStripOrTheNext)
{
  const Band band(12, 70);
  for (const int smallest : { 1, 30, 200 })
  {
    const BlockStrips strips = StripsOf(band.P, band.Blocks, smallest, test::TbbContext(2));
    ExpectPermutation(strips, band.Blocks.Size());
    const int count = static_cast<int>(strips.Begins.size()) - 1;
    for (int strip = 0; strip + 1 < count; ++strip)
    {
      EXPECT_GE(strips.Begins[strip + 1] - strips.Begins[strip], smallest);
      // A level of the band holds two diagonals at most.
      EXPECT_LT(strips.Begins[strip + 1] - strips.Begins[strip], smallest + 2 * band.Width);
    }
    EXPECT_GE(count, band.Blocks.Size() / (smallest + 2 * band.Width));
    const std::vector<int> ofBlocks = StripsOfBlocks(strips);
    const Eigen::SparseMatrix<Complex> columns = band.P;
    for (int column = 0; column < columns.cols(); ++column)
    {
      int least = count;
      int most = 0;
      for (Eigen::SparseMatrix<Complex>::InnerIterator taker(columns, column); taker; ++taker)
      {
        least = std::min(least, ofBlocks[taker.row()]);
        most = std::max(most, ofBlocks[taker.row()]);
      }
      EXPECT_LE(most, least + 1);
    }
  }
}

TEST(TestBlockStrips, AFewBlocksOfTheirOwnJoinWhatIsBeforeThem)
{
  // The middle of the band takes from nothing that others take from.
  Band band(10, 40);
  const int alone = 205;
  PlanarProlongation P = band.P;
  P.prune([alone](int row, int column, Complex)
    { return (row == alone) == (column == alone); });
  const BlockStrips strips = StripsOf(P, band.Blocks, 20, SerialContext());
  ExpectPermutation(strips, band.Blocks.Size());
  const std::vector<int> ofBlocks = StripsOfBlocks(strips);
  EXPECT_EQ(ofBlocks[alone], ofBlocks[alone - 1]);
}

TEST(TestBlockStrips, NoBlocks)
{
  const BlockStrips strips = StripsOf(PlanarProlongation(0, 0), {}, 10, SerialContext());
  EXPECT_TRUE(strips.Order.empty());
  EXPECT_EQ(strips.Begins, (std::vector<int>{ 0, 0 }));
}
