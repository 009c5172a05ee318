#include "Solvers/LeastSquares/BlockGroups.h"

#include "LeastSquaresProblem.h"
#include "Solvers/Kernels/Packs.h"
#include "Support/Errors.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

using namespace dmg;

namespace
{

constexpr int PackLanes = LanesOf<FloatPack>;

BlockGroups GroupsOf(const test::Squares& squares, const ExecutionContext& context = SerialContext())
{
  return GroupBlocks(squares.Bt, squares.Blocks, context);
}

std::vector<int> UnknownsOf(const BlockGroups& groups, const BlockGroups::Group& group, int lane)
{
  std::vector<int> unknowns;
  for (int i = 0; i < groups.PatternOf(group).Unknowns(); ++i)
  {
    unknowns.push_back(groups.Unknowns(group)[i * group.Lanes + lane]);
  }
  return unknowns;
}

std::set<int> RowsOf(const test::Squares& squares, int unknown)
{
  std::set<int> rows;
  for (SparseMatrix<double>::InnerIterator row(squares.Bt, unknown); row; ++row)
  {
    rows.insert(static_cast<int>(row.col()));
  }
  return rows;
}

/// The pattern of a group and its rows against B, for one block.
void ExpectPattern(const test::Squares& squares, const BlockGroups& groups, const BlockGroups::Group& group, int lane)
{
  const BlockPattern& pattern = groups.PatternOf(group);
  const std::vector<int> unknowns = UnknownsOf(groups, group, lane);
  const auto rowAt = [&](int k) { return groups.Rows(group)[k * group.Lanes + lane]; };
  std::vector<std::set<int>> unknownsOfRows(pattern.Rows());
  for (int i = 0; i < pattern.Unknowns(); ++i)
  {
    std::set<int> rows;
    for (int e = pattern.Offsets[i]; e < pattern.Offsets[i + 1]; ++e)
    {
      rows.insert(rowAt(pattern.RowOf[e]));
      unknownsOfRows[pattern.RowOf[e]].insert(i);
    }
    EXPECT_EQ(rows, RowsOf(squares, unknowns[i]));
  }
  const SparseMatrix<double> B = squares.Bt.transpose();
  for (int k = 0; k < pattern.Rows(); ++k)
  {
    std::set<int> byRow;
    for (int s = pattern.RowOffsets[k]; s < pattern.RowOffsets[k + 1]; ++s)
    {
      byRow.insert(pattern.UnknownAt[s]);
      EXPECT_EQ(pattern.RowOf[pattern.EntryAt[s]], k);
    }
    EXPECT_EQ(byRow, unknownsOfRows[k]);
    const int all = B.outerIndexPtr()[rowAt(k) + 1] - B.outerIndexPtr()[rowAt(k)];
    EXPECT_EQ(k < pattern.InnerRows, static_cast<int>(byRow.size()) == all);
  }
}

}

TEST(TestBlockGroups, PatternsAreThoseOfTheFactor)
{
  for (const test::Squares& squares :
    { test::Ring(60), test::Fan(30), test::Sides(9), test::Wheels(9, 6), test::Wheels(4, 5) })
  {
    const BlockGroups groups = GroupsOf(squares);
    for (const BlockGroups::Group& group : groups.Groups)
    {
      for (int lane = 0; lane < group.Lanes; ++lane)
      {
        ExpectPattern(squares, groups, group, lane);
      }
    }
  }
}

