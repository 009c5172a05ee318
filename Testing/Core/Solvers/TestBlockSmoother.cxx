#include "Solvers/LeastSquares/BlockSmoother.h"

#include "LeastSquaresProblem.h"
#include "Support/AllIndices.h"
#include "Support/Permutations.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace dmg;
using test::Fan;
using test::Ring;
using test::Sides;
using test::Squares;
using test::Wheels;

namespace
{

// Steps are taken in single precision.
constexpr double Epsilon = std::numeric_limits<float>::epsilon();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// What inverses with a ridge of 1e-6, in single precision, may change in a few sweeps: three times as much, times
/// the worst condition of a block.
double OfInverses(const Squares& squares)
{
  double worst = 1.0;
  for (int k = 0; k < squares.Blocks.Size(); ++k)
  {
    const Vector<double> spectrum =
      test::Eigenvalues(test::BlockOf(squares.Matrix(), test::MembersOf(squares.Blocks, k)));
    worst = std::max(worst, spectrum.maxCoeff() / spectrum.minCoeff());
  }
  return 3e-6 * worst;
}

struct Smoother : BlockSmoother
{
  Smoother(const Squares& squares, int sweeps, const Vector<double>& D,
    const ExecutionContext& context = SerialContext(), double relaxation = UsualRelaxation)
    : BlockSmoother(squares.B, squares.Tiles, squares.Blocks, D, sweeps, context, relaxation)
  {
  }
  Smoother(const Squares& squares, int sweeps, double relaxation = UsualRelaxation)
    : Smoother(squares, sweeps, Vector<double>::Zero(squares.Size()), SerialContext(), relaxation)
  {
  }
};

/// Blocks that share unknowns or not; few enough that a smoother takes them in the order in which they stand.
std::vector<Squares> AllKinds()
{
  return { Ring(200), Fan(60), Sides(12), Wheels(6, 6), Wheels(6, 5) };
}

/// What both ways make of b, and the residual in between, in one vector.
Vector<double> Smoothed(BlockSmoother& smoother, const Vector<double>& b, const ExecutionContext& context)
{
  Vector<double> x, r;
  smoother.PreSmooth(b, x, r, context);
  Vector<double> all(3 * b.size());
  all << x, r, x;
  smoother.PostSmooth(b, x, context);
  all.tail(b.size()) = x;
  return all;
}

/// Zero but for some unknowns: soft prescriptions of all sizes.
Vector<double> SomeDiagonal(int size, int step = 7)
{
  test::Random random(3109);
  Vector<double> D = Vector<double>::Zero(size);
  for (int i = 3; i < size; i += step)
  {
    D[i] = std::pow(10.0, random.Uniform(-3.0, 3.0));
  }
  return D;
}

/// The same, and some neighbouring unknowns held.
Vector<double> SomeHeld(int size)
{
  Vector<double> D = SomeDiagonal(size);
  for (int i = 0; i + 12 < size; i += 13)
  {
    D[i] = Infinity;
    D[i + 1] = Infinity;
    D[i + 4] = Infinity;
  }
  return D;
}

std::vector<int> FreeAmong(std::vector<int> unknowns, const Vector<double>& D)
{
  const auto isHeld = [&D](int unknown) { return !std::isfinite(D[unknown]); };
  unknowns.erase(std::remove_if(unknowns.begin(), unknowns.end(), isHeld), unknowns.end());
  return unknowns;
}

std::vector<int> FreeOf(const Vector<double>& D)
{
  return FreeAmong(Identity(static_cast<int>(D.size())), D);
}

/// Sweeps over the blocks of a dense matrix, in the order in which they stand or the reverse. Each is solved for exactly
/// and relaxed, but for those that D touches. Held unknowns stay as they are.
Vector<double> Relaxed(const Squares& squares, int sweeps, const Vector<double>& D, const Vector<double>& b,
  Vector<double> x, bool isUp, double relaxation = BlockSmoother::UsualRelaxation)
{
  Eigen::MatrixXd A = squares.Matrix();
  A.diagonal() += D.unaryExpr([](double entry) { return std::isfinite(entry) ? entry : 0.0; });
  std::vector<int> order = Identity(squares.Blocks.Size());
  if (!isUp)
  {
    std::reverse(order.begin(), order.end());
  }
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    for (const int block : order)
    {
      const std::vector<int> members = test::MembersOf(squares.Blocks, block);
      const std::vector<int> free = FreeAmong(members, D);
      const Vector<double> residual = b(free) - A(free, All) * x;
      const double factor = (D(members).array() == 0.0).all() ? relaxation : 1.0;
      x(free) += factor * test::Solved(test::BlockOf(A, free), residual);
    }
  }
  return x;
}

