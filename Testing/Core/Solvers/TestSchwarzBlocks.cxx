#include "Solvers/LeastSquares/SchwarzBlocks.h"

#include "LeastSquaresProblem.h"
#include "Solvers/Kernels/Packs.h"
#include "Support/AllIndices.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
// Blocks are scaled to ones on the diagonal and get 1e-6 more there, which changes an inverse by as
// much times its condition; single precision rounds it.
constexpr double RidgeAndRounding = 1.2e-6;

/// From the lower triangles by rows of a group.
Eigen::MatrixXd Unpacked(const float* triangles, int size, int lanes, int lane)
{
  Eigen::MatrixXd full(size, size);
  triangles += lane;
  for (int i = 0; i < size; ++i)
  {
    for (int j = 0; j <= i; ++j, triangles += lanes)
    {
      full(i, j) = *triangles;
      full(j, i) = *triangles;
    }
  }
  return full;
}

template <class Visit>
void ForBlocks(const SchwarzBlocks& blocks, const Visit& visit)
{
  for (int g = 0; g < static_cast<int>(blocks.Groups().size()); ++g)
  {
    for (int lane = 0; lane < blocks.Groups()[g].Lanes; ++lane)
    {
      visit(blocks.Groups()[g], lane, test::MembersOf(blocks, blocks.Groups()[g], lane));
    }
  }
}

/// All blocks against the inverses of dense matrices.
void ExpectInverses(const SchwarzBlocks& blocks, const Eigen::MatrixXd& A)
{
  ForBlocks(blocks,
    [&](const SchwarzBlocks::Group& group, int lane, const std::vector<int>& members)
    {
      const int size = static_cast<int>(members.size());
      ASSERT_EQ(blocks.InverseSize(group), members.size() * (members.size() + 1) / 2 * group.Lanes);
      const Eigen::MatrixXd expected = test::BlockOf(A, members).inverse();
      const double condition = expected.norm() * test::BlockOf(A, members).norm();
      EXPECT_LE((Unpacked(blocks.Inverse(group), size, group.Lanes, lane) - expected).norm(),
        condition * RidgeAndRounding * expected.norm())
        << "block of " << members[0];
    });
}

/// Row k of a block of a group.
int RowOf(const SchwarzBlocks& blocks, const SchwarzBlocks::Group& group, int k, int lane)
{
  const int inner = blocks.PatternOf(group).InnerRows;
  const int* const places = blocks.PlacesOf(group);
  const int place = group.FirstPlace < 0 ? places[blocks.NumberOfUnknowns(group) + k * group.Lanes + lane]
    : k < inner                          ? places[k] + lane
                                         : places[inner + (k - inner) * group.Lanes + lane];
  const auto found = std::find(blocks.PlacesOfRows().begin(), blocks.PlacesOfRows().end(), place);
  return static_cast<int>(found - blocks.PlacesOfRows().begin());
}

/// The columns of B of all blocks, as groups hold them.
void ExpectEntries(const SchwarzBlocks& blocks, const test::Squares& squares)
{
  const Eigen::MatrixXf B = Eigen::MatrixXd(squares.B).cast<float>();
  ForBlocks(blocks,
    [&](const SchwarzBlocks::Group& group, int lane, const std::vector<int>& members)
    {
      const BlockPattern& pattern = blocks.PatternOf(group);
      Eigen::MatrixXf columns = Eigen::MatrixXf::Zero(squares.B.rows(), members.size());
      Eigen::MatrixXf byRow = columns;
      const auto rowOf = [&](int k) { return RowOf(blocks, group, k, lane); };
      const auto valueOf = [&](int e) { return blocks.Values(group)[e * group.Lanes + lane]; };
      for (int i = 0; i < pattern.Unknowns(); ++i)
      {
        for (int e = pattern.Offsets[i]; e < pattern.Offsets[i + 1]; ++e)
        {
          columns(rowOf(pattern.RowOf[e]), i) = valueOf(e);
        }
      }
      for (int k = 0; k < pattern.Rows(); ++k)
      {
        for (int s = pattern.RowOffsets[k]; s < pattern.RowOffsets[k + 1]; ++s)
        {
          byRow(rowOf(k), pattern.UnknownAt[s]) = valueOf(pattern.EntryAt[s]);
        }
      }
      EXPECT_EQ(columns, B(All, members));
      EXPECT_EQ(byRow, columns);
    });
}

