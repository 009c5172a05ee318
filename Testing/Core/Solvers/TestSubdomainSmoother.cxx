#include "Solvers/SubdomainSmoother.h"

#include "SquaresProblem.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

using namespace dmg;
using test::Squares;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
// Of a ridge of 1e-12 where the lowest energy is 1e-2 or so, and of rounding.
constexpr double Tolerance = 1e-9;

/// Runs of so many unknowns, each half of which the next one shares.
UnknownBlocks Runs(int size, int length)
{
  UnknownBlocks runs;
  for (int first = 0; first + length <= size; first += length / 2)
  {
    for (int i = first; i < first + length; ++i)
    {
      runs.Unknowns.push_back(i);
    }
    runs.EndBlock();
  }
  return runs;
}

std::vector<Subdomain> SubdomainsOf(const Squares& squares, const UnknownBlocks& runs)
{
  std::vector<Subdomain> subdomains;
  for (int k = 0; k < runs.Size(); ++k)
  {
    std::vector<int> unknowns = test::MembersOf(runs, k);
    std::reverse(unknowns.begin(), unknowns.end());
    subdomains.emplace_back(squares.Bt, unknowns);
  }
  return subdomains;
}

/// Zero but for some unknowns, some of which are held.
Vector<double> SomeHeld(int size)
{
  Vector<double> D = Vector<double>::Zero(size);
  for (int i = 3; i + 2 < size; i += 7)
  {
    D[i] = std::pow(10.0, i % 5 - 2);
    D[i + 2] = Infinity;
  }
  return D;
}

Vector<double> WithoutHeld(const Vector<double>& x, const Vector<double>& D)
{
  return D.array().isFinite().select(x, 0.0);
}

/// Solves exactly for the free unknowns of each run, one after the other.
Vector<double> GaussSeidel(const Squares& squares, const UnknownBlocks& runs,
  const std::vector<int>& order, const Vector<double>& D, const Vector<double>& b, Vector<double> x)
{
  Eigen::MatrixXd A = squares.Matrix();
  A.diagonal() += WithoutHeld(D, D);
  for (const int run : order)
  {
    std::vector<int> free;
    for (const int unknown : test::MembersOf(runs, run))
    {
      if (std::isfinite(D[unknown]))
      {
        free.push_back(unknown);
      }
    }
    const Vector<double> residual = b(free) - A(free, Eigen::all) * x;
    x(free) += test::BlockOf(A, free).llt().solve(residual);
  }
  return x;
}

}

TEST(TestSubdomainSmoother, SubdomainsHoldTheirColumns)
{
  const Squares ring = test::Ring(120);
  for (const Subdomain& run : SubdomainsOf(ring, Runs(110, 36)))
  {
    EXPECT_TRUE(std::is_sorted(run.Unknowns.begin(), run.Unknowns.end()));
    const Eigen::MatrixXd columns = Eigen::MatrixXd(ring.Bt)(run.Unknowns, run.Rows);
    EXPECT_EQ(Eigen::MatrixXd(run.Columns), columns);
    const Eigen::MatrixXd all = Eigen::MatrixXd(ring.Bt)(run.Unknowns, Eigen::all);
    EXPECT_EQ((columns.array() != 0.0).count(), (all.array() != 0.0).count()); // in no other rows
  }
}

TEST(TestSubdomainSmoother, OneSubdomainIsTheInverse)
{
  const Squares ring = test::Ring(60);
  const std::vector<Subdomain> all = SubdomainsOf(ring, Runs(60, 60));
  SubdomainSmoother smoother(ring.B, ring.Tiles, all);
  smoother.SetDiagonal(Vector<double>::Zero(60), SerialContext());
  const Vector<double> exact = test::RandomVector<double>(60, 3501);
  Vector<double> x, r;
  smoother.PreSmooth(ring.Matrix() * exact, x, r, SerialContext());
  EXPECT_LE((x - exact).norm(), Tolerance * exact.norm());
  EXPECT_LE(r.norm(), Tolerance * exact.norm());
  EXPECT_GT(smoother.Bytes(), 0);
}

