#include "Solvers/LeastSquares/LeastSquaresCycle.h"

#include "Solvers/Direct/CholeskySolver.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/Krylov/StationaryIteration.h"
#include "Support/DenseAlgebra.h"
#include "Support/Errors.h"
#include "Support/GridProblem.h"
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
using test::BothKinds;
using test::DiagonalOf;
using test::NameOf;
using test::OperatorOf;
using test::SurfaceProblem;
using test::WithoutHeld;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// A problem with a hierarchy, and what is prescribed: every fifth face or edge.
struct Prescribed
{
  Prescribed(const SurfaceProblem& problem, ConstraintKind kind)
    : Hierarchy(problem.Hierarchy())
    , System(problem.System(5, kind))
    , D(DiagonalOf(this->Hierarchy, problem.Prescribed(5, kind)))
    , Operator(OperatorOf(this->Hierarchy, this->D))
    , A(*this->Operator)
    , NumberOfPrescribed(static_cast<int>(problem.Prescribed(5, kind).Unknowns.size()))
  {
  }

  int Size() const { return this->Hierarchy.NumberOfUnknowns(); }

  Vector<double> RandomVector(unsigned seed) const
  {
    return WithoutHeld(test::RandomVector<double>(this->Size(), seed), this->D);
  }

  /// A^-1 b by factoring the matrix of the system, which does not come from B.
  Vector<double> SolveByCholesky(const Vector<double>& b) const
  {
    Vector<double> all(this->Size());
    all(this->Hierarchy.Order) = b;
    Vector<double> x;
    CholeskySolver<double>(this->System.Matrix()).Solve(this->System.Restrict(all), x);
    all = this->System.Expand(x, Vector<double>::Zero(this->NumberOfPrescribed));
    return all(this->Hierarchy.Order);
  }

  const LeastSquaresHierarchy Hierarchy;
  const HarmonicSystem<double> System;
  const Vector<double> D;
  const std::unique_ptr<const StiffnessOperator> Operator;
  const StiffnessOperator& A;
  const int NumberOfPrescribed;
};

StiffnessCycleOptions Deep()
{
  StiffnessCycleOptions options;
  options.LargestFactor = 100;
  return options;
}

/// Calls visit(problem) for face fields and 1-forms on two surfaces.
template <class Visit>
void ForProblems(int scale, const Visit& visit)
{
  for (const SurfaceProblem::Of kind : BothKinds)
  {
    for (const auto& [name, surface] : { std::pair("torus", test::IrregularTorus(24 * scale, 10 * scale, 3)),
           std::pair("plane", test::IrregularPlane(16 * scale, 12 * scale, 4)) })
    {
      SCOPED_TRACE(NameOf(kind) + " on a " + name);
      visit(SurfaceProblem(surface, kind));
    }
  }
}

constexpr ConstraintKind BothConstraints[] = { ConstraintKind::Soft, ConstraintKind::Hard };

}

TEST(LeastSquaresCycle, IsSymmetricPositiveDefinite)
{
  // Up to the rounding of single precision, in which the coarse levels are held.
  ForProblems(2,
    [](const SurfaceProblem& problem)
    {
      for (const ConstraintKind kind : BothConstraints)
      {
        const Prescribed prescribed(problem, kind);
        LeastSquaresCycle cycle(prescribed.Hierarchy, prescribed.D, {}, SerialContext());
        for (unsigned seed = 3401; seed < 3411; ++seed)
        {
          const Vector<double> x = prescribed.RandomVector(seed);
          const Vector<double> y = prescribed.RandomVector(seed + 100);
          Vector<double> Sx, Sy;
          cycle.Apply(x, Sx, SerialContext());
          cycle.Apply(y, Sy, SerialContext());
          const double scale = std::sqrt(x.dot(Sx) * y.dot(Sy));
          EXPECT_GT(x.dot(Sx), 0.0);
          EXPECT_NEAR(x.dot(Sy), y.dot(Sx), 1e-5 * scale);
          // No step of the cycle can increase the energy: S A has eigenvalues up to 1.
          Vector<double> b, z;
          const double energy = prescribed.A.Apply(x, b, SerialContext());
          cycle.Apply(b, z, SerialContext());
          EXPECT_LE(b.dot(z), (1.0 + 1e-5) * energy);
          EXPECT_GT(b.dot(z), 0.0);
        }
      }
    });
}

