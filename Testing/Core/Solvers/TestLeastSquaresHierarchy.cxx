#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"

#include "LeastSquaresProblem.h"
#include "Support/AllIndices.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/TbbContext.h"
#include "SurfaceProblem.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using test::BothKinds;
using test::DiagonalOf;
using test::OperatorOf;
using test::SurfaceProblem;
using test::WithoutHeld;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();
constexpr double SinglePrecision = 1e-7;

LeastSquaresHierarchyOptions WithoutSmoothing()
{
  LeastSquaresHierarchyOptions options;
  options.ProlongationDegree = 0;
  options.Dropped = 0.0;
  return options;
}

/// Plane vectors as pairs of components; the product of the vectors p and z is Re p Re z + Im p Im
/// z.
Eigen::MatrixXd OnPairs(const SparseMatrix<Complex32>& P)
{
  const Eigen::MatrixXcd dense = Eigen::MatrixXcf(P).cast<Complex>();
  Eigen::MatrixXd pairs(P.rows(), 2 * P.cols());
  for (int j = 0; j < P.cols(); ++j)
  {
    pairs.col(2 * j) = dense.col(j).real();
    pairs.col(2 * j + 1) = dense.col(j).imag();
  }
  return pairs;
}

/// The sets of unknowns that blocks hold, in the caller's numbers.
std::multiset<std::set<int>> SetsOf(const UnknownBlocks& blocks, const std::vector<int>& numbers)
{
  std::multiset<std::set<int>> sets;
  for (int k = 0; k < blocks.Size(); ++k)
  {
    std::set<int> block;
    for (int s = blocks.Offsets[k]; s < blocks.Offsets[k + 1]; ++s)
    {
      block.insert(numbers[blocks.Unknowns[s]]);
    }
    sets.insert(std::move(block));
  }
  return sets;
}

/// Differences of neighbours on paths of the given lengths, one after the other; an unknown in five
/// belongs to each coarse vector.
struct Paths
{
  explicit Paths(const std::vector<int>& lengths)
  {
    test::Random random(3601);
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Eigen::Triplet<Complex>> prolongation;
    int size = 0;
    int rows = 0;
    for (std::size_t path = 0; path < lengths.size(); ++path)
    {
      for (int i = 0; i < lengths[path]; ++i, ++size)
      {
        this->Pieces.push_back(static_cast<int>(path));
        prolongation.emplace_back(size, size / 5, random.Number());
        this->Levels.Blocks.Unknowns.push_back(size);
        this->Levels.Blocks.EndBlock();
        if (i > 0)
        {
          entries.emplace_back(rows, size - 1, random.Uniform(-3.0, -1.0));
          entries.emplace_back(rows, size, random.Uniform(1.0, 3.0));
          ++rows;
        }
      }
    }
    this->B = test::FromTriplets(rows, size, entries);
    this->Levels.Prolongation = test::FromTriplets(size, (size + 4) / 5, prolongation);
  }

  SparseMatrix<double> B;
  std::vector<int> Pieces; ///< of each unknown
  LeastSquaresLevels Levels;
};

/// Components are equal where pieces are.
void ExpectComponents(const LeastSquaresHierarchy& hierarchy, const std::vector<int>& pieces)
{
  std::set<std::pair<int, int>> pairs;
  std::set<int> components;
  for (int k = 0; k < hierarchy.NumberOfUnknowns(); ++k)
  {
    pairs.emplace(hierarchy.ComponentOf(k), pieces[hierarchy.Order[k]]);
    components.insert(hierarchy.ComponentOf(k));
  }
  EXPECT_EQ(components.size(), std::set<int>(pieces.begin(), pieces.end()).size());
  EXPECT_EQ(pairs.size(), components.size());
  // They index arrays of one entry per unknown.
  EXPECT_GE(*components.begin(), 0);
  EXPECT_LT(*components.rbegin(), hierarchy.NumberOfUnknowns());
}

/// B^T B.
Eigen::MatrixXd Gram(const Eigen::MatrixXd& B)
{
  return test::Product<double>(B.transpose(), B);
}

class AnyLeastSquaresHierarchy : public ::testing::TestWithParam<SurfaceProblem::Of>
{
};

}

