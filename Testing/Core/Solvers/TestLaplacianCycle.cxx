#include "Solvers/Laplacian/LaplacianCycle.h"

#include "Support/DenseAlgebra.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"
#include "Support/TbbContext.h"
#include "SurfaceProblem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using Dense = test::Dense<Complex>;
using test::Densified;
using test::ErrorsOf;
using test::Product;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double SinglePrecision = 1e-6;

/// A grid's Laplacian and its prolongations; the last unknown knows no other.
struct Problem
{
  explicit Problem(int depth, int levels)
  {
    auto grid = test::MakeGridProblem<Complex>(depth, levels);
    this->L = std::move(grid.A);
    this->P = std::move(grid.P);
    const int last = static_cast<int>(this->L.rows()) - 1;
    this->L.prune([last](Eigen::Index i, Eigen::Index j, const Complex&) { return (i == last) == (j == last); });
    this->L.coeffRef(last, last) = 0.0;
    this->L.makeCompressed();
  }

  LaplacianHierarchy Hierarchy(int steps = 2) const
  {
    return CoarsenLaplacian(this->InOrder(), this->P, steps, SerialContext());
  }

  MatrixInOrder InOrder() const
  {
    return [this](const std::vector<int>& order, const ExecutionContext& context)
    { return Permuted(this->L, order, Inverse(order), context); };
  }

  int Size() const { return static_cast<int>(this->L.rows()); }

  /// D in the order of the hierarchy: a little nearly everywhere, much here and there.
  Vector<double> Shift(const LaplacianHierarchy& hierarchy, bool holdsSome) const
  {
    Vector<double> D(2 * this->Size());
    for (int i = 0; i < D.size(); ++i)
    {
      const int unknown = hierarchy.Order[i] / 2;
      const bool isLast = unknown == this->Size() - 1;
      D[i] = unknown % 7 == 0 && !isLast ? 0.0 : unknown % 5 == 0 ? 100.0 : 0.03;
      if (holdsSome && unknown % 11 == 3)
      {
        D[i] = Infinity;
      }
    }
    return D;
  }

  SparseMatrix<Complex> L;
  std::vector<SparseMatrix<Complex>> P;
};

/// L + D in the order of the hierarchy, from L; held rows and columns are empty but for a one.
Dense Expected(const Problem& problem, const LaplacianHierarchy& hierarchy, const Vector<double>& D)
{
  const Dense L = Densified(problem.L);
  Dense A(problem.Size(), problem.Size());
  for (int i = 0; i < problem.Size(); ++i)
  {
    for (int j = 0; j < problem.Size(); ++j)
    {
      const bool isHeld = std::isinf(D[2 * i]) || std::isinf(D[2 * j]);
      A(i, j) = isHeld ? Complex(0.0) : L(hierarchy.Order[2 * i] / 2, hierarchy.Order[2 * j] / 2);
      if (i == j)
      {
        A(i, i) += std::isinf(D[2 * i]) ? 1.0 : D[2 * i];
      }
    }
  }
  return A;
}

/// Pairs, zero where unknowns are held.
Vector<double> RandomPairs(const Vector<double>& D, unsigned seed)
{
  return D.array().isInf().select(0.0, test::RandomVector<double>(D.size(), seed));
}

StiffnessCycleOptions Options(int sweeps, int largestFactor)
{
  StiffnessCycleOptions options;
  options.Sweeps = sweeps;
  options.LargestFactor = largestFactor;
  return options;
}

}