/// The matrix of what smooth(b, x) makes of b.
template <class Smooth>
Eigen::MatrixXd Densified(int size, const Smooth& smooth)
{
  Eigen::MatrixXd S(size, size);
  for (int j = 0; j < size; ++j)
  {
    Vector<double> x = Vector<double>::Zero(size);
    smooth(Vector<double>::Unit(size, j), x);
    S.col(j) = x;
  }
  return S;
}

/// PreSmooth, its residual compared with b - A x, then PostSmooth.
void ExpectSymmetric(const Squares& squares, int sweeps, const Vector<double>& D)
{
  Smoother smoother(squares, sweeps, D);
  const std::vector<int> free = FreeOf(D);
  Eigen::MatrixXd A = squares.Matrix();
  A.diagonal()(free) += D(free);
  const double largest = A.diagonal().maxCoeff();
  const auto pre = Densified(squares.Size(),
    [&](const Vector<double>& b, Vector<double>& x)
    {
      Vector<double> r;
      smoother.PreSmooth(b, x, r, SerialContext());
      const Vector<double> residual = b - A * x;
      EXPECT_LE((r(free) - residual(free)).norm(), 200 * Epsilon * largest);
    });
  const auto post = Densified(
    squares.Size(), [&](const Vector<double>& b, Vector<double>& x) { smoother.PostSmooth(b, x, SerialContext()); });
  EXPECT_LE((post - pre.transpose()).norm(), 200 * Epsilon * largest * pre.norm());
  const auto both = Densified(squares.Size(),
    [&](const Vector<double>& b, Vector<double>& x)
    {
      Vector<double> r;
      smoother.PreSmooth(b, x, r, SerialContext());
      smoother.PostSmooth(b, x, SerialContext());
    });
  EXPECT_LE((both - both.transpose()).norm(), 200 * Epsilon * largest * both.norm());
  EXPECT_GT(test::Eigenvalues(test::BlockOf(both, free)).minCoeff(), 0.0);
}

}

TEST(BlockSmoother, OneBlockIsTheInverse)
{
  Squares ring = Ring(12);
  ring.Blocks = {};
  for (int i = 0; i < ring.Size(); ++i)
  {
    ring.Blocks.Unknowns.push_back((5 * i) % ring.Size());
  }
  ring.Blocks.EndBlock();
  const Eigen::MatrixXd A = ring.Matrix();
  // Each sweep leaves 1e-6 / lambda of an eigenvector, and what single precision makes of it.
  const double lowest = test::Eigenvalues(A).minCoeff();
  ASSERT_GT(lowest, 5e-3);
  const double left = 1e-6 / lowest + 10 * std::numeric_limits<float>::epsilon() / lowest;
  const Vector<double> exact = test::RandomVector<double>(ring.Size(), 3103);
  const Vector<double> b = A * exact;
  for (const int sweeps : { 1, 2, 3 })
  {
    Smoother smoother(ring, sweeps, 1.0);
    Vector<double> x, r;
    smoother.PreSmooth(b, x, r, SerialContext());
    const double bound = std::pow(left, sweeps) + 20 * Epsilon / lowest;
    EXPECT_LE((x - exact).norm(), bound * exact.norm());
    EXPECT_LE(r.norm(), bound * b.norm());
  }
}

TEST(BlockSmoother, IsRelaxationByBlocks)
{
  for (const Squares& squares : AllKinds())
  {
    const double ofInverses = OfInverses(squares);
    const auto b = test::RandomVector<double>(squares.Size(), 3104);
    const auto start = test::RandomVector<double>(squares.Size(), 3110);
    const Vector<double> zero = Vector<double>::Zero(squares.Size());
    for (const int sweeps : { 1, 2 })
    {
      for (const double relaxation : { 0.7, 1.0, 1.4 })
      {
        Smoother smoother(squares, sweeps, relaxation);
        Vector<double> x, r;
        smoother.PreSmooth(b, x, r, SerialContext());
        const auto up = Relaxed(squares, sweeps, zero, b, zero, true, relaxation);
        EXPECT_LE((x - up).norm(), ofInverses * up.norm());
        x = start;
        smoother.PostSmooth(b, x, SerialContext());
        const auto down = Relaxed(squares, sweeps, zero, b, start, false, relaxation);
        EXPECT_LE((x - down).norm(), ofInverses * down.norm());
      }
    }
  }
}