TEST(TestSubdomainSmoother, IsGaussSeidelBySubdomains)
{
  // Runs 0 and 3 share no square, and so do 1 and 4; 0 and 2 do.
  const Squares ring = test::Ring(120);
  const UnknownBlocks runs = Runs(110, 36);
  ASSERT_EQ(runs.Size(), 5);
  const std::vector<Subdomain> subdomains = SubdomainsOf(ring, runs);
  SubdomainSmoother smoother(ring.B, ring.Tiles, subdomains);
  for (const Vector<double>& D : { Vector<double>(Vector<double>::Zero(120)), SomeHeld(120) })
  {
    smoother.SetDiagonal(D, SerialContext()); // the second time an update
    const auto b = test::RandomVector<double>(120, 3502);
    const Vector<double> zero = Vector<double>::Zero(120);
    Vector<double> x, r;
    smoother.PreSmooth(b, x, r, SerialContext());
    const Vector<double> expected = GaussSeidel(ring, runs, { 0, 3, 1, 4, 2 }, D, b, zero);
    EXPECT_LE((x - expected).norm(), Tolerance * expected.norm());
    Eigen::MatrixXd A = ring.Matrix();
    A.diagonal() += WithoutHeld(D, D);
    EXPECT_LE((r - WithoutHeld(b - A * x, D)).norm(), Tolerance * b.norm());

    Vector<double> y = WithoutHeld(test::RandomVector<double>(120, 3503), D);
    const Vector<double> back = GaussSeidel(ring, runs, { 2, 4, 1, 3, 0 }, D, b, y);
    smoother.PostSmooth(b, y, SerialContext());
    EXPECT_LE((y - back).norm(), Tolerance * back.norm());
  }
}

TEST(TestSubdomainSmoother, NothingChangesFarFromSubdomains)
{
  // Most tiles of rows know of none.
  constexpr int size = 6 * RowTiles::RowsOfTile;
  constexpr int first = 3 * RowTiles::RowsOfTile - 20;
  constexpr int length = 40;
  const Squares ring = test::Ring(size);
  std::vector<int> unknowns(length);
  std::iota(unknowns.begin(), unknowns.end(), first);
  const std::vector<Subdomain> one = { Subdomain(ring.Bt, unknowns) };
  SubdomainSmoother smoother(ring.B, ring.Tiles, one);
  smoother.SetDiagonal(Vector<double>::Zero(size), SerialContext());
  const auto b = test::RandomVector<double>(size, 3505);
  const auto expectSolved = [&](const Vector<double>& x, const Vector<double>& start) {
    const Vector<double> residual = b - ring.Bt * Vector<double>(ring.B * x);
    EXPECT_LE(residual.segment(first, length).norm(), Tolerance * b.norm());
    EXPECT_EQ(x.head(first), start.head(first));
    EXPECT_EQ(x.tail(size - first - length), start.tail(size - first - length));
    return residual;
  };
  Vector<double> x, r;
  smoother.PreSmooth(b, x, r, SerialContext());
  const Vector<double> residual = expectSolved(x, Vector<double>::Zero(size));
  EXPECT_LE((r - residual).norm(), Tolerance * b.norm());
  const auto start = test::RandomVector<double>(size, 3506);
  x = start;
  smoother.PostSmooth(b, x, SerialContext());
  expectSolved(x, start);
}

TEST(TestSubdomainSmoother, FaintFieldsAreSolvedFor)
{
  // Differences along a chain that hangs on a thread: a constant has 1e-9 of the diagonal's energy.
  constexpr int size = 40;
  std::vector<Eigen::Triplet<double>> entries = { { 0, 0, 2e-4 } };
  for (int i = 1; i < size; ++i)
  {
    entries.emplace_back(i, i - 1, -0.5);
    entries.emplace_back(i, i, 0.5);
  }
  const Squares chain(test::FromTriplets<double>(size, size, entries), Runs(size, size));
  const std::vector<Subdomain> whole = SubdomainsOf(chain, chain.Blocks);
  SubdomainSmoother smoother(chain.B, chain.Tiles, whole);
  smoother.SetDiagonal(Vector<double>::Zero(size), SerialContext());
  const Vector<double> constant = Vector<double>::Ones(size);
  Vector<double> x, r;
  smoother.PreSmooth(chain.Matrix() * constant, x, r, SerialContext());
  EXPECT_LE((x - constant).norm(), 2e-3 * constant.norm()); // 1e-12 / 1e-9
}

TEST(TestSubdomainSmoother, SameBitsForAnyNumberOfThreads)
{
  const Squares ring = test::Ring(2000);
  const std::vector<Subdomain> runs = SubdomainsOf(ring, Runs(2000, 50));
  const Vector<double> D = SomeHeld(2000);
  const auto b = test::RandomVector<double>(2000, 3504);
  Vector<double> expected;
  for (const int threads : { 1, 2, 5 })
  {
    const test::TbbContext context(threads);
    SubdomainSmoother smoother(ring.B, ring.Tiles, runs);
    smoother.SetDiagonal(D, context);
    Vector<double> x, r;
    smoother.PreSmooth(b, x, r, context);
    smoother.PostSmooth(b, x, context);
    if (expected.size() == 0)
    {
      expected = x;
    }
    EXPECT_EQ(x, expected) << threads << " threads";
  }
}
