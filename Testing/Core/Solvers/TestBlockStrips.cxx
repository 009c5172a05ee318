#include "Solvers/LeastSquares/BlockStrips.h"

#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace dmg;

namespace
{

/// A band of width x length unknowns, row by row, and a row of B for each, which this and the next ones in its
/// row and its column touch; each unknown is a block.
struct Band
{
  Band(int width, int length)
    : Width(width)
    , B(width * length, width * length)
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < width * length; ++i)
    {
      for (const int j : { i, i % width + 1 < width ? i + 1 : i, i + width < width * length ? i + width : i })
      {
        entries.emplace_back(i, j, 1.0);
      }
      this->Blocks.Unknowns.push_back(i);
      this->Blocks.EndBlock();
    }
    this->B.setFromTriplets(entries.begin(), entries.end());
  }

  int Width;
  SparseMatrix<double> B;
  UnknownBlocks Blocks;
};

}

TEST(TestBlockStrips, BlocksThatShareARowAreInTheSameStripOrTheNext)
{
  const Band band(12, 70);
  for (const int smallest : { 1, 30, 200 })
  {
    const BlockStrips strips = StripsOf(band.B.transpose(), band.Blocks, smallest, test::TbbContext(2));
    ASSERT_EQ(static_cast<int>(strips.OfBlocks.size()), band.Blocks.Size());
    std::vector<int> sizes(strips.Size, 0);
    for (const int strip : strips.OfBlocks)
    {
      ASSERT_LT(strip, strips.Size);
      ++sizes[strip];
    }
    for (int strip = 0; strip + 1 < strips.Size; ++strip)
    {
      EXPECT_GE(sizes[strip], smallest);
      // A level of the band holds two diagonals at most.
      EXPECT_LT(sizes[strip], smallest + 2 * band.Width);
    }
    EXPECT_GE(strips.Size, band.Blocks.Size() / (smallest + 2 * band.Width));
    for (int row = 0; row < band.B.rows(); ++row)
    {
      int least = strips.Size;
      int most = 0;
      for (SparseMatrix<double>::InnerIterator entry(band.B, row); entry; ++entry)
      {
        least = std::min(least, strips.OfBlocks[entry.col()]);
        most = std::max(most, strips.OfBlocks[entry.col()]);
      }
      EXPECT_LE(most, least + 1);
    }
  }
}

TEST(TestBlockStrips, SameStripsForAnyNumberOfThreads)
{
  const Band band(15, 90);
  const BlockStrips expected = StripsOf(band.B.transpose(), band.Blocks, 20, SerialContext());
  for (const int threads : { 2, 3, 5 })
  {
    const BlockStrips strips = StripsOf(band.B.transpose(), band.Blocks, 20, test::TbbContext(threads));
    EXPECT_EQ(strips.OfBlocks, expected.OfBlocks);
    EXPECT_EQ(strips.Size, expected.Size);
  }
}

TEST(TestBlockStrips, AFewBlocksOfTheirOwnJoinWhatIsBeforeThem)
{
  // The middle of the band shares its row with no others.
  Band band(10, 40);
  const int alone = 205;
  band.B.prune([alone](int row, int column, double)
    { return (row == alone) == (column == alone); });
  const BlockStrips strips = StripsOf(band.B.transpose(), band.Blocks, 20, SerialContext());
  EXPECT_EQ(strips.OfBlocks[alone], strips.OfBlocks[alone - 1]);
}

TEST(TestBlockStrips, NoBlocks)
{
  const BlockStrips strips = StripsOf(SparseMatrix<double>(0, 0), {}, 10, SerialContext());
  EXPECT_TRUE(strips.OfBlocks.empty());
  EXPECT_EQ(strips.Size, 0);
}