TEST(BlockSmoother, ADiagonalIsOneMoreSquarePerUnknown)
{
  for (const Squares& squares : AllKinds())
  {
    const int size = squares.Size();
    const double ofInverses = OfInverses(squares);
    const auto b = test::RandomVector<double>(size, 3111);
    const Vector<double> zero = Vector<double>::Zero(size);
    // All unknowns, or some of them.
    for (const Vector<double>& D : { Vector<double>(SomeDiagonal(size, 1)), SomeDiagonal(size) })
    {
      // sqrt(D) below B. Each such row holds one unknown and connects no tiles.
      std::vector<Eigen::Triplet<double>> entries;
      for (int i = 0; i < squares.B.outerSize(); ++i)
      {
        for (SparseMatrix<double>::InnerIterator entry(squares.B, i); entry; ++entry)
        {
          entries.emplace_back(i, static_cast<int>(entry.col()), entry.value());
        }
      }
      const int rows = static_cast<int>(squares.B.rows());
      for (int i = 0; i < size; ++i)
      {
        entries.emplace_back(rows + i, i, std::sqrt(D[i]));
      }
      const Squares stacked(test::FromTriplets(rows + size, size, entries), squares.Blocks);

      Smoother smoother(squares, 2, 1.0);
      smoother.SetDiagonal(D, SerialContext());
      Smoother expected(stacked, 2, 1.0);
      EXPECT_TRUE(smoother.HeldUnknowns().empty());
      Vector<double> x, r, y, s;
      smoother.PreSmooth(b, x, r, SerialContext());
      expected.PreSmooth(b, y, s, SerialContext());
      EXPECT_LE((x - y).norm(), 1e-5 * y.norm()); // the same ridge, rounded in other ways
      EXPECT_LE((r - s).norm(), 1e-4 * b.norm());
      const auto up = Relaxed(squares, 2, D, b, zero, true, 1.0);
      EXPECT_LE((x - up).norm(), ofInverses * up.norm());

      smoother.PostSmooth(b, x, SerialContext());
      expected.PostSmooth(b, y, SerialContext());
      EXPECT_LE((x - y).norm(), 1e-5 * y.norm());
      const auto down = Relaxed(squares, 2, D, b, up, false, 1.0);
      EXPECT_LE((x - down).norm(), ofInverses * down.norm());
    }
  }
}

TEST(BlockSmoother, HeldUnknownsStayZero)
{
  // The others are smoothed as if the held ones were not there: the columns of B left out, and the
  // unknowns of blocks.
  for (const Squares& squares : AllKinds())
  {
    const int size = squares.Size();
    const Vector<double> D = SomeHeld(size);
    std::vector<int> held;
    for (int i = 0; i < size; ++i)
    {
      if (!std::isfinite(D[i]))
      {
        held.push_back(i);
      }
    }
    Smoother smoother(squares, 2, D);
    EXPECT_EQ(smoother.HeldUnknowns(), held);

    // Whatever stands in b.
    const double ofInverses = OfInverses(squares);
    const auto b = test::RandomVector<double>(size, 3112);
    const Vector<double> zero = Vector<double>::Zero(size);
    Vector<double> x, r;
    smoother.PreSmooth(b, x, r, SerialContext());
    EXPECT_EQ(x(held).norm(), 0.0);
    EXPECT_EQ(r(held).norm(), 0.0);
    const auto up = Relaxed(squares, 2, D, b, zero, true);
    EXPECT_LE((x - up).norm(), ofInverses * up.norm());
    const std::vector<int> free = FreeOf(D);
    Eigen::MatrixXd A = test::BlockOf(squares.Matrix(), free);
    A.diagonal() += D(free);
    EXPECT_LE((r(free) - (b(free) - A * x(free))).norm(), 100 * Epsilon * A.norm() * b.norm());

    smoother.PostSmooth(b, x, SerialContext());
    EXPECT_EQ(x(held).norm(), 0.0);
    const auto down = Relaxed(squares, 2, D, b, up, false);
    EXPECT_LE((x - down).norm(), ofInverses * down.norm());
  }
}

TEST(BlockSmoother, AllUnknownsHeldLeaveNothing)
{
  const Squares ring = Ring(40);
  Smoother smoother(ring, 2, Vector<double>::Constant(40, Infinity));
  const Vector<double> all = Smoothed(smoother, test::RandomVector<double>(40, 3113), SerialContext());
  EXPECT_EQ(all.norm(), 0.0);
}

TEST(BlockSmoother, DiagonalsComeAndGo)
{
  for (const Squares& squares : { Ring(4000), Fan(60) })
  {
    const int size = squares.Size();
    const auto b = test::RandomVector<double>(size, 3114);
    const Vector<double> zero = Vector<double>::Zero(size);
    Smoother smoother(squares, 2);
    const Vector<double> plain = Smoothed(smoother, b, SerialContext());
    for (const Vector<double>& D :
      { SomeHeld(size), zero, SomeDiagonal(size), SomeDiagonal(size, 1), Vector<double>(3.0 * SomeHeld(size)), zero })
    {
      smoother.SetDiagonal(D, SerialContext());
      Smoother fresh(squares, 2, D);
      const Vector<double> result = Smoothed(smoother, b, SerialContext());
      EXPECT_EQ(result, Smoothed(fresh, b, SerialContext()));
      EXPECT_EQ(smoother.HeldUnknowns(), fresh.HeldUnknowns());
      EXPECT_EQ(D == zero, result == plain);
    }
  }
}