TEST(LeastSquaresCycle, HeldUnknownsAreZero)
{
  ForProblems(4,
    [](const SurfaceProblem& problem)
    {
      const Prescribed prescribed(problem, ConstraintKind::Hard);
      for (const StiffnessCycleOptions& options : { StiffnessCycleOptions(), Deep() })
      {
        LeastSquaresCycle cycle(prescribed.Hierarchy, prescribed.D, options, SerialContext());
        // Whatever stands in the right-hand side.
        const auto r = test::RandomVector<double>(prescribed.Size(), 3412);
        Vector<double> z, same;
        cycle.Apply(r, z, SerialContext());
        EXPECT_EQ(z, WithoutHeld(z, prescribed.D));
        cycle.Apply(WithoutHeld(r, prescribed.D), same, SerialContext());
        EXPECT_EQ(z, same);
        EXPECT_GT(z.norm(), 0.0);
      }
    });
}

TEST(LeastSquaresCycle, SpectrumIsThatOfAGoodPreconditioner)
{
  for (const ConstraintKind kind : BothConstraints)
  {
    const Prescribed prescribed(SurfaceProblem(test::IrregularTorus(16, 8, 5), SurfaceProblem::Of::FaceFields), kind);
    const int size = prescribed.Size();
    LeastSquaresCycle cycle(prescribed.Hierarchy, prescribed.D, {}, SerialContext());
    Eigen::MatrixXd S(size, size);
    Eigen::MatrixXd A(size, size);
    Vector<double> z;
    std::vector<int> free;
    for (int j = 0; j < size; ++j)
    {
      const Vector<double> unit = WithoutHeld(Vector<double>::Unit(size, j), prescribed.D);
      cycle.Apply(unit, z, SerialContext());
      S.col(j) = z;
      prescribed.A.Apply(unit, z, SerialContext());
      A.col(j) = z;
      if (std::isfinite(prescribed.D[j]))
      {
        free.push_back(j);
      }
    }
    EXPECT_LE((S - S.transpose()).norm(), 1e-5 * S.norm());
    // S A x = lambda x as a symmetric problem: with the root of A, R S R has the same spectrum.
    const Eigen::MatrixXd root = test::SquareRoot<double>(A(free, free));
    const Eigen::MatrixXd sum = S + S.transpose();
    const Vector<double> spectrum = test::Eigenvalues(test::GalerkinProduct<double>(0.5 * sum(free, free), root));
    EXPECT_LE(spectrum.maxCoeff(), 1.0 + 1e-4);
    EXPECT_GE(spectrum.minCoeff(), 0.3);
  }
}

TEST(LeastSquaresCycle, IterationsAgreeWithCholesky)
{
  ForProblems(4,
    [](const SurfaceProblem& problem)
    {
      for (const ConstraintKind kind : BothConstraints)
      {
        const Prescribed prescribed(problem, kind);
        const Vector<double> b = prescribed.RandomVector(3420);
        const Vector<double> expected = prescribed.SolveByCholesky(b);
        Vector<double> product;
        const double energy = prescribed.A.Apply(expected, product, SerialContext());
        // The first coarse level factored, or cycles below.
        for (const StiffnessCycleOptions& options : { StiffnessCycleOptions(), Deep() })
        {
          LeastSquaresCycle cycle(prescribed.Hierarchy, prescribed.D, options, SerialContext());
          for (const auto solve : { &ConjugateGradient<double>, &StationaryIteration<double> })
          {
            const bool isStationary = solve == &StationaryIteration<double>;
            Vector<double> x;
            SolveReport report;
            solve(prescribed.A, cycle, b, { 1e-10, 100 }, x, report, SerialContext(), nullptr);
            EXPECT_TRUE(report.Converged);
            // Eigenvalues of S A between 0.3 and 1: a factor of 0.7 per step, accelerated 0.3.
            EXPECT_LE(report.Iterations.back().Iteration, isStationary ? 70 : 20);
            const double ofError = prescribed.A.Apply(x - expected, product, SerialContext());
            EXPECT_LE(std::sqrt(ofError), 1e-7 * std::sqrt(energy));
          }
        }
      }
    });
}