TEST(LaplacianHierarchy, IsTheMatrixInAnotherOrder)
{
  const Problem problem(4, 3);
  const LaplacianHierarchy hierarchy = problem.Hierarchy();
  ASSERT_EQ(hierarchy.NumberOfUnknowns(), 2 * problem.Size());
  for (int k = 0; k < problem.Size(); ++k)
  {
    EXPECT_EQ(hierarchy.Order[2 * k] % 2, 0);
    EXPECT_EQ(hierarchy.Order[2 * k + 1], hierarchy.Order[2 * k] + 1);
  }
  const Dense L = Expected(problem, hierarchy, Vector<double>::Zero(2 * problem.Size()));
  EXPECT_TRUE(Densified(hierarchy.L) == L);
  int isolated = 0;
  for (int k = 0; k < problem.Size(); ++k)
  {
    EXPECT_EQ(hierarchy.DiagonalOf(2 * k), L(k, k).real());
    EXPECT_EQ(hierarchy.DiagonalOf(2 * k + 1), L(k, k).real());
    isolated = hierarchy.Order[2 * k] / 2 == problem.Size() - 1 ? k : isolated;
  }
  const Dense lower(hierarchy.Sweeps.Lower.cast<Complex>());
  const Dense upper(hierarchy.Sweeps.Upper.cast<Complex>());
  const auto rounded = [](const Complex& entry) { return Complex(Complex32(entry)); };
  EXPECT_EQ(lower, Dense(L.triangularView<Eigen::StrictlyLower>()).unaryExpr(rounded));
  EXPECT_EQ(upper, Dense(L.triangularView<Eigen::StrictlyUpper>()).unaryExpr(rounded));
  EXPECT_EQ(Dense(hierarchy.Prolongation.Matrix().cast<Complex>()).row(isolated).norm(), 0.0);
  for (int k = 0; k < problem.Size(); ++k)
  {
    EXPECT_EQ(hierarchy.ComponentOf(2 * k), hierarchy.ComponentOf(2 * k + 1));
    EXPECT_EQ(hierarchy.ComponentOf(2 * k) == hierarchy.ComponentOf(2 * isolated), k == isolated);
  }
}

TEST(LaplacianHierarchy, TheCoarseMatrixIsGalerkins)
{
  const Problem problem(4, 3);
  for (const int steps : { 0, 2 })
  {
    const LaplacianHierarchy hierarchy = problem.Hierarchy(steps);
    const Dense P = Densified(SparseMatrix<Complex>(hierarchy.Prolongation.Matrix().cast<Complex>()));
    const Dense expected = test::GalerkinProduct(Densified(hierarchy.L), P);
    const Dense coarse = Densified(SymmetricFromLower(hierarchy.CoarseLower, SerialContext()));
    EXPECT_LE(test::Distance(coarse, expected), SinglePrecision * expected.norm());
  }
}

TEST(LaplacianHierarchy, OperatorsAddWhatIsPrescribed)
{
  const Problem problem(4, 2);
  const LaplacianHierarchy hierarchy = problem.Hierarchy();
  for (const bool holdsSome : { false, true })
  {
    const Vector<double> D = problem.Shift(hierarchy, holdsSome);
    const Vector<double> x = RandomPairs(D, 4101);
    Vector<double> y;
    const double product = test::OperatorOf(hierarchy, D)->Apply(x, y, SerialContext());
    const Vector<Complex> expected = Expected(problem, hierarchy, D) * AsComplex(x);
    EXPECT_LE((AsComplex(y) - expected).norm(), 1e-13 * expected.norm());
    EXPECT_NEAR(product, x.dot(y), 1e-12 * product);
  }
}

