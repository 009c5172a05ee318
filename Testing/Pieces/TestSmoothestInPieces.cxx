#include "FieldSolver.h"
#include "Operators/ConnectionLaplacian.h"
#include "Partitions.h"
#include "Pieces/FieldSolverInPieces.h"
#include "ProblemsInPieces.h"
#include "Support/ComplexPairs.h"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace dmg;

namespace
{

/// A surface in pieces and on one process, with its smoothest field on both.
class Smoothest
{
public:
  Smoothest(const test::Surface& surface, const std::vector<int>& ranksOfTriangles, const DiscretisationOptions& field)
    : Surface(surface)
    , All(MPI_COMM_WORLD)
    , Cut(test::CutOut(surface, ranksOfTriangles, this->All.Rank()))
    , Reference(surface.Mesh())
    , Solver(MPI_COMM_WORLD, this->Cut.Piece)
  {
    this->Problem.Options.Field = field;
  }

  const Field& Solve() { return this->Solver.Solve(test::OfPiece(this->Problem, this->Cut, this->Surface)); }

  /// Of the whole surface, from the pieces, in the frames of one process.
  Vector<Complex> Gather(const Field& field) const
  {
    const Vector<Complex> powers = test::UnknownsOf(field);
    Vector<double> sums = Vector<double>::Zero(2 * this->Surface.V.rows());
    for (std::size_t i = 0; i < this->Cut.Points.size(); ++i)
    {
      const int here = this->Solver.Piece().VerticesOfPoints()[i];
      if (this->Solver.Piece().IsOwned(here))
      {
        const int there = this->Cut.Points[i];
        const Complex axis = this->Solver.Piece().Surface().Vertices.ToComplex(
          here, this->Reference.Surface().Vertices.X.row(there).transpose());
        const Complex value = powers[here] * std::pow(std::conj(axis), field.N);
        sums[2 * there] = value.real();
        sums[2 * there + 1] = value.imag();
      }
    }
    this->All.Sum(sums.data(), static_cast<int>(sums.size()));
    return AsComplex(sums);
  }

  /// By a solver that factors the system.
  const Field& Expected()
  {
    FieldProblem problem = this->Problem;
    problem.Options.Solver.Kind = SolverKind::Cholesky;
    problem.Stop = { 1e-8, 200 };
    return this->Reference.Solve(problem);
  }

  const test::Surface& Surface;
  const Ranks All;
  const test::CutPiece Cut;
  FieldSolver Reference;
  FieldSolverInPieces Solver;
  FieldProblem Problem;
};

/// Without symmetries, which make eigenvalues multiple or nearly so.
test::Surface Bent(test::Surface surface)
{
  const Eigen::ArrayXd x = surface.V.col(0).array() / surface.V.col(0).cwiseAbs().maxCoeff();
  const Eigen::ArrayXd y = surface.V.col(1).array() / surface.V.col(1).cwiseAbs().maxCoeff();
  surface.V.col(0) *= 1.5;
  surface.V.col(1).array() *= 1.0 + 0.3 * x;
  surface.V.col(2).array() += surface.V.col(1).cwiseAbs().maxCoeff() * (0.4 * x * x * x - 0.2 * x * y);
  return surface;
}

/// The distance of two fields on some vertices, the second turned and scaled as a whole to be nearest, relative to the first.
double DistanceUpToPhase(const Vector<Complex>& a, const Vector<Complex>& b)
{
  return (a - b.dot(a) / b.squaredNorm() * b).norm() / a.norm();
}

/// Weighted by areas.
double MeanSquare(const Vector<Complex>& field, const Vector<double>& mass)
{
  return mass.dot(field.cwiseAbs2()) / mass.sum();
}

std::vector<double> Sorted(std::vector<double> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void ExpectSameEigenvalues(const Field& field, const Field& expected)
{
  const std::vector<double> here = Sorted(field.Report.Eigenvalues);
  const std::vector<double> there = Sorted(expected.Solution->Report.Eigenvalues);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 0; k < here.size(); ++k)
  {
    EXPECT_NEAR(here[k], there[k], 1e-8 * there[k]);
  }
}

}

TEST(SmoothestInPieces, IsThatOfOneProcessUpToItsPhase)
{
  struct Problem
  {
    std::string Name;
    test::Surface Surface;
    int N;
  };
  const std::vector<Problem> problems = {
    { "torus", Bent(test::IrregularTorus(160, 60, 4)), 4 },
    { "double torus", Bent(test::DoubleTorus(10)), 4 },
    { "plane", Bent(test::IrregularPlane(70, 40, 5)), 4 },
    { "disk, N = 1", Bent(test::Disk(20)), 1 },
    { "double torus, N = 2", Bent(test::DoubleTorus(6)), 2 },
  };
  for (const Problem& problem : problems)
  {
    for (const test::NamedPartition& partition : test::Partitions())
    {
      SCOPED_TRACE(problem.Name + ", " + partition.Name);
      DiscretisationOptions options;
      options.N = problem.N;
      Smoothest smoothest(
        problem.Surface, partition.RanksOfTriangles(problem.Surface, Ranks(MPI_COMM_WORLD).Size()), options);
      const Field& field = smoothest.Solve();
      EXPECT_TRUE(field.Report.Converged);
      EXPECT_EQ(field.Report.Eigenvalues.size(), 1);
      const Field& expected = smoothest.Expected();
      ExpectSameEigenvalues(field, expected);
      const Vector<Complex> exact = AsComplex(expected.Solution->Unknowns);
      const Vector<Complex> found = smoothest.Gather(field);
      EXPECT_LE(DistanceUpToPhase(found, exact), 1e-4);
      EXPECT_NEAR(MeanSquare(found, LumpedMass(problem.Surface.Mesh())), 1.0, 1e-9);
      ++smoothest.Problem.Stop.MaximumIterations;
      EXPECT_LE(smoothest.Solve().Report.Returned, 1); // it starts from there
      if (smoothest.All.Size() == 1)                   // which has all, whatever the partition
      {
        break;
      }
    }
  }
}

