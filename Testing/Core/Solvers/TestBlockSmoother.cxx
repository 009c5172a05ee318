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
using test::BlocksOf;
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
    const Vector<double> spectrum = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
      test::BlockOf(squares.Matrix(), test::MembersOf(squares.Blocks, k)))
                                      .eigenvalues();
    worst = std::max(worst, spectrum.maxCoeff() / spectrum.minCoeff());
  }
  return 3e-6 * worst;
}

/// With a diagonal from the beginning.
struct Smoother : BlockSmoother
{
  Smoother(const Squares& squares, const SchwarzBlocks& blocks, int sweeps, double relaxation = UsualRelaxation)
    : BlockSmoother(squares.B, squares.Tiles, blocks, sweeps, relaxation)
  {
  }
  Smoother(const Squares& squares, const SchwarzBlocks& blocks, int sweeps, const Vector<double>& D,
    const ExecutionContext& context = SerialContext())
    : Smoother(squares, blocks, sweeps)
  {
    this->SetDiagonal(D, context);
  }
};

/// Blocks that share unknowns or not, in packs or alone, of shapes that the smoother knows and others.
std::vector<Squares> AllKinds()
{
  return { Ring(200), Fan(60), Sides(30), Wheels(13, 6), Wheels(13, 5) };
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

/// Of each block, in the order of BlocksInOrder: whether D touches its group.
std::vector<char> ArePenalised(const SchwarzBlocks& blocks, const Vector<double>& D)
{
  std::vector<char> arePenalised;
  for (int tile = 0; tile < blocks.NumberOfTiles(); ++tile)
  {
    const SchwarzBlocks::Run groups = blocks.GroupsOf(blocks.TileAt(tile));
    for (int g = groups.First; g < groups.Last; ++g)
    {
      const SchwarzBlocks::Group& group = blocks.Groups()[g];
      bool isPenalised = false;
      for (int slot = 0; slot < blocks.NumberOfUnknowns(group); ++slot)
      {
        isPenalised |= D[blocks.UnknownOf(group, slot)] != 0.0;
      }
      arePenalised.insert(arePenalised.end(), group.Blocks, isPenalised);
    }
  }
  return arePenalised;
}

/// Sweeps over the blocks of a dense matrix, each solved for exactly and relaxed, but for those in groups
/// that D touches; those of its unknowns that are held stay.
Vector<double> Relaxed(const Squares& squares, const SchwarzBlocks& blocks, int sweeps, const Vector<double>& D,
  const Vector<double>& b, Vector<double> x, bool isUp, double relaxation = BlockSmoother::UsualRelaxation)
{
  Eigen::MatrixXd A = squares.Matrix();
  A.diagonal() += D.unaryExpr([](double entry) { return std::isfinite(entry) ? entry : 0.0; });
  const UnknownBlocks inOrder = test::BlocksInOrder(blocks);
  const std::vector<char> arePenalised = ArePenalised(blocks, D);
  std::vector<int> order = Identity(inOrder.Size());
  if (!isUp)
  {
    std::reverse(order.begin(), order.end());
  }
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    for (const int block : order)
    {
      const std::vector<int> free = FreeAmong(test::MembersOf(inOrder, block), D);
      const Vector<double> residual = b(free) - A(free, All) * x;
      x(free) += (arePenalised[block] ? 1.0 : relaxation) * test::BlockOf(A, free).llt().solve(residual);
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
  const SchwarzBlocks blocks = BlocksOf(squares);
  Smoother smoother(squares, blocks, sweeps, D);
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
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(test::BlockOf(both, free));
  EXPECT_GT(spectrum.eigenvalues().minCoeff(), 0.0);
}

}

TEST(TestBlockSmoother, OneBlockIsTheInverse)
{
  Squares ring = Ring(12);
  ring.Blocks = {};
  for (int i = 0; i < ring.Size(); ++i)
  {
    ring.Blocks.Unknowns.push_back((5 * i) % ring.Size());
  }
  ring.Blocks.EndBlock();
  const SchwarzBlocks blocks = BlocksOf(ring);
  const Eigen::MatrixXd A = ring.Matrix();
  // Each sweep leaves 1e-6 / lambda of an eigenvector, and what single precision makes of it.
  const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().minCoeff();
  ASSERT_GT(lowest, 5e-3);
  const double left = 1e-6 / lowest + 10 * std::numeric_limits<float>::epsilon() / lowest;
  const Vector<double> exact = test::RandomVector<double>(ring.Size(), 3103);
  const Vector<double> b = A * exact;
  for (const int sweeps : { 1, 2, 3 })
  {
    Smoother smoother(ring, blocks, sweeps, 1.0);
    Vector<double> x, r;
    smoother.PreSmooth(b, x, r, SerialContext());
    const double bound = std::pow(left, sweeps) + 20 * Epsilon / lowest;
    EXPECT_LE((x - exact).norm(), bound * exact.norm());
    EXPECT_LE(r.norm(), bound * b.norm());
  }
}

TEST(TestBlockSmoother, IsRelaxationByBlocks)
{
  for (const Squares& squares : AllKinds())
  {
    const SchwarzBlocks blocks = BlocksOf(squares);
    const double ofInverses = OfInverses(squares);
    const auto b = test::RandomVector<double>(squares.Size(), 3104);
    const auto start = test::RandomVector<double>(squares.Size(), 3110);
    const Vector<double> zero = Vector<double>::Zero(squares.Size());
    for (const int sweeps : { 1, 2 })
    {
      for (const double relaxation : { 0.7, 1.0, 1.4 })
      {
        Smoother smoother(squares, blocks, sweeps, relaxation);
        Vector<double> x, r;
        smoother.PreSmooth(b, x, r, SerialContext());
        const auto up = Relaxed(squares, blocks, sweeps, zero, b, zero, true, relaxation);
        EXPECT_LE((x - up).norm(), ofInverses * up.norm());
        x = start;
        smoother.PostSmooth(b, x, SerialContext());
        const auto down = Relaxed(squares, blocks, sweeps, zero, b, start, false, relaxation);
        EXPECT_LE((x - down).norm(), ofInverses * down.norm());
      }
    }
  }
}

TEST(TestBlockSmoother, ADiagonalIsOneMoreSquarePerUnknown)
{
  for (const Squares& squares : AllKinds())
  {
    const int size = squares.Size();
    const SchwarzBlocks blocks = BlocksOf(squares);
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
      const SchwarzBlocks blocksOfStacked = BlocksOf(stacked);
      ASSERT_EQ(test::BlocksInOrder(blocksOfStacked).Unknowns, test::BlocksInOrder(blocks).Unknowns);

      Smoother smoother(squares, blocks, 2, 1.0);
      smoother.SetDiagonal(D, SerialContext());
      Smoother expected(stacked, blocksOfStacked, 2, 1.0);
      EXPECT_TRUE(smoother.HeldUnknowns().empty());
      Vector<double> x, r, y, s;
      smoother.PreSmooth(b, x, r, SerialContext());
      expected.PreSmooth(b, y, s, SerialContext());
      EXPECT_LE((x - y).norm(), 1e-5 * y.norm()); // the same ridge, rounded in other ways
      EXPECT_LE((r - s).norm(), 1e-4 * b.norm());
      const auto up = Relaxed(squares, blocks, 2, D, b, zero, true, 1.0);
      EXPECT_LE((x - up).norm(), ofInverses * up.norm());

      smoother.PostSmooth(b, x, SerialContext());
      expected.PostSmooth(b, y, SerialContext());
      EXPECT_LE((x - y).norm(), 1e-5 * y.norm());
      const auto down = Relaxed(squares, blocks, 2, D, b, up, false, 1.0);
      EXPECT_LE((x - down).norm(), ofInverses * down.norm());
    }
  }
}