// On two levels with the coarse one factored, errors are swept, lose their part in the coarse space, and
// are swept by the adjoint.
TEST(LaplacianCycle, TwoGridsAreTheTextbooksFormula)
{
  const Problem problem(4, 2);
  const LaplacianHierarchy hierarchy = problem.Hierarchy();
  for (const auto& [holdsSome, sweeps] :
    { std::pair(false, 1), { false, 2 }, { false, 3 }, { true, 1 }, { true, 2 }, { true, 3 } })
  {
    const Vector<double> D = problem.Shift(hierarchy, holdsSome);
    const Dense A = Expected(problem, hierarchy, D);
    const Dense identity = Dense::Identity(A.rows(), A.cols());
    Dense P = Densified(SparseMatrix<Complex>(hierarchy.Prolongation.Matrix().cast<Complex>()));
    // A and P, where those that are pulled yield to their neighbours.
    Dense AsCoarse = A;
    Dense yielding = P;
    for (int k = 0; k < problem.Size(); ++k)
    {
      if (std::isinf(D[2 * k]))
      {
        P.row(k).setZero();
        yielding.row(k).setZero();
      }
      else if (D[2 * k] > 0.0)
      {
        const double L = A(k, k).real() - D[2 * k];
        AsCoarse(k, k) = L + 1.0 / (1.0 / D[2 * k] + (L > 0.0 ? 1.0 / L : Infinity));
        yielding.row(k) *= L / (L + D[2 * k]);
      }
    }
    // The coarse correction, of a matrix that may be singular, and sweeps to and fro.
    const Dense coarse =
      Product(yielding, Product<Complex>(test::PseudoInverse(test::GalerkinProduct(AsCoarse, P)), yielding.adjoint()));
    const Dense up = test::InverseOfLower(A);
    Dense swept = identity;
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      swept = Product(ErrorsOf<Complex>(sweep % 2 == 0 ? up : Dense(up.adjoint()), A), swept);
    }
    // All of A^-1 but for the errors that the cycle leaves; with A^-1 S^H A for the adjoint sweeps.
    const Dense inverse = test::Inverse(A);
    const Dense adjoint = Product(inverse, Product<Complex>(swept.adjoint(), A));
    const Dense errors = Product(adjoint, Product(ErrorsOf(coarse, A), swept));
    const Dense B = Product<Complex>(identity - errors, inverse);

    const auto cycle = hierarchy.Cycle(D, Options(sweeps, 1 << 20), SerialContext());
    const Vector<double> r = RandomPairs(D, 4102);
    Vector<double> z;
    cycle->Apply(r, z, SerialContext());
    const Vector<Complex> expected = B * AsComplex(r);
    EXPECT_LE((AsComplex(z) - expected).norm(), 1e-5 * expected.norm());
  }
}

TEST(LaplacianCycle, UpdateIsANewCycle)
{
  const Problem problem(5, 4);
  const LaplacianHierarchy hierarchy = problem.Hierarchy();
  const StiffnessCycleOptions options = Options(3, 0);
  const auto cycle = hierarchy.Cycle(problem.Shift(hierarchy, false), options, SerialContext());
  EXPECT_EQ(cycle->Levels().size(), 4u);
  for (const bool holdsSome : { true, false })
  {
    const Vector<double> D = 3.0 * problem.Shift(hierarchy, holdsSome);
    const Vector<double> r = RandomPairs(D, 4103);
    Vector<double> updated, made;
    cycle->Update(D, SerialContext());
    cycle->Apply(r, updated, SerialContext());
    hierarchy.Cycle(D, options, SerialContext())->Apply(r, made, SerialContext());
    EXPECT_EQ(updated, made);
  }
}

TEST(LaplacianCycle, HasTheSameBitsForAnyNumberOfThreads)
{
  const Problem problem(7, 4);
  std::vector<Vector<double>> results;
  for (const int threads : { 1, 2, 3, 8 })
  {
    const test::TbbContext context(threads);
    const LaplacianHierarchy hierarchy = CoarsenLaplacian(problem.InOrder(), problem.P, 2, context);
    const Vector<double> D = problem.Shift(hierarchy, true);
    const auto cycle = hierarchy.Cycle(D, Options(4, 0), context);
    Vector<double> z;
    cycle->Apply(RandomPairs(D, 4104), z, context);
    results.push_back(z);
  }
  for (const Vector<double>& result : results)
  {
    EXPECT_EQ(result, results[0]);
  }
}

TEST(LaplacianHierarchy, RefusesSizesThatDoNotChain)
{
  const Problem problem(4, 3);
  try
  {
    CoarsenLaplacian(problem.InOrder(), { problem.P[0], problem.P[0] }, 0, SerialContext());
    FAIL() << "nothing was refused";
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("the prolongation to level 1 has"), std::string::npos) << error.what();
  }
}