TEST(TestBlockGroups, HoldEachBlockOnce)
{
  for (const test::Squares& squares : { test::Ring(400), test::Fan(30), test::Wheels(9, 6) })
  {
    const BlockGroups groups = GroupsOf(squares);
    std::vector<std::vector<int>> grouped, expected;
    for (const BlockGroups::Group& group : groups.Groups)
    {
      EXPECT_EQ(group.Lanes, group.Blocks > 1 ? PackLanes : 1);
      for (int lane = 0; lane < group.Lanes; ++lane)
      {
        // Lanes that are left repeat the first.
        EXPECT_TRUE(lane < group.Blocks || UnknownsOf(groups, group, lane) == UnknownsOf(groups, group, 0));
        if (lane < group.Blocks)
        {
          grouped.push_back(UnknownsOf(groups, group, lane));
        }
      }
    }
    for (int k = 0; k < squares.Blocks.Size(); ++k)
    {
      expected.push_back(test::MembersOf(squares.Blocks, k));
    }
    std::sort(grouped.begin(), grouped.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(grouped, expected);
  }
}

TEST(TestBlockGroups, BlocksOfARunShareNoRow)
{
  for (const test::Squares& squares : { test::Ring(400), test::Fan(30), test::Wheels(40, 6) })
  {
    const BlockGroups groups = GroupsOf(squares);
    ASSERT_EQ(groups.RunBegins.back(), static_cast<int>(groups.Groups.size()));
    ASSERT_EQ(groups.TileBegins.back(), static_cast<int>(groups.RunBegins.size()) - 1);
    for (std::size_t run = 0; run + 1 < groups.RunBegins.size(); ++run)
    {
      std::set<int> taken;
      for (int g = groups.RunBegins[run]; g < groups.RunBegins[run + 1]; ++g)
      {
        const BlockGroups::Group& group = groups.Groups[g];
        for (int lane = 0; lane < group.Blocks; ++lane)
        {
          for (int k = 0; k < groups.PatternOf(group).Rows(); ++k)
          {
            EXPECT_TRUE(taken.insert(groups.Rows(group)[k * group.Lanes + lane]).second);
          }
        }
      }
    }
  }
}

TEST(TestBlockGroups, OrdersAreByFirstOccurrenceAndRenumberingFollows)
{
  const test::Squares squares = test::Wheels(9, 6);
  BlockGroups groups = GroupsOf(squares);
  const auto placesOf = [](const std::vector<int>& order)
  {
    std::vector<int> places(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
    {
      places[order[k]] = static_cast<int>(k);
    }
    return places;
  };
  const std::vector<int> unknowns = placesOf(groups.OrderOfUnknowns(squares.Size()));
  const std::vector<int> rows = placesOf(groups.OrderOfRows(static_cast<int>(squares.B.rows())));
  std::vector<int> expected = groups.Indices;
  int largestUnknown = -1;
  int largestRow = -1;
  for (const BlockGroups::Group& group : groups.Groups)
  {
    const int ofUnknowns = groups.PatternOf(group).Unknowns() * group.Lanes;
    const int all = ofUnknowns + groups.PatternOf(group).Rows() * group.Lanes;
    for (int s = 0; s < all; ++s)
    {
      int& index = expected[group.Indices + s];
      index = s < ofUnknowns ? unknowns[index] : rows[index];
      int& largest = s < ofUnknowns ? largestUnknown : largestRow;
      EXPECT_LE(index, largest + 1); // new ones follow those before
      largest = std::max(largest, index);
    }
  }
  groups.Renumber(unknowns, rows);
  EXPECT_EQ(groups.Indices, expected);
}

TEST(TestBlockGroups, RefusesBlocksOfTooManyRows)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row <= BlockGroups::MostRows; ++row)
  {
    entries.emplace_back(row, 0, 1.0);
  }
  UnknownBlocks one;
  one.Unknowns = { 0 };
  one.EndBlock();
  const test::Squares squares(test::FromTriplets(BlockGroups::MostRows + 1, 1, entries), one);
  try
  {
    GroupsOf(squares);
    FAIL() << "nothing was refused";
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("block 0 touches 513 rows"), std::string::npos) << error.what();
  }
}

TEST(TestBlockGroups, SameGroupsForAnyNumberOfThreads)
{
  const test::Squares ring = test::Ring(2000);
  const BlockGroups expected = GroupsOf(ring);
  for (const int threads : { 2, 3, 8 })
  {
    const BlockGroups groups = GroupsOf(ring, test::TbbContext(threads));
    EXPECT_EQ(groups.Indices, expected.Indices);
    EXPECT_EQ(groups.RunBegins, expected.RunBegins);
    EXPECT_EQ(groups.TileBegins, expected.TileBegins);
  }
}
