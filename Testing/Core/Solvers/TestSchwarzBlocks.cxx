#include "Solvers/SchwarzBlocks.h"

#include "SquaresProblem.h"
#include "Support/Errors.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
// Blocks are scaled to ones on the diagonal and get 1e-6 more there, which changes an inverse by as
// much times its condition; single precision rounds it.
constexpr double RidgeAndRounding = 1.2e-6;

/// From a lower triangle by rows.
Eigen::MatrixXd Unpacked(const float* triangle, int size)
{
  Eigen::MatrixXd full(size, size);
  for (int i = 0; i < size; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      full(i, j) = *triangle;
      full(j, i) = *triangle++;
    }
  }
  return full;
}

/// All blocks against the inverses of dense matrices.
void ExpectInverses(const SchwarzBlocks& blocks, const Eigen::MatrixXd& A)
{
  for (int k = 0; k < blocks.Blocks().Size(); ++k)
  {
    const std::vector<int> members = test::MembersOf(blocks.Blocks(), k);
    const int size = static_cast<int>(members.size());
    ASSERT_EQ(blocks.InverseSize(k), members.size() * (members.size() + 1) / 2);
    const Eigen::MatrixXd expected = test::BlockOf(A, members).inverse();
    const double condition = expected.norm() * test::BlockOf(A, members).norm();
    EXPECT_LE((Unpacked(blocks.Inverse(k), size) - expected).norm(),
      condition * RidgeAndRounding * expected.norm())
      << "block " << k;
  }
}

/// Tiles as pairs of first and last block, by colour.
std::vector<std::vector<std::pair<int, int>>> Tiles(const SchwarzBlocks& blocks)
{
  std::vector<std::vector<std::pair<int, int>>> tiles(blocks.NumberOfColours());
  for (int colour = 0; colour < blocks.NumberOfColours(); ++colour)
  {
    blocks.ForTiles(colour, SerialContext(),
      [&](int t) { tiles[colour].emplace_back(blocks.TileAt(t).First, blocks.TileAt(t).Last); });
  }
  return tiles;
}

/// Each block is in one tile, and no two tiles of a colour share a row of B.
void ExpectColoured(const test::Squares& squares, const SchwarzBlocks& blocks)
{
  std::vector<int> visits(squares.Blocks.Size(), 0);
  for (const auto& tiles : Tiles(blocks))
  {
    EXPECT_FALSE(tiles.empty());
    std::vector<int> tileOfRow(squares.B.rows(), -1);
    for (int tile = 0; tile < static_cast<int>(tiles.size()); ++tile)
    {
      for (int block = tiles[tile].first; block < tiles[tile].second; ++block)
      {
        ++visits[block];
        for (const int unknown : test::MembersOf(blocks.Blocks(), block))
        {
          for (SparseMatrix<double>::InnerIterator row(squares.Bt, unknown); row; ++row)
          {
            EXPECT_TRUE(tileOfRow[row.col()] < 0 || tileOfRow[row.col()] == tile)
              << "row " << row.col();
            tileOfRow[row.col()] = tile;
          }
        }
      }
    }
  }
  EXPECT_EQ(visits, std::vector<int>(squares.Blocks.Size(), 1));
}

std::size_t NumberOfTiles(const SchwarzBlocks& blocks)
{
  std::size_t sum = 0;
  for (const auto& tiles : Tiles(blocks))
  {
    sum += tiles.size();
  }
  return sum;
}

}

TEST(TestSchwarzBlocks, InversesAreThoseOfTheMatrix)
{
  for (const test::Squares& squares : { test::Ring(60), test::Fan(30) })
  {
    const SchwarzBlocks blocks(squares.Bt, squares.Blocks, SerialContext());
    ExpectInverses(blocks, squares.Matrix());
  }
}

TEST(TestSchwarzBlocks, InversesOfSomeBlocksWithADiagonal)
{
  const test::Squares ring = test::Ring(40);
  const SchwarzBlocks blocks(ring.Bt, ring.Blocks, SerialContext());
  Vector<double> D = Vector<double>::Zero(40);
  D[4] = 0.3;
  D[5] = 1e6;
  D[9] = Infinity;
  D[10] = Infinity;
  D[11] = Infinity;
  const Eigen::MatrixXd A = ring.Matrix();
  std::vector<int> wanted; // 2 to 5, 8 to 11, 4 to 7, 30 to 33, wherever they stand
  for (const int first : { 2, 8, 4, 30 })
  {
    int k = 0;
    while (test::MembersOf(blocks.Blocks(), k).front() != first)
    {
      ++k;
    }
    wanted.push_back(k);
  }
  std::vector<std::vector<float>> inverses;
  std::vector<float*> places;
  for (const int k : wanted)
  {
    inverses.emplace_back(blocks.InverseSize(k), -1.0f);
  }
  for (std::vector<float>& inverse : inverses)
  {
    places.push_back(inverse.data());
  }
  blocks.Invert(ring.Bt, D, wanted, places, SerialContext());
  for (std::size_t n = 0; n < wanted.size(); ++n)
  {
    SCOPED_TRACE(wanted[n]);
    const std::vector<int> members = test::MembersOf(blocks.Blocks(), wanted[n]);
    std::vector<int> free; // places in the block
    Eigen::MatrixXd block = test::BlockOf(A, members);
    for (int i = 0; i < 4; ++i)
    {
      if (std::isfinite(D[members[i]]))
      {
        free.push_back(i);
        block(i, i) += D[members[i]];
      }
    }
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(4, 4);
    const Eigen::MatrixXd ofFree = test::BlockOf(block, free).inverse();
    expected(free, free) = ofFree;
    const Eigen::MatrixXd inverse = Unpacked(inverses[n].data(), 4);
    EXPECT_LE((inverse - expected).norm(), 50 * RidgeAndRounding * expected.norm());
    for (int i = 0; i < 4; ++i)
    {
      if (!std::isfinite(D[members[i]]))
      {
        EXPECT_EQ(inverse.row(i).norm(), 0.0);
      }
      else
      {
        EXPECT_GT(inverse(i, i), 0.0);
      }
    }
  }
}