TEST(TestBlockSmoother, HeldUnknownsStayZero)
{
  // The others are smoothed as if the held ones were not there: the columns of B left out, and the
  // unknowns of blocks.
  for (const Squares& squares : AllKinds())
  {
    const int size = squares.Size();
    const SchwarzBlocks blocks = BlocksOf(squares);
    const Vector<double> D = SomeHeld(size);
    std::vector<int> held;
    for (int i = 0; i < size; ++i)
    {
      if (!std::isfinite(D[i]))
      {
        held.push_back(i);
      }
    }
    Smoother smoother(squares, blocks, 2, D);
    EXPECT_EQ(smoother.HeldUnknowns(), held);

    // Whatever stands in b.
    const double ofInverses = OfInverses(squares);
    const auto b = test::RandomVector<double>(size, 3112);
    const Vector<double> zero = Vector<double>::Zero(size);
    Vector<double> x, r;
    smoother.PreSmooth(b, x, r, SerialContext());
    EXPECT_EQ(x(held).norm(), 0.0);
    EXPECT_EQ(r(held).norm(), 0.0);
    const auto up = Relaxed(squares, blocks, 2, D, b, zero, true);
    EXPECT_LE((x - up).norm(), ofInverses * up.norm());
    const std::vector<int> free = FreeOf(D);
    Eigen::MatrixXd A = test::BlockOf(squares.Matrix(), free);
    A.diagonal() += D(free);
    EXPECT_LE((r(free) - (b(free) - A * x(free))).norm(), 100 * Epsilon * A.norm() * b.norm());

    smoother.PostSmooth(b, x, SerialContext());
    EXPECT_EQ(x(held).norm(), 0.0);
    const auto down = Relaxed(squares, blocks, 2, D, b, up, false);
    EXPECT_LE((x - down).norm(), ofInverses * down.norm());
  }
}

