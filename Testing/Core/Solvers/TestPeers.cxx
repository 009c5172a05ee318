#include "Benchmarks/Peers/IncompleteCholeskyPeer.h"

#include "Benchmarks/Peers/DirectPeers.h"
#include "Benchmarks/Peers/RealForm.h"
#include "Support/GridProblem.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <memory>
#include <type_traits>

using namespace dmg;

// A comparison is honest only if the peers are right.

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

template <class Scalar>
class AnyPeers : public ::testing::Test
{
};
using Scalars = ::testing::Types<double, Complex>;
TYPED_TEST_SUITE(AnyPeers, Scalars);

template <class Scalar>
Matrix<Scalar> ProductOfFactors(const peers::IncompleteCholesky<Scalar>& factor)
{
  const int size = static_cast<int>(factor.Lower().rows());
  const Matrix<Scalar> L = Matrix<Scalar>(factor.Lower()) + Matrix<Scalar>::Identity(size, size);
  Vector<Scalar> D(size);
  for (int i = 0; i < size; ++i)
  {
    D[i] = factor.Pivot(i);
  }
  return L * D.asDiagonal() * L.adjoint();
}

}

TYPED_TEST(AnyPeers, IncompleteFactorsReproduceTheMatrixOnItsPattern)
{
  const auto problem = test::MakeGridProblem<TypeParam>(4, 2);
  // Nine points per row, so that triangles occur and the pattern is not trivial.
  const SparseMatrix<TypeParam> A = SparseMatrix<TypeParam>(problem.P[0].adjoint()) * (problem.A * problem.P[0]).eval();
  peers::IncompleteCholesky<TypeParam> factor(A);
  EXPECT_EQ(factor.Shift(), 0.0);
  const Matrix<TypeParam> product = ProductOfFactors(factor);
  for (int i = 0; i < A.rows(); ++i)
  {
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(A, i); entry; ++entry)
    {
      EXPECT_LE(std::abs(product(i, entry.col()) - entry.value()), 20 * Epsilon);
    }
  }
  const auto r = test::RandomVector<TypeParam>(A.rows(), 3401);
  Vector<TypeParam> z;
  factor.Apply(r, z, SerialContext());
  EXPECT_LE((product * z - r).norm(), 100 * Epsilon * r.norm());
}

TYPED_TEST(AnyPeers, BreakdownIsCuredByAShift)
{
  // Positive definite, but the pivot of its incomplete factorisation is negative: Kershaw 1978.
  const double entries[4][4] = { { 3, -2, 0, 2 }, { -2, 3, -2, 0 }, { 0, -2, 3, -2 }, { 2, 0, -2, 3 } };
  SparseMatrix<TypeParam> A(4, 4);
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      if (entries[i][j] != 0)
      {
        A.insert(i, j) = entries[i][j];
      }
    }
  }
  A.makeCompressed();
  EXPECT_GT(peers::IncompleteCholesky<TypeParam>(A).Shift(), 0.0);
}

TYPED_TEST(AnyPeers, CuthillMcKeeNarrowsTheBand)
{
  const auto A = test::MakeGridProblem<TypeParam>(4, 1).A;
  std::vector<int> scramble(A.rows());
  for (int i = 0; i < A.rows(); ++i)
  {
    scramble[i] = (101 * i + 17) % static_cast<int>(A.rows()); // 101 and 225 are coprime
  }
  std::vector<int> places(scramble.size());
  for (std::size_t k = 0; k < scramble.size(); ++k)
  {
    places[scramble[k]] = static_cast<int>(k);
  }
  const auto B = Permuted(A, scramble, places, SerialContext());
  const std::vector<int> order = peers::ReverseCuthillMcKee(B);
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    places[order[k]] = static_cast<int>(k);
  }
  int bandwidth = 0;
  for (int i = 0; i < B.rows(); ++i)
  {
    for (typename SparseMatrix<TypeParam>::InnerIterator entry(B, i); entry; ++entry)
    {
      bandwidth = std::max(bandwidth, std::abs(places[i] - places[entry.col()]));
    }
  }
  EXPECT_LE(bandwidth, 15 + 1); // layers are diagonals of the 15 x 15 grid
}

TYPED_TEST(AnyPeers, AllSolveTheSystem)
{
  const auto A = test::MakeGridProblem<TypeParam>(6, 1).A;
  const auto b = test::RandomVector<TypeParam>(A.rows(), 3402);
  std::vector<std::unique_ptr<peers::Peer<TypeParam>>> all;
  all.push_back(std::make_unique<peers::IncompleteCholeskyPeer<TypeParam>>());
  all.push_back(std::make_unique<peers::CholmodPeer<TypeParam>>(FillOrdering::AMD));
  all.push_back(std::make_unique<peers::CholmodPeer<TypeParam>>(FillOrdering::METIS));
  all.push_back(std::make_unique<peers::SimplicialPeer<TypeParam>>());
  if constexpr (std::is_same<TypeParam, Complex>::value)
  {
    all.push_back(std::make_unique<peers::RealFormPeer>(std::make_unique<peers::SimplicialPeer<double>>()));
  }
  for (const auto& peer : all)
  {
    peer->Prepare(A);
    Vector<TypeParam> x;
    const int iterations = peer->Solve(b, 1e-10, x);
    // Iterative ones stop by |r|_B <= 1e-10 |x|_A (IterationMonitor); incomplete factors have |r|_A^-1 at most 63 times
    // as large, a few times across the grid, and eigenvalues of A are at most 8.
    const Vector<TypeParam> r = b - A * x;
    const double energy = std::sqrt(std::abs(x.dot(A * x)));
    EXPECT_LE(r.norm(), std::sqrt(8.0) * 63 * 1e-10 * energy + 1e-13 * b.norm()) << peer->Name();
    EXPECT_GT(peer->Bytes(), A.nonZeros() / 2 * static_cast<long long>(sizeof(TypeParam)));
    EXPECT_LT(iterations, 2 * 63) << peer->Name(); // a few times across the grid
  }
}