TEST_P(AnyLeastSquaresHierarchy, OperatorIsTheStiffnessAndTheDiagonal)
{
  const SurfaceProblem problem(test::IrregularTorus(40, 16, 3), GetParam());
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
  const std::vector<int>& order = hierarchy.Order;
  const auto size = hierarchy.NumberOfUnknowns();
  ASSERT_EQ(size, problem.Size());
  const double largest = hierarchy.Scales.cwiseAbs2().maxCoeff(); // of the diagonal of B^T B
  for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    const Vector<double> D = DiagonalOf(hierarchy, problem.Prescribed(5, kind));
    const auto of = OperatorOf(hierarchy, D);
    const StiffnessOperator& A = *of;
    ASSERT_EQ(A.Size(), size);
    const HarmonicSystem<double> system = problem.System(5, kind);
    for (unsigned seed = 3602; seed < 3606; ++seed)
    {
      const Vector<double> x = WithoutHeld(test::RandomVector<double>(size, seed), D);
      Vector<double> y;
      const double energy = A.Apply(x, y, SerialContext());
      ASSERT_EQ(y.size(), size);
      const double scale = 100 * Epsilon * (largest + 2.0) * x.norm();

      // As it is held: S (B^T B) S + D.
      const Vector<double> scaled = x.cwiseProduct(hierarchy.Scales);
      Vector<double> held = hierarchy.B.transpose() * Vector<double>(hierarchy.B * scaled);
      held = held.cwiseProduct(hierarchy.Scales);
      // As it was given.
      Vector<double> all(size);
      all(order) = x;
      const Vector<double> product = problem.B.transpose() * Vector<double>(problem.B * all);
      Vector<double> given = product(order);
      if (kind == ConstraintKind::Soft)
      {
        held += D.cwiseProduct(x);
        given += D.cwiseProduct(x);
      }
      EXPECT_LE((y - WithoutHeld(held, D)).norm(), scale);
      EXPECT_LE((y - WithoutHeld(given, D)).norm(), scale);
      EXPECT_NEAR(energy, x.dot(given), 10 * scale * x.norm());
      // As the system assembles it.
      const Vector<double> ofSystem = system.Expand(
        system.Matrix() * system.Restrict(all), Vector<double>::Zero(problem.Prescribed(5, kind).Unknowns.size()));
      EXPECT_LE((y - Vector<double>(ofSystem(order))).norm(), scale);
      EXPECT_EQ(WithoutHeld(y, D), y);
    }
  }
}

TEST_P(AnyLeastSquaresHierarchy, NoEigenvalueIsAboveOne)
{
  const SurfaceProblem problem(test::IrregularPlane(20, 16, 4), GetParam());
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
  std::vector<int> sorted = hierarchy.Order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, Identity(problem.Size()));

  const Eigen::MatrixXd B(hierarchy.B);
  const Vector<double> eigenvalues = test::Eigenvalues(Gram(B));
  EXPECT_LE(eigenvalues.maxCoeff(), 1.0 + 10 * Epsilon);
  EXPECT_GE(eigenvalues.maxCoeff(), 0.5);
  // The rows are those of the caller's B in some order.
  const Eigen::MatrixXd unscaled = B * hierarchy.Scales.asDiagonal();
  const Eigen::MatrixXd given = Eigen::MatrixXd(problem.B)(All, hierarchy.Order);
  EXPECT_LE(test::Distance(Gram(unscaled), Gram(given)), 100 * Epsilon * Gram(given).norm());
  EXPECT_LE((hierarchy.Diagonal.cast<double>() - B.colwise().squaredNorm().transpose()).norm(),
    SinglePrecision * std::sqrt(static_cast<double>(problem.Size())));
  for (int i = 0; i < problem.Size(); ++i)
  {
    const double squared = given.col(i).squaredNorm();
    EXPECT_NEAR(hierarchy.DiagonalOf(i), squared, SinglePrecision * squared);
  }
}

TEST_P(AnyLeastSquaresHierarchy, BlocksAreThoseGiven)
{
  const SurfaceProblem problem(test::IrregularPlane(20, 16, 4), GetParam());
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
  EXPECT_EQ(SetsOf(hierarchy.Blocks, hierarchy.Order), SetsOf(problem.Levels.Blocks, Identity(problem.Size())));
}

TEST_P(AnyLeastSquaresHierarchy, CoarseMatrixIsTheStiffnessOfPlaneVectors)
{
  const SurfaceProblem problem(test::IrregularTorus(32, 14, 3), GetParam());
  for (const LeastSquaresHierarchyOptions& options : { LeastSquaresHierarchyOptions(), WithoutSmoothing() })
  {
    const LeastSquaresHierarchy hierarchy = problem.Hierarchy(options);
    const Eigen::MatrixXd P = OnPairs(hierarchy.Prolongation.Matrix());
    ASSERT_EQ(P.cols(), 2 * problem.Levels.Prolongation.cols());
    const Eigen::MatrixXd expected = Gram(test::Product(test::Densified(hierarchy.B), P));
    const Eigen::MatrixXd lower(hierarchy.CoarseLower);
    EXPECT_EQ(lower, Eigen::MatrixXd(lower.triangularView<Eigen::Lower>()));
    const Eigen::MatrixXd coarse = lower.selfadjointView<Eigen::Lower>();
    EXPECT_LE((coarse - expected).norm(), 1e3 * Epsilon * expected.norm());
  }
}