TEST(TestBlockSmoother, AllUnknownsHeldLeaveNothing)
{
  const Squares ring = Ring(40);
  const SchwarzBlocks blocks = BlocksOf(ring);
  Smoother smoother(ring, blocks, 2, Vector<double>::Constant(40, Infinity));
  const Vector<double> all = Smoothed(smoother, test::RandomVector<double>(40, 3113), SerialContext());
  EXPECT_EQ(all.norm(), 0.0);
}

TEST(TestBlockSmoother, DiagonalsComeAndGo)
{
  for (const Squares& squares : { Ring(4000), Fan(60) })
  {
    const int size = squares.Size();
    const SchwarzBlocks blocks = BlocksOf(squares);
    const auto b = test::RandomVector<double>(size, 3114);
    const Vector<double> zero = Vector<double>::Zero(size);
    Smoother smoother(squares, blocks, 2);
    const Vector<double> plain = Smoothed(smoother, b, SerialContext());
    for (const Vector<double>& D :
      { SomeHeld(size), zero, SomeDiagonal(size), SomeDiagonal(size, 1), Vector<double>(3.0 * SomeHeld(size)), zero })
    {
      smoother.SetDiagonal(D, SerialContext());
      Smoother fresh(squares, blocks, 2, D);
      const Vector<double> result = Smoothed(smoother, b, SerialContext());
      EXPECT_EQ(result, Smoothed(fresh, b, SerialContext()));
      EXPECT_EQ(smoother.HeldUnknowns(), fresh.HeldUnknowns());
      EXPECT_EQ(D == zero, result == plain);
    }
  }
}

TEST(TestBlockSmoother, PostIsTheAdjointOfPre)
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

TEST(TestBlockSmoother, SweepsReduceTheEnergyOfTheError)
{
  // Each step of a block lowers the energy over it, most where it is not relaxed.
  for (const Squares& squares : { Ring(200), Fan(100) })
  {
    const Eigen::MatrixXd A = squares.Matrix();
    const SchwarzBlocks blocks = BlocksOf(squares);
    const Vector<double> exact = test::RandomVector<double>(squares.Size(), 3105);
    const Vector<double> b = A * exact;
    double previous = exact.dot(A * exact);
    for (int sweeps = 1; sweeps <= 4; ++sweeps)
    {
      Smoother smoother(squares, blocks, sweeps);
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

TEST(TestBlockSmoother, SameBitsForAnyNumberOfThreads)
{
  // More tiles of a colour than threads; and a colour per tile.
  for (const Squares& squares : { Ring(20000), Fan(150) })
  {
    const auto b = test::RandomVector<double>(squares.Size(), 3106);
    std::vector<Vector<double>> results;
    for (const int threads : { 1, 2, 5 })
    {
      const test::TbbContext context(threads);
      const SchwarzBlocks blocks = BlocksOf(squares, context);
      Smoother smoother(squares, blocks, 2, SomeHeld(squares.Size()), context);
      results.push_back(Smoothed(smoother, b, context));
    }
    ASSERT_TRUE(results[0].allFinite());
    for (const Vector<double>& result : results)
    {
      EXPECT_EQ(result, results[0]);
    }
  }
}

TEST(TestBlockSmoother, UnknownsOutsideTheBlocksStay)
{
  Squares ring = Ring(12);
  ring.Blocks.Unknowns.resize(4);
  ring.Blocks.Offsets = { 0, 4 };
  const SchwarzBlocks blocks = BlocksOf(ring);
  Smoother smoother(ring, blocks, 2, Vector<double>::Constant(12, 0.5));
  const auto b = test::RandomVector<double>(12, 3107);
  Vector<double> x, r;
  smoother.PreSmooth(b, x, r, SerialContext());
  EXPECT_EQ(x.tail(8), Vector<double>::Zero(8));
  const auto start = test::RandomVector<double>(12, 3108);
  x = start;
  smoother.PostSmooth(b, x, SerialContext());
  EXPECT_EQ(x.tail(8), start.tail(8));
}