/// The lowest eigenvalue of a sphere is multiple, and any of its vectors is as good: it is one if L x = theta M x. The error of x
/// in the energy norm is about the norm of that residual in L^-1, over the distance to the next eigenvalue.
TEST(SmoothestInPieces, MultipleEigenvaluesOfSpheresHaveAnyOfTheirFields)
{
  const test::Surface surface = test::Icosphere(4);
  for (const int N : { 1, 4 })
  {
    DiscretisationOptions options;
    options.N = N;
    Smoothest smoothest(
      surface, test::Partitions()[1].RanksOfTriangles(surface, Ranks(MPI_COMM_WORLD).Size()), options);
    const Field& field = smoothest.Solve();
    EXPECT_TRUE(field.Report.Converged);
    ExpectSameEigenvalues(field, smoothest.Expected());
    EXPECT_NEAR(field.Report.Eigenvalues.at(0), N, 0.02 * N);

    const FramedMesh framed(surface.Mesh());
    const SparseMatrix<Complex> L = ConnectionLaplacian(framed.Mesh, VertexConnection(framed, SerialContext()), N);
    const Vector<double> mass = LumpedMass(framed.Mesh);
    const Vector<Complex> x = smoothest.Gather(field);
    const Vector<Complex> r = L * x - field.Report.Eigenvalues[0] * Vector<Complex>(mass.cwiseProduct(x));
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> factor{ Eigen::SparseMatrix<Complex>(L) };
    const Vector<Complex> solved = factor.solve(r);
    const double energy = x.dot(Vector<Complex>(L * x)).real();
    EXPECT_LE(std::sqrt(r.dot(solved).real() / energy), 1e-5);
  }
}

TEST(SmoothestInPieces, ComponentsWithoutConstraintsHaveTheirOwn)
{
  // Three components; the second is on one rank only, and so is the third.
  const test::Surface first = Bent(test::IrregularTorus(40, 20, 4));
  const test::Surface second = Bent(test::IrregularPlane(20, 14, 3));
  const test::Surface third = Bent(test::DoubleTorus(4));
  const test::Surface surface =
    test::Union(test::Union(first, second, Vector3(4.0, 0.0, 0.0)), third, Vector3(0.0, 40.0, 0.0));
  const int ranks = Ranks(MPI_COMM_WORLD).Size();
  std::vector<int> ranksOfTriangles = test::Partitions()[0].RanksOfTriangles(first, ranks);
  ranksOfTriangles.insert(ranksOfTriangles.end(), second.F.rows(), ranks - 1);
  ranksOfTriangles.insert(ranksOfTriangles.end(), third.F.rows(), 0);
  const std::vector<int> inTiles = test::Partitions()[1].RanksOfTriangles(surface, ranks);
  for (const std::vector<int>& partition : { ranksOfTriangles, inTiles })
  {
    Smoothest smoothest(surface, partition, {});
    smoothest.Problem.Constraints.OnFaces.push_back(
      { 3, surface.V.row(surface.F(3, 1)).transpose() - surface.V.row(surface.F(3, 0)).transpose(), 1.0 });
    smoothest.Problem.Stop = { 1e-8, 100 };
    const Field& field = smoothest.Solve();
    EXPECT_TRUE(field.Report.Converged);
    EXPECT_EQ(field.Report.Eigenvalues.size(), 2);
    const Field& expected = smoothest.Expected();
    ExpectSameEigenvalues(field, expected);
    const Vector<Complex> exact = AsComplex(expected.Solution->Unknowns);
    const Vector<Complex> found = smoothest.Gather(field);
    const Vector<double> mass = LumpedMass(surface.Mesh());
    const Eigen::Index begins[] = { 0, first.V.rows(), first.V.rows() + second.V.rows(), surface.V.rows() };
    for (int component = 0; component < 3; ++component)
    {
      const auto part = Eigen::seq(begins[component], begins[component + 1] - 1);
      EXPECT_LE(DistanceUpToPhase(found(part), exact(part)), 1e-4) << component;
      if (component > 0) // on one process, the unit follows from what is prescribed
      {
        EXPECT_NEAR(MeanSquare(found(part), mass(part)), 1.0, 1e-9);
      }
    }
    EXPECT_LE((found - exact).head(begins[1]).norm() / exact.head(begins[1]).norm(), 1e-7);
  }
}