/// Lists of unknowns, ascending.
std::vector<std::vector<int>> Sorted(const UnknownBlocks& blocks)
{
  std::vector<std::vector<int>> sorted;
  for (int k = 0; k < blocks.Size(); ++k)
  {
    sorted.push_back(test::MembersOf(blocks, k));
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::vector<int> UnknownsOfTile(const SchwarzBlocks& blocks, int tile)
{
  UnknownBlocks ofTile;
  test::AppendBlocks(blocks, blocks.TileAt(tile), ofTile);
  return ofTile.Unknowns;
}

std::set<int> RowsOf(const test::Squares& squares, const std::vector<int>& unknowns)
{
  std::set<int> rows;
  for (const int unknown : unknowns)
  {
    for (SparseMatrix<double>::InnerIterator row(squares.Bt, unknown); row; ++row)
    {
      rows.insert(static_cast<int>(row.col()));
    }
  }
  return rows;
}

/// Each block is in one tile. No two tiles of a colour share a row of B, and no two blocks of a run.
void ExpectParted(const test::Squares& squares, const SchwarzBlocks& blocks)
{
  EXPECT_EQ(Sorted(test::BlocksInOrder(blocks)), Sorted(squares.Blocks));
  const std::vector<int>& colours = blocks.ColoursOfTiles();
  ASSERT_EQ(colours.back(), blocks.NumberOfTiles());
  for (std::size_t colour = 0; colour + 1 < colours.size(); ++colour)
  {
    std::set<int> taken;
    for (int t = colours[colour]; t < colours[colour + 1]; ++t)
    {
      for (const int row : RowsOf(squares, UnknownsOfTile(blocks, t)))
      {
        EXPECT_TRUE(taken.insert(row).second) << "row " << row;
      }
    }
  }
  for (int t = 0; t < blocks.NumberOfTiles(); ++t)
  {
    const SchwarzBlocks::Tile tile = blocks.TileAt(t);
    for (int k = tile.First; k < tile.Last; ++k)
    {
      std::set<int> taken;
      for (int g = blocks.RunAt(k).First; g < blocks.RunAt(k).Last; ++g)
      {
        const SchwarzBlocks::Group& group = blocks.Groups()[g];
        for (int lane = 0; lane < group.Blocks; ++lane)
        {
          for (const int row : RowsOf(squares, test::MembersOf(blocks, group, lane)))
          {
            EXPECT_TRUE(taken.insert(row).second) << "row " << row;
          }
        }
      }
    }
  }
}

}

TEST(TestSchwarzBlocks, InversesAreThoseOfTheMatrix)
{
  for (const test::Squares& squares :
    { test::Ring(60), test::Fan(30), test::Sides(9), test::Wheels(9, 6), test::Wheels(4, 5) })
  {
    const SchwarzBlocks blocks = test::BlocksOf(squares);
    ExpectInverses(blocks, squares.Matrix());
    ExpectEntries(blocks, squares);
  }
}

TEST(TestSchwarzBlocks, BlocksThatLookAlikeShareLanes)
{
  // All blocks of a ring look alike, and a colour has a half or a third of those of a tile.
  const test::Squares ring = test::Ring(20000);
  const SchwarzBlocks blocks = test::BlocksOf(ring);
  int inLanes = 0;
  for (const SchwarzBlocks::Group& group : blocks.Groups())
  {
    inLanes += group.Lanes == LanesOf<FloatPack> ? group.Blocks : 0;
  }
  EXPECT_GE(inLanes, 0.85 * ring.Blocks.Size());
  // No two blocks of a fan are independent.
  const test::Squares fan = test::Fan(150);
  const SchwarzBlocks alone = test::BlocksOf(fan);
  for (const SchwarzBlocks::Group& group : alone.Groups())
  {
    EXPECT_EQ(group.Lanes, 1);
  }
}

TEST(TestSchwarzBlocks, WhatAGroupHasToItselfStandsSideBySide)
{
  for (const test::Squares& squares : { test::Sides(12), test::Wheels(8, 6) })
  {
    const SchwarzBlocks blocks = test::BlocksOf(squares);
    for (const std::vector<int>& all : { blocks.UnknownsAt(), blocks.PlacesOfRows() })
    {
      std::vector<int> sorted = all;
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(sorted, Identity(static_cast<int>(all.size())));
    }
    for (const SchwarzBlocks::Group& group : blocks.Groups())
    {
      // No block touches unknowns of another, and so all full packs have theirs to themselves.
      EXPECT_EQ(group.FirstPlace >= 0, group.Blocks == LanesOf<FloatPack>);
    }
  }
  // Each unknown of a ring is in two blocks.
  const test::Squares ring = test::Ring(400);
  const SchwarzBlocks shared = test::BlocksOf(ring);
  EXPECT_TRUE(std::any_of(shared.Groups().begin(), shared.Groups().end(),
    [](const SchwarzBlocks::Group& group) { return group.Lanes > 1 && group.FirstPlace < 0; }));
}

TEST(TestSchwarzBlocks, RowsInsideOfBlocksComeFirst)
{
  const SchwarzBlocks blocks = test::BlocksOf(test::Wheels(8, 6));
  for (const SchwarzBlocks::Group& group : blocks.Groups())
  {
    const BlockPattern& pattern = blocks.PatternOf(group);
    EXPECT_EQ(pattern.InnerRows, pattern.Unknowns() == 12 ? 7 : 0);
    EXPECT_EQ(pattern.Rows(), pattern.Unknowns() == 12 ? 19 : 1);
  }
}

TEST(TestSchwarzBlocks, BlocksLeftOfTheirColoursShareLanes)
{
  // Clusters whose blocks, of an unknown each, share a row, in one tile: a block has its place in the
  // cluster for a colour. The first two colours have five and four blocks, which fill a pack each.
  // The third has the first three clusters': with the last cluster's only block, left of the first
  // colour, they fill another. Of the other four, of two clusters, the two of the fourth colour share a pack. The
  // last cluster's row is not inside of its block, either: an unknown of no block touches it.
  UnknownBlocks alone;
  std::vector<Eigen::Triplet<double>> entries;
  int cluster = 0;
  for (const int size : { 6, 4, 3, 2, 1 })
  {
    for (int place = 0; place < size; ++place)
    {
      const int unknown = alone.Size();
      entries.emplace_back(cluster, unknown, 0.6);
      entries.emplace_back(5 + unknown, unknown, 0.8);
      alone.Unknowns.push_back(unknown);
      alone.EndBlock();
    }
    ++cluster;
  }
  entries.emplace_back(4, 16, 1.0);
  const test::Squares squares(test::FromTriplets(5 + 16, 17, entries), alone);
  const SchwarzBlocks blocks = test::BlocksOf(squares);
  ASSERT_EQ(blocks.NumberOfTiles(), 1);
  ExpectParted(squares, blocks);
  ExpectInverses(blocks, squares.Matrix());
  std::vector<int> sizes;
  for (const SchwarzBlocks::Group& group : blocks.Groups())
  {
    EXPECT_EQ(group.Lanes, group.Blocks > 1 ? LanesOf<FloatPack> : 1);
    sizes.push_back(group.Blocks);
    const std::vector<int> first = test::MembersOf(blocks, group, 0);
    for (int lane = group.Blocks; lane < group.Lanes; ++lane)
    {
      EXPECT_EQ(test::MembersOf(blocks, group, lane), first);
    }
  }
  std::sort(sizes.begin(), sizes.end());
  EXPECT_EQ(sizes, (std::vector<int>{ 1, 1, 2, 4, 4, 4 }));
}

TEST(TestSchwarzBlocks, InversesOfSomeBlocksWithADiagonal)
{
  const test::Squares ring = test::Ring(40);
  const SchwarzBlocks blocks = test::BlocksOf(ring);
  Vector<double> D = Vector<double>::Zero(40);
  D[4] = 0.3;
  D[5] = 1e6;
  D[9] = Infinity;
  D[10] = Infinity;
  D[11] = Infinity;
  const Eigen::MatrixXd A = ring.Matrix();
  std::vector<int> wanted;
  std::vector<std::vector<float>> inverses;
  std::vector<float*> places;
  for (int g = 0; g < static_cast<int>(blocks.Groups().size()); g += 2)
  {
    wanted.push_back(g);
    inverses.emplace_back(blocks.InverseSize(blocks.Groups()[g]), -1.0f);
  }
  for (std::vector<float>& inverse : inverses)
  {
    places.push_back(inverse.data());
  }
  blocks.Invert(D, wanted, places, SerialContext());
  int blocksWithHeld = 0;
  for (std::size_t n = 0; n < wanted.size(); ++n)
  {
    const SchwarzBlocks::Group& group = blocks.Groups()[wanted[n]];
    for (int lane = 0; lane < group.Lanes; ++lane)
    {
      const std::vector<int> members = test::MembersOf(blocks, group, lane);
      SCOPED_TRACE(members[0]);
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
      blocksWithHeld += free.size() < 4;
      Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(4, 4);
      const Eigen::MatrixXd ofFree = test::BlockOf(block, free).inverse();
      expected(free, free) = ofFree;
      const Eigen::MatrixXd inverse = Unpacked(inverses[n].data(), 4, group.Lanes, lane);
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
  EXPECT_GT(blocksWithHeld, 0);
}

TEST(TestSchwarzBlocks, DependentUnknownsHaveAnInverseAndEmptyOnesNone)
{
  // Columns 0 and 1 are the same, 2 is empty.
  const SparseMatrix<double> B =
    test::FromTriplets<double>(2, 4, { { 0, 0, 0.6 }, { 1, 0, 0.8 }, { 0, 1, 0.6 }, { 1, 1, 0.8 }, { 1, 3, 1.0 } });
  UnknownBlocks all;
  all.Unknowns = { 0, 1, 2, 3 };
  all.EndBlock();
  const SchwarzBlocks blocks(B.transpose(), all, SerialContext());
  const Eigen::MatrixXd inverse = Unpacked(blocks.Inverse(blocks.Groups()[0]), 4, 1, 0);
  ASSERT_TRUE(inverse.allFinite());
  EXPECT_EQ(inverse.row(2).norm(), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(inverse).eigenvalues().minCoeff(), -1e-7 * inverse.norm());
}

TEST(TestSchwarzBlocks, TilesAreCutEvenly)
{
  // Tiles hold 16 blocks or so; beyond 128 x 16 blocks they grow.
  for (const int size : { 20, 200, 2000, 9000, 20000 })
  {
    SCOPED_TRACE(size);
    const test::Squares ring = test::Ring(size);
    const SchwarzBlocks blocks = test::BlocksOf(ring);
    ExpectParted(ring, blocks);
    const int count = ring.Blocks.Size();
    const int ofTile = std::max(16, count / 128);
    EXPECT_EQ(blocks.NumberOfTiles(), std::max(1, (count + ofTile / 2) / ofTile));
    for (int t = 0; t < blocks.NumberOfTiles(); ++t)
    {
      const double blocksOfTile = UnknownsOfTile(blocks, t).size() / 4.0;
      EXPECT_NEAR(blocksOfTile, count / double(blocks.NumberOfTiles()), 1.0);
    }
  }
}

TEST(TestSchwarzBlocks, TilesThatAllShareARowHaveAColourEach)
{
  const test::Squares fan = test::Fan(150);
  const SchwarzBlocks blocks = test::BlocksOf(fan);
  ExpectParted(fan, blocks);
  EXPECT_EQ(blocks.NumberOfTiles(), 9); // of 16 or 17 blocks
  EXPECT_EQ(blocks.ColoursOfTiles().size(), 10u);
}

TEST(TestSchwarzBlocks, NoBlocksHaveNoTile)
{
  const SchwarzBlocks blocks(test::Ring(8).Bt, {}, SerialContext());
  EXPECT_EQ(blocks.NumberOfTiles(), 0);
  EXPECT_TRUE(blocks.Groups().empty());
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
  const SchwarzBlocks expected = test::BlocksOf(ring);
  for (const int threads : { 1, 2, 5 })
  {
    const SchwarzBlocks blocks = test::BlocksOf(ring, test::TbbContext(threads));
    EXPECT_EQ(test::BlocksInOrder(blocks).Unknowns, test::BlocksInOrder(expected).Unknowns);
    ASSERT_EQ(blocks.Groups().size(), expected.Groups().size());
    for (std::size_t g = 0; g < blocks.Groups().size(); ++g)
    {
      const SchwarzBlocks::Group& group = blocks.Groups()[g];
      ASSERT_EQ(group.Lanes, expected.Groups()[g].Lanes);
      ASSERT_TRUE(std::equal(blocks.Inverse(group), blocks.Inverse(group) + blocks.InverseSize(group),
        expected.Inverse(expected.Groups()[g])))
        << "group " << g;
    }
  }
}