TEST_P(AnyLeastSquaresHierarchy, ProlongationIsTheGivenOneOfScaledUnknowns)
{
  const SurfaceProblem problem(test::IrregularTorus(32, 14, 3), GetParam());
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy(WithoutSmoothing());
  const Eigen::MatrixXcd given(problem.Levels.Prolongation);
  const Eigen::MatrixXcd inOrder = given(hierarchy.Order, All);
  const Eigen::MatrixXcd expected = hierarchy.Scales.asDiagonal() * inOrder;
  const Eigen::MatrixXcd P = Eigen::MatrixXcf(hierarchy.Prolongation.Matrix()).cast<Complex>();
  EXPECT_LE((P - expected).norm(), std::ldexp(1.0, -15) * expected.norm());

  // Smoothing lowers the energy of every plane vector's worst, by 1 / (2 k + 1)^2 of a bound.
  const auto energy = [&problem](const LeastSquaresHierarchyOptions& options)
  { return problem.Hierarchy(options).CoarseLower.diagonal().sum(); };
  LeastSquaresHierarchyOptions once = WithoutSmoothing();
  once.ProlongationDegree = 1;
  EXPECT_LT(energy(once), energy(WithoutSmoothing()));
  EXPECT_LT(energy({}), energy(once));
}

TEST_P(AnyLeastSquaresHierarchy, ComponentsAreThoseOfTheSurface)
{
  const test::Surface torus = test::IrregularTorus(24, 10, 3);
  const SurfaceProblem alone(torus, GetParam());
  ExpectComponents(alone.Hierarchy(), std::vector<int>(alone.Size(), 0));

  const SurfaceProblem both(test::Union(torus, test::IrregularPlane(12, 10, 4), Vector3(4.0, 0.0, 0.0)), GetParam());
  std::vector<int> pieces(both.Size(), 0);
  for (int face = 0; face < both.Mesh.NumberOfFaces(); ++face)
  {
    const int piece = face < torus.F.rows() ? 0 : 1;
    if (GetParam() == SurfaceProblem::Of::FaceFields)
    {
      pieces[2 * face] = piece;
      pieces[2 * face + 1] = piece;
    }
    else
    {
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        pieces[both.Mesh.EdgeOf(h)] = piece;
      }
    }
  }
  ExpectComponents(both.Hierarchy(), pieces);
}

TEST_P(AnyLeastSquaresHierarchy, HasTheSameBitsForAnyNumberOfThreads)
{
  const SurfaceProblem problem(test::IrregularTorus(96, 40, 3), GetParam());
  const LeastSquaresHierarchy expected = problem.Hierarchy();
  const auto x = test::RandomVector<double>(problem.Size(), 3607);
  const Vector<double> D = DiagonalOf(expected, problem.Prescribed(5, ConstraintKind::Soft));
  Vector<double> product;
  const double energy = OperatorOf(expected, D)->Apply(x, product, SerialContext());
  for (const int threads : { 1, 2, 5 })
  {
    const test::TbbContext context(threads);
    const LeastSquaresHierarchy hierarchy = problem.Hierarchy({}, context);
    EXPECT_EQ(hierarchy.Order, expected.Order);
    EXPECT_EQ(hierarchy.Components, expected.Components);
    EXPECT_EQ(hierarchy.Scales, expected.Scales);
    EXPECT_EQ((hierarchy.B - expected.B).norm(), 0.0);
    const SparseMatrix<Complex32> P = hierarchy.Prolongation.Matrix();
    EXPECT_EQ((P - expected.Prolongation.Matrix()).norm(), 0.0f);
    EXPECT_EQ((hierarchy.CoarseLower - expected.CoarseLower).norm(), 0.0);
    EXPECT_EQ(hierarchy.CoarseLower.nonZeros(), expected.CoarseLower.nonZeros());
    Vector<double> y;
    EXPECT_EQ(OperatorOf(hierarchy, D)->Apply(x, y, context), energy);
    EXPECT_EQ(y, product);
  }
}