TEST(LeastSquaresCycle, ConvergesForAnyDegreeAndSweeps)
{
  const SurfaceProblem problem(test::IrregularTorus(40, 16, 5), SurfaceProblem::Of::FaceFields);
  for (const int degree : { 0, 1, 3 })
  {
    LeastSquaresHierarchyOptions coarsening;
    coarsening.ProlongationDegree = degree;
    const LeastSquaresHierarchy hierarchy = problem.Hierarchy(coarsening);
    const Vector<double> D = DiagonalOf(hierarchy, problem.Prescribed(5, ConstraintKind::Soft));
    const auto of = OperatorOf(hierarchy, D);
    const StiffnessOperator& A = *of;
    const auto b = test::RandomVector<double>(problem.Size(), 3421);
    int previous = 1000;
    for (const int sweeps : { 1, 2, 4 })
    {
      StiffnessCycleOptions options;
      options.Sweeps = sweeps;
      LeastSquaresCycle cycle(hierarchy, D, options, SerialContext());
      Vector<double> x;
      SolveReport report;
      ConjugateGradient(A, cycle, b, StoppingCriteria(), x, report, SerialContext());
      EXPECT_TRUE(report.Converged) << sweeps << " sweeps, degree " << degree;
      EXPECT_LE(report.Iterations.back().Iteration, previous) << "more sweeps, degree " << degree;
      previous = report.Iterations.back().Iteration;
    }
  }
}

// A cycle that was updated is the cycle that a new one would be, whatever it was before.
TEST(LeastSquaresCycle, UpdateIsANewCycle)
{
  const std::vector<test::Surface> surfaces = { test::IrregularTorus(80, 32, 5),
    // Faces without area have nothing that they share with others.
    test::SphereWithZeroAreaFaces(4, 12) };
  for (const SurfaceProblem::Of kind : BothKinds)
  {
    for (const test::Surface& surface : surfaces)
    {
      const SurfaceProblem problem(surface, kind);
      ASSERT_FALSE(problem.Levels.Coarser.empty());
      const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
      const auto soft = [&](int step, int first)
      { return DiagonalOf(hierarchy, problem.Prescribed(step, ConstraintKind::Soft, first)); };
      const auto hard = [&](int step, int first)
      { return DiagonalOf(hierarchy, problem.Prescribed(step, ConstraintKind::Hard, first)); };
      Vector<double> mixed = soft(5, 0);
      mixed.head(mixed.size() / 3).setConstant(Infinity);
      const std::vector<Vector<double>> diagonals = { soft(5, 0), 7.0 * soft(5, 0), soft(5, 2), hard(5, 0), hard(50, 3),
        mixed, soft(97, 1), soft(1, 0), soft(5, 0) };
      const auto r = test::RandomVector<double>(problem.Size(), 3423);
      for (const StiffnessCycleOptions& options : { StiffnessCycleOptions(), Deep() })
      {
        LeastSquaresCycle updated(hierarchy, diagonals.back(), options, SerialContext());
        for (std::size_t k = 0; k < diagonals.size(); ++k)
        {
          SCOPED_TRACE(NameOf(kind) + ", diagonal " + std::to_string(k));
          updated.Update(diagonals[k], SerialContext());
          LeastSquaresCycle fresh(hierarchy, diagonals[k], options, SerialContext());
          Vector<double> z, expected;
          updated.Apply(r, z, SerialContext());
          fresh.Apply(r, expected, SerialContext());
          ASSERT_TRUE(expected.allFinite());
          EXPECT_EQ(z, expected);
          ASSERT_EQ(updated.Levels().size(), fresh.Levels().size());
          for (std::size_t level = 0; level < fresh.Levels().size(); ++level)
          {
            EXPECT_EQ(updated.Levels()[level].Unknowns, fresh.Levels()[level].Unknowns);
            EXPECT_EQ(updated.Levels()[level].NonZeros, fresh.Levels()[level].NonZeros);
          }
        }
      }
    }
  }
}

TEST(LeastSquaresCycle, CyclesShareAHierarchy)
{
  const SurfaceProblem problem(test::IrregularTorus(80, 32, 5), SurfaceProblem::Of::OneForms);
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
  const Vector<double> D = DiagonalOf(hierarchy, problem.Prescribed(5, ConstraintKind::Soft));
  const Vector<double> other = DiagonalOf(hierarchy, problem.Prescribed(7, ConstraintKind::Hard));
  const auto r = test::RandomVector<double>(problem.Size(), 3424);
  LeastSquaresCycle first(hierarchy, D, {}, SerialContext());
  Vector<double> expected, z;
  first.Apply(r, expected, SerialContext());
  LeastSquaresCycle second(hierarchy, other, {}, SerialContext());
  second.Apply(r, z, SerialContext());
  EXPECT_NE(z, expected);
  first.Apply(r, z, SerialContext());
  EXPECT_EQ(z, expected);
}

