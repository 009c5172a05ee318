#include "Solvers/LeastSquaresCycle.h"

#include "GridProblem.h"
#include "HarmonicField.h"
#include "Solvers/CholeskySolver.h"
#include "Solvers/ConjugateGradient.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"
#include "Systems/FaceFieldSystem.h"
#include "NodalLevels.h"
#include "Systems/OneFormSystem.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace dmg;

namespace
{

/// Real levels under a real system, since they are what the cycle is for.
struct Problem
{
  std::string Name;
  HarmonicSystem<double> System;
  LeastSquaresLevels Levels;

  int Size() const { return this->System.NumberOfFree(); }
};

/// A fifth of the faces or edges is prescribed; all unknowns are free.
Problem MakeProblem(const std::string& name, const test::Surface& surface, Discretisation kind)
{
  const SerialContext context;
  const TriangleMesh mesh = surface.Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 60;
  const ProlongationOperators operators =
    BuildSurfaceHierarchy(mesh, options, context, { false, false, false }).Operators;
  const auto fifth = [](int size)
  {
    std::vector<int> elements;
    for (int i = 0; i < size; i += 5)
    {
      elements.push_back(i);
    }
    return elements;
  };
  if (kind == Discretisation::FaceField)
  {
    const std::vector<int> faces = fifth(mesh.NumberOfFaces());
    return { name,
      MakeFaceFieldSystem(mesh, frames, { faces, std::vector<double>(faces.size(), 1.0) }, {}),
      NodalLevelsOfFaceFields(mesh, operators.Nodal, context) };
  }
  const std::vector<int> edges = fifth(mesh.NumberOfEdges());
  return { name, MakeOneFormSystem(mesh, { edges, std::vector<double>(edges.size(), 1.0) }, {}),
    NodalLevelsOfOneForms(mesh, frames, operators.Nodal, context) };
}

std::vector<Problem> Problems(int scale)
{
  std::vector<Problem> problems;
  for (const Discretisation kind : { Discretisation::FaceField, Discretisation::OneForm })
  {
    const std::string name = kind == Discretisation::FaceField ? "face field" : "1-form";
    problems.push_back(
      MakeProblem(name + " on a torus", test::IrregularTorus(24 * scale, 10 * scale, 3), kind));
    problems.push_back(
      MakeProblem(name + " on a plane", test::IrregularPlane(16 * scale, 12 * scale, 4), kind));
  }
  return problems;
}

}

TEST(TestLeastSquaresCycle, IsSymmetricPositiveDefinite)
{
  // Up to the rounding of single precision, in which the fine level is held.
  for (const Problem& problem : Problems(2))
  {
    SCOPED_TRACE(problem.Name);
    LeastSquaresCycle cycle(problem.System.Factor(), problem.Levels, {}, SerialContext());
    for (unsigned seed = 3401; seed < 3411; ++seed)
    {
      const auto x = test::RandomVector<double>(problem.Size(), seed);
      const auto y = test::RandomVector<double>(problem.Size(), seed + 100);
      Vector<double> Sx, Sy;
      cycle.Apply(x, Sx, SerialContext());
      cycle.Apply(y, Sy, SerialContext());
      const double scale = std::sqrt(x.dot(Sx) * y.dot(Sy));
      EXPECT_GT(x.dot(Sx), 0.0);
      EXPECT_NEAR(x.dot(Sy), y.dot(Sx), 1e-5 * scale);
      // No step of the cycle can increase the energy: S A has eigenvalues up to 1.
      const Vector<double> b = problem.System.Matrix() * x;
      Vector<double> z;
      cycle.Apply(b, z, SerialContext());
      const double energy = x.dot(b);
      EXPECT_LE(b.dot(z), (1.0 + 1e-5) * energy);
      EXPECT_GT(b.dot(z), 0.0);
    }
  }
}