TEST_P(AnyLeastSquaresHierarchy, ReportsProgressOnceAndStopsWhenAsked)
{
  const SurfaceProblem problem(test::IrregularTorus(24, 10, 3), GetParam());
  const test::TbbContext all(2);
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy({}, all);
  EXPECT_TRUE(std::is_sorted(all.Progress().begin(), all.Progress().end()));
  EXPECT_EQ(all.Progress().back(), 1.0);
  for (std::size_t count = 1; count <= all.Progress().size(); ++count)
  {
    test::TbbContext context(2);
    context.CancelAfter(static_cast<int>(count));
    EXPECT_THROW(problem.Hierarchy({}, context), Cancelled);
  }
  // What the matrices alone hold.
  EXPECT_GT(hierarchy.Bytes(), 12 * hierarchy.B.nonZeros() + 6 * hierarchy.Prolongation.NonZeros());
}

TEST_P(AnyLeastSquaresHierarchy, WrongSizesAreRefused)
{
  const SurfaceProblem problem(test::IrregularTorus(24, 10, 5), GetParam());
  const auto make = [&problem](LeastSquaresLevels levels)
  { CoarsenLeastSquares(problem.B, std::move(levels), {}, SerialContext()); };
  EXPECT_NO_THROW(make(problem.Levels));
  const auto coarse = problem.Levels.Prolongation.cols();
  LeastSquaresLevels levels = problem.Levels;
  levels.Prolongation = PlanarProlongation(problem.Size() - 1, coarse);
  EXPECT_THROW(make(levels), InvalidInput);
  levels = problem.Levels;
  levels.Coarser.insert(levels.Coarser.begin(), SparseMatrix<double>(2 * coarse + 2, 10));
  EXPECT_THROW(make(levels), InvalidInput);
  levels = problem.Levels;
  for (int i = 0; i <= UnknownBlocks::LargestBlock; ++i)
  {
    levels.Blocks.Unknowns.push_back(i);
  }
  levels.Blocks.EndBlock();
  EXPECT_THROW(make(levels), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Of, AnyLeastSquaresHierarchy, ::testing::ValuesIn(BothKinds),
  [](const auto& info) { return info.param == SurfaceProblem::Of::FaceFields ? "FaceFields" : "OneForms"; });

TEST(LeastSquaresHierarchy, ComponentsAreConnectedThroughB)
{
  // A path of one unknown has an empty column: a component of its own, of length 1.
  const Paths paths({ 7, 1, 12, 1, 30 });
  const LeastSquaresHierarchy hierarchy = CoarsenLeastSquares(paths.B, paths.Levels, {}, SerialContext());
  ExpectComponents(hierarchy, paths.Pieces);
  for (int k = 0; k < hierarchy.NumberOfUnknowns(); ++k)
  {
    const int unknown = hierarchy.Order[k];
    if (unknown == 7 || unknown == 20)
    {
      EXPECT_EQ(hierarchy.Scales[k], 1.0);
    }
  }
  EXPECT_TRUE(hierarchy.CoarseLower.coeffs().allFinite());

  // Such unknowns are left to their blocks, which solve D x = r.
  const SparseMatrix<Complex32> P = hierarchy.Prolongation.Matrix();
  Vector<double> D = Vector<double>::Zero(hierarchy.NumberOfUnknowns());
  for (int k = 0; k < hierarchy.NumberOfUnknowns(); ++k)
  {
    const bool isAlone = hierarchy.Order[k] == 7 || hierarchy.Order[k] == 20;
    EXPECT_EQ(P.outerIndexPtr()[k] == P.outerIndexPtr()[k + 1], isAlone);
    D[k] = isAlone ? 4.0 : 0.5;
  }
  const auto cycle = hierarchy.Cycle(D, {}, SerialContext());
  Vector<double> x;
  cycle->Apply(Vector<double>::Ones(D.size()), x, SerialContext());
  for (int k = 0; k < hierarchy.NumberOfUnknowns(); ++k)
  {
    if (D[k] == 4.0)
    {
      EXPECT_NEAR(x[k], 0.25, 1e-5);
    }
  }
}

TEST(LeastSquaresHierarchy, ZerosConnectNothing)
{
  Paths paths({ 20 });
  for (SparseMatrix<double>::InnerIterator entry(paths.B, 9); entry; ++entry)
  {
    entry.valueRef() = 0.0;
  }
  std::fill(paths.Pieces.begin() + 10, paths.Pieces.end(), 1);
  ExpectComponents(CoarsenLeastSquares(paths.B, paths.Levels, {}, SerialContext()), paths.Pieces);
}