TEST(LeastSquaresCycle, HasTheSameBitsForAnyNumberOfThreads)
{
  const SurfaceProblem problem(test::IrregularTorus(120, 48, 5), SurfaceProblem::Of::FaceFields);
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
  const auto r = test::RandomVector<double>(problem.Size(), 3422);
  // Deep: what is factored may depend on the threads of the BLAS.
  for (const ConstraintKind kind : BothConstraints)
  {
    const Vector<double> D = DiagonalOf(hierarchy, problem.Prescribed(5, kind));
    Vector<double> expected;
    LeastSquaresCycle(hierarchy, D, Deep(), SerialContext()).Apply(r, expected, SerialContext());
    for (const int threads : { 1, 2, 5 })
    {
      const test::TbbContext context(threads);
      Vector<double> z;
      LeastSquaresCycle(hierarchy, D, Deep(), context).Apply(r, z, context);
      EXPECT_EQ(z, expected) << threads << " threads";
    }
  }
}

TEST(LeastSquaresCycle, ReportsItsLevels)
{
  const SurfaceProblem problem(test::IrregularTorus(80, 32, 5), SurfaceProblem::Of::FaceFields);
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
  const Vector<double> D = DiagonalOf(hierarchy, problem.Prescribed(5, ConstraintKind::Soft));
  const LeastSquaresCycle cycle(hierarchy, D, {}, SerialContext());
  ASSERT_EQ(cycle.Levels().size(), 2u) << "the first coarse level is small enough to be factored";
  EXPECT_EQ(cycle.Levels()[0].Unknowns, problem.Size());
  EXPECT_EQ(cycle.Levels()[0].NonZeros, hierarchy.B.nonZeros());
  EXPECT_EQ(cycle.Levels()[1].Unknowns, 2 * problem.Levels.Prolongation.cols());
  const LeastSquaresCycle deep(hierarchy, D, Deep(), SerialContext());
  ASSERT_GE(deep.Levels().size(), 3u);
  EXPECT_EQ(deep.Levels()[1].Unknowns, 2 * problem.Levels.Prolongation.cols());
  EXPECT_EQ(deep.Levels()[2].Unknowns, problem.Levels.Coarser[0].cols());
  // Five vectors of all unknowns, at least.
  EXPECT_GT(cycle.Bytes(), 5 * 8 * problem.Size());
}

TEST(LeastSquaresCycle, ReportsProgressOnceAndStopsWhenAsked)
{
  const SurfaceProblem problem(test::IrregularTorus(80, 32, 5), SurfaceProblem::Of::OneForms);
  const LeastSquaresHierarchy hierarchy = problem.Hierarchy();
  const Vector<double> D = DiagonalOf(hierarchy, problem.Prescribed(5, ConstraintKind::Soft));
  for (const bool isUpdate : { false, true })
  {
    const auto make = [&](const ExecutionContext& context)
    {
      const SerialContext serial;
      const ExecutionContext& first = isUpdate ? serial : context;
      LeastSquaresCycle cycle(hierarchy, D, Deep(), first);
      if (isUpdate)
      {
        cycle.Update(2.0 * D, context);
      }
    };
    const test::TbbContext all(2);
    make(all);
    ASSERT_FALSE(all.Progress().empty());
    EXPECT_TRUE(std::is_sorted(all.Progress().begin(), all.Progress().end()));
    EXPECT_EQ(all.Progress().back(), 1.0);
    for (std::size_t count = 1; count <= all.Progress().size(); ++count)
    {
      test::TbbContext context(2);
      context.CancelAfter(static_cast<int>(count));
      EXPECT_THROW(make(context), Cancelled);
    }
  }
}

TEST(LeastSquaresCycle, LevelsThatDoNotChainAreRefused)
{
  const SurfaceProblem problem(test::IrregularTorus(80, 32, 5), SurfaceProblem::Of::OneForms);
  const auto make = [&problem](LeastSquaresLevels levels)
  {
    const LeastSquaresHierarchy hierarchy = CoarsenLeastSquares(problem.B, std::move(levels), {}, SerialContext());
    LeastSquaresCycle(hierarchy, Vector<double>::Ones(problem.Size()), Deep(), SerialContext());
  };
  EXPECT_NO_THROW(make(problem.Levels));
  LeastSquaresLevels levels = problem.Levels;
  ASSERT_FALSE(levels.Coarser.empty());
  levels.Coarser.push_back(SparseMatrix<double>(levels.Coarser.back().cols() + 2, 10));
  EXPECT_THROW(make(levels), InvalidInput);
}