TEST(TestLeastSquaresCycle, SpectrumIsThatOfAGoodPreconditioner)
{
  const Problem problem =
    MakeProblem("small", test::IrregularTorus(16, 8, 5), Discretisation::FaceField);
  const int size = problem.Size();
  LeastSquaresCycle cycle(problem.System.Factor(), problem.Levels, {}, SerialContext());
  Eigen::MatrixXd S(size, size);
  Vector<double> z;
  for (int j = 0; j < size; ++j)
  {
    cycle.Apply(Vector<double>::Unit(size, j), z, SerialContext());
    S.col(j) = z;
  }
  EXPECT_LE((S - S.transpose()).norm(), 1e-5 * S.norm());
  // S A x = lambda x as a symmetric problem: L^T S L has the same spectrum for A = L L^T.
  const Eigen::MatrixXd L = Eigen::MatrixXd(problem.System.Matrix()).llt().matrixL();
  const Eigen::MatrixXd symmetric = 0.5 * (S + S.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(L.transpose() * symmetric * L);
  EXPECT_LE(spectrum.eigenvalues().maxCoeff(), 1.0 + 1e-4);
  EXPECT_GE(spectrum.eigenvalues().minCoeff(), 0.3);
}

TEST(TestLeastSquaresCycle, ConjugateGradientsAgreeWithCholesky)
{
  for (const Problem& problem : Problems(4))
  {
    SCOPED_TRACE(problem.Name);
    const SparseMatrix<double>& A = problem.System.Matrix();
    const auto b = test::RandomVector<double>(problem.Size(), 3420);
    Vector<double> expected;
    CholeskySolver<double>(A).Solve(b, expected);

    // The first coarse level factored, or cycles below.
    for (const int largestFactor : { 25000, 100 })
    {
      LeastSquaresCycleOptions options;
      options.LargestFactor = largestFactor;
      LeastSquaresCycle cycle(problem.System.Factor(), problem.Levels, options, SerialContext());
      Vector<double> x;
      SolveReport report;
      StoppingCriteria stop;
      stop.RelativeTolerance = 1e-10;
      ConjugateGradient(A, cycle, b, stop, x, report, SerialContext());
      EXPECT_TRUE(report.Converged);
      EXPECT_LE(report.Iterations.size(), 21u);
      const Vector<double> error = x - expected;
      EXPECT_LE(std::sqrt(error.dot(A * error)), 1e-7 * std::sqrt(expected.dot(A * expected)));
    }
  }
}

TEST(TestLeastSquaresCycle, AnyDegreeAndSweeps)
{
  const Problem problem =
    MakeProblem("", test::IrregularTorus(40, 16, 5), Discretisation::FaceField);
  const auto b = test::RandomVector<double>(problem.Size(), 3421);
  int previous = 1000;
  for (const int sweeps : { 1, 2, 4 })
  {
    for (const int degree : { 0, 1, 3 })
    {
      LeastSquaresCycleOptions options;
      options.Sweeps = sweeps;
      options.ProlongationDegree = degree;
      LeastSquaresCycle cycle(problem.System.Factor(), problem.Levels, options, SerialContext());
      Vector<double> x;
      SolveReport report;
      ConjugateGradient(
        problem.System.Matrix(), cycle, b, StoppingCriteria(), x, report, SerialContext());
      EXPECT_TRUE(report.Converged) << sweeps << " sweeps, degree " << degree;
      if (degree == 3)
      {
        const int iterations = static_cast<int>(report.Iterations.size()) - 1;
        EXPECT_LE(iterations, previous) << "more sweeps";
        previous = iterations;
      }
    }
  }
}

TEST(TestLeastSquaresCycle, SameBitsForAnyNumberOfThreads)
{
  const Problem problem =
    MakeProblem("", test::IrregularTorus(120, 48, 5), Discretisation::FaceField);
  const auto r = test::RandomVector<double>(problem.Size(), 3422);
  LeastSquaresCycleOptions options;
  options.LargestFactor = 100; // what is factored may depend on the threads of the BLAS
  Vector<double> expected;
  LeastSquaresCycle(problem.System.Factor(), problem.Levels, options, SerialContext())
    .Apply(r, expected, SerialContext());
  for (const int threads : { 1, 2, 5 })
  {
    const test::TbbContext context(threads);
    Vector<double> z;
    LeastSquaresCycle(problem.System.Factor(), problem.Levels, options, context)
      .Apply(r, z, context);
    EXPECT_EQ(z, expected) << threads << " threads";
  }
}

TEST(TestLeastSquaresCycle, ReportsItsLevels)
{
  const Problem problem =
    MakeProblem("", test::IrregularTorus(40, 16, 5), Discretisation::FaceField);
  LeastSquaresCycle cycle(problem.System.Factor(), problem.Levels, {}, SerialContext());
  ASSERT_EQ(cycle.Levels().size(), 2u) << "the first coarse level is small enough to be factored";
  EXPECT_EQ(cycle.Levels()[0].Unknowns, problem.Size());
  EXPECT_EQ(cycle.Levels()[0].NonZeros, problem.System.Factor().nonZeros());
  EXPECT_EQ(cycle.Levels()[1].Unknowns, 2 * problem.Levels.Prolongation.cols());
  EXPECT_GT(cycle.Bytes(), 4 * problem.System.Factor().nonZeros());
}

TEST(TestLeastSquaresCycle, WrongSizesAreRefused)
{
  const Problem problem = MakeProblem("", test::IrregularTorus(24, 10, 5), Discretisation::OneForm);
  const auto make = [&](LeastSquaresLevels levels)
  {
    LeastSquaresCycle(
      problem.System.Factor(), std::move(levels), LeastSquaresCycleOptions(), SerialContext());
  };
  LeastSquaresLevels levels = problem.Levels;
  levels.Prolongation = PlanarProlongation(problem.Size() - 1, problem.Levels.Prolongation.cols());
  EXPECT_THROW(make(levels), InvalidInput);
  levels = problem.Levels;
  levels.Coarser.insert(
    levels.Coarser.begin(), SparseMatrix<double>(2 * problem.Levels.Prolongation.cols() + 2, 10));
  EXPECT_THROW(make(levels), InvalidInput);
}
