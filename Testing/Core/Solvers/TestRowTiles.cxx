#include "Solvers/Kernels/RowTiles.h"

#include "Solvers/Kernels/RowRuns.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

using namespace dmg;

namespace
{

/// Rows of three entries near the diagonal; the last rows also touch the first columns.
SparseMatrix<double> Band(int rows)
{
  test::Random random(3801);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < rows; ++i)
  {
    for (const int j : { i, (i + 1) % rows, (i + 7) % rows })
    {
      entries.emplace_back(i, j, random.Uniform(-1.0, 1.0));
    }
  }
  return test::FromTriplets(rows, rows, entries);
}

Vector<double> AdjointProduct(
  const RowTiles& tiles, const SparseMatrix<double>& A, const Vector<double>& x, const ExecutionContext& context)
{
  Vector<double> y = Vector<double>::Zero(A.cols());
  const RowRuns<double> runs(A);
  tiles.ForTiles(context,
    [&](int, int firstRow, int lastRow)
    {
      runs.AddAdjoint(
        firstRow, lastRow, [&x](int row) { return x[row]; }, y.data());
    });
  return y;
}

}

TEST(RowTiles, NeighboursShareAnItem)
{
  // Parts k and k + 1 share an item, and all multiples of 3 another.
  const PartGraph graph = GraphOfParts(10, 20,
    [](int part, const auto& visit)
    {
      visit(part);
      visit(part + 1);
      visit(part % 3 == 0 ? 19 : part);
    });
  ASSERT_EQ(graph.Size(), 10);
  for (int a = 0; a < 10; ++a)
  {
    EXPECT_TRUE(std::is_sorted(graph.Begin(a), graph.End(a)));
    for (int b = 0; b < 10; ++b)
    {
      const bool areNeighbours = a != b && (std::abs(a - b) == 1 || (a % 3 == 0 && b % 3 == 0));
      EXPECT_EQ(std::count(graph.Begin(a), graph.End(a), b), areNeighbours);
    }
  }
}

TEST(RowTiles, ColoursShareNoItem)
{
  // Parts k and k + 1 share an item, and all multiples of 5 another.
  const PartColouring colouring = ColourParts(40, 100,
    [](int part, const auto& visit)
    {
      visit(part);
      visit(part + 1);
      visit(part);
      if (part % 5 == 0)
      {
        visit(99);
      }
    });
  EXPECT_EQ(std::set<int>(colouring.Parts.begin(), colouring.Parts.end()).size(), 40u);
  EXPECT_EQ(colouring.Begins.back(), 40);
  // Eight share item 99.
  ASSERT_EQ(colouring.Begins.size(), 8u + 1u);
  for (int c = 0; c < 8; ++c)
  {
    EXPECT_LT(colouring.Begins[c], colouring.Begins[c + 1]);
    for (int k = colouring.Begins[c] + 1; k < colouring.Begins[c + 1]; ++k)
    {
      EXPECT_GT(colouring.Parts[k], colouring.Parts[k - 1] + 1);
    }
  }
  EXPECT_EQ(ColourParts(0, 10, [](int, const auto&) {}).Begins, std::vector<int>(1, 0));
}

TEST(RowTiles, ProductsWithTheTransposeAreThoseOfTheMatrix)
{
  for (const int rows : { 0, 10, 4096, 50000 })
  {
    const SparseMatrix<double> A = rows > 0 ? Band(rows) : SparseMatrix<double>(0, 0);
    const RowTiles tiles(A);
    EXPECT_EQ(tiles.Size(), (rows + 4095) / 4096);
    const auto x = test::RandomVector<double>(rows, 3802);
    const Vector<double> product = AdjointProduct(tiles, A, x, SerialContext());
    const Vector<double> expected = A.transpose() * x;
    EXPECT_LE((product - expected).norm(), 1e-14 * (1.0 + expected.norm()));
    for (const int threads : { 1, 2, 5 })
    {
      EXPECT_EQ(AdjointProduct(tiles, A, x, test::TbbContext(threads)), product);
    }
  }
}