TEST(BlockSmoother, PostIsTheAdjointOfPre)
{
  for (const int sweeps : { 1, 2, 3 })
  {
    SCOPED_TRACE(sweeps);
    for (const Squares& squares : { Ring(40), Ring(100), Fan(20), Fan(40), Sides(9), Wheels(5, 6), Wheels(4, 5) })
    {
      const int size = squares.Size();
      ExpectSymmetric(squares, sweeps, Vector<double>::Zero(size));
      ExpectSymmetric(squares, sweeps, SomeDiagonal(size));
      ExpectSymmetric(squares, sweeps, SomeHeld(size));
    }
  }
}

TEST(BlockSmoother, SweepsReduceTheEnergyOfTheError)
{
  // Each step of a block lowers the energy over it, most where it is not relaxed.
  for (const Squares& squares : { Ring(200), Fan(100) })
  {
    const Eigen::MatrixXd A = squares.Matrix();
    const Vector<double> exact = test::RandomVector<double>(squares.Size(), 3105);
    const Vector<double> b = A * exact;
    double previous = exact.dot(A * exact);
    for (int sweeps = 1; sweeps <= 4; ++sweeps)
    {
      Smoother smoother(squares, sweeps);
      Vector<double> x, r;
      smoother.PreSmooth(b, x, r, SerialContext());
      const Vector<double> error = exact - x;
      EXPECT_LE((r - A * error).norm(), 50 * Epsilon * b.norm());
      const double energy = error.dot(A * error);
      EXPECT_LT(energy, previous);
      previous = energy;
    }
  }
}

TEST(BlockSmoother, HasTheSameBitsForAnyNumberOfThreads)
{
  // More tiles of a colour than threads; and a colour per tile.
  for (const Squares& squares : { Ring(20000), Fan(150) })
  {
    const auto b = test::RandomVector<double>(squares.Size(), 3106);
    std::vector<Vector<double>> results;
    for (const int threads : { 1, 2, 5 })
    {
      const test::TbbContext context(threads);
      Smoother smoother(squares, 2, SomeHeld(squares.Size()), context);
      results.push_back(Smoothed(smoother, b, context));
    }
    ASSERT_TRUE(results[0].allFinite());
    for (const Vector<double>& result : results)
    {
      EXPECT_EQ(result, results[0]);
    }
  }
}

TEST(BlockSmoother, UnknownsOutsideTheBlocksStay)
{
  Squares ring = Ring(12);
  ring.Blocks.Unknowns.resize(4);
  ring.Blocks.Offsets = { 0, 4 };
  Smoother smoother(ring, 2, Vector<double>::Constant(12, 0.5));
  const auto b = test::RandomVector<double>(12, 3107);
  Vector<double> x, r;
  smoother.PreSmooth(b, x, r, SerialContext());
  EXPECT_EQ(x.tail(8), Vector<double>::Zero(8));
  const auto start = test::RandomVector<double>(12, 3108);
  x = start;
  smoother.PostSmooth(b, x, SerialContext());
  EXPECT_EQ(x.tail(8), start.tail(8));
}

TEST(BlockSmoother, DependentAndEmptyColumnsDoNoHarm)
{
  // Columns 0 and 1 are the same, 2 is empty.
  const SparseMatrix<double> B =
    test::FromTriplets<double>(3, 4, { { 0, 0, 1.0 }, { 0, 1, 1.0 }, { 1, 3, 1.0 }, { 2, 3, 0.5 } });
  UnknownBlocks blocks;
  blocks.Unknowns = { 0, 1, 2, 3 };
  blocks.EndBlock();
  const Squares squares(B, blocks);
  const Vector<double> b = squares.Matrix() * test::RandomVector<double>(4, 3116);
  Smoother smoother(squares, 2, 1.0);
  Vector<double> x, r;
  smoother.PreSmooth(b, x, r, SerialContext());
  EXPECT_TRUE(x.allFinite());
  EXPECT_EQ(x[2], 0.0);
  EXPECT_LE(r.norm(), 0.1 * b.norm()); // an inverse of condition 2e6 has lost most digits of single precision
}

TEST(BlockSmoother, NoBlocksSmoothNothing)
{
  Squares ring = Ring(12);
  ring.Blocks = {};
  Smoother smoother(ring, 2);
  const auto b = test::RandomVector<double>(12, 3117);
  Vector<double> x, r;
  smoother.PreSmooth(b, x, r, SerialContext());
  EXPECT_EQ(x.norm(), 0.0);
  EXPECT_EQ(r, b);
}