TEST(TestSchwarzBlocks, DependentUnknownsHaveAnInverseAndEmptyOnesNone)
{
  // Columns 0 and 1 are the same, 2 is empty.
  const SparseMatrix<double> B = test::FromTriplets<double>(
    2, 4, { { 0, 0, 0.6 }, { 1, 0, 0.8 }, { 0, 1, 0.6 }, { 1, 1, 0.8 }, { 1, 3, 1.0 } });
  UnknownBlocks all;
  all.Unknowns = { 0, 1, 2, 3 };
  all.EndBlock();
  const SchwarzBlocks blocks(B.transpose(), all, SerialContext());
  const Eigen::MatrixXd inverse = Unpacked(blocks.Inverse(0), 4);
  ASSERT_TRUE(inverse.allFinite());
  EXPECT_EQ(inverse.row(2).norm(), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(inverse).eigenvalues().minCoeff(),
    -1e-7 * inverse.norm());
}

TEST(TestSchwarzBlocks, TilesOfAColourShareNoRow)
{
  // Tiles hold 16 blocks at least; beyond 128 x 16 blocks they grow.
  for (const int size : { 20, 200, 2000, 9000, 20000 })
  {
    SCOPED_TRACE(size);
    const test::Squares ring = test::Ring(size);
    const SchwarzBlocks blocks(ring.Bt, ring.Blocks, SerialContext());
    ExpectColoured(ring, blocks);
    const int count = ring.Blocks.Size();
    const int ofTile = std::max(16, count / 128);
    EXPECT_EQ(NumberOfTiles(blocks), static_cast<std::size_t>((count + ofTile - 1) / ofTile));
    // Neighbours along a ring: two colours, and a third where it closes oddly.
    EXPECT_LE(blocks.NumberOfColours(), 3);
    EXPECT_EQ(blocks.NumberOfColours() > 1, count > 16);
  }
}

TEST(TestSchwarzBlocks, TilesThatAllShareARowAreAColourEach)
{
  const test::Squares fan = test::Fan(150);
  const SchwarzBlocks blocks(fan.Bt, fan.Blocks, SerialContext());
  ExpectColoured(fan, blocks);
  EXPECT_EQ(NumberOfTiles(blocks), 10u); // of 16 blocks
  EXPECT_EQ(blocks.NumberOfColours(), 10);
}

TEST(TestSchwarzBlocks, NoBlocksHaveNoColour)
{
  const SchwarzBlocks blocks(test::Ring(8).Bt, {}, SerialContext());
  EXPECT_EQ(blocks.NumberOfColours(), 0);
  EXPECT_EQ(blocks.Blocks().Size(), 0);
}

TEST(TestSchwarzBlocks, LargeBlocksAreRefused)
{
  const test::Squares ring = test::Ring(80);
  const auto blocksOf = [](int size)
  {
    UnknownBlocks blocks;
    blocks.Unknowns = { 0, 1 };
    blocks.EndBlock();
    for (int i = 2; i < 2 + size; ++i)
    {
      blocks.Unknowns.push_back(i);
    }
    blocks.EndBlock();
    return blocks;
  };
  const SchwarzBlocks largest(ring.Bt, blocksOf(SchwarzBlocks::LargestBlock), SerialContext());
  ExpectInverses(largest, ring.Matrix());
  try
  {
    SchwarzBlocks(ring.Bt, blocksOf(SchwarzBlocks::LargestBlock + 1), SerialContext());
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    const std::string message = error.what();
    EXPECT_NE(message.find("block 1 holds 65"), std::string::npos) << message;
    EXPECT_NE(message.find("at most 64"), std::string::npos) << message;
  }
}

TEST(TestSchwarzBlocks, SameBitsForAnyNumberOfThreads)
{
  const test::Squares ring = test::Ring(20000);
  const SchwarzBlocks expected(ring.Bt, ring.Blocks, SerialContext());
  for (const int threads : { 1, 2, 5 })
  {
    const SchwarzBlocks blocks(ring.Bt, ring.Blocks, test::TbbContext(threads));
    EXPECT_EQ(Tiles(blocks), Tiles(expected));
    for (int k = 0; k < ring.Blocks.Size(); ++k)
    {
      ASSERT_TRUE(std::equal(
        blocks.Inverse(k), blocks.Inverse(k) + blocks.InverseSize(k), expected.Inverse(k)))
        << "block " << k;
    }
  }
}
