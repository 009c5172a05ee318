#include "FieldSolver.h"
#include "Partitions.h"
#include "Pieces/FieldSolverInPieces.h"
#include "ProblemsInPieces.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>

using namespace dmg;

namespace
{

const double Tolerance = 1e-8;

struct Problem
{
  std::string Name;
  test::Surface Surface;
};

/// Large enough for three levels.
std::vector<Problem> Problems()
{
  return {
    { "sphere", test::IrregularSphere(5, 3) },
    { "torus", test::IrregularTorus(160, 60, 4) },
    { "double torus", test::DoubleTorus(12) },
    { "plane", test::IrregularPlane(90, 80, 5) },
    { "needle", test::Needle(4, 20.0) },
  };
}

/// Directions on every hundredth triangle and at every ninetieth point, on the whole surface.
Constraints SomeDirections(const TriangleMesh& mesh)
{
  Constraints constraints;
  for (int face = 7; face < mesh.NumberOfFaces(); face += 100)
  {
    const Vector3 side = mesh.Position(mesh.Head(3 * face)) - mesh.Position(mesh.Tail(3 * face));
    constraints.OnFaces.push_back({ face, side.normalized(), 1.0 + (face % 3) });
  }
  for (int vertex = 11; vertex < mesh.NumberOfVertices(); vertex += 90)
  {
    const int h = mesh.OutgoingHalfedge(vertex);
    constraints.AtVertices.push_back({ vertex, mesh.Position(mesh.Head(h)) - mesh.Position(vertex), 2.0 });
  }
  return constraints;
}

/// Directions on all triangles of a region, whose inner vertices take all of it.
Constraints DirectionsOfRegion(const TriangleMesh& mesh)
{
  Constraints constraints;
  const double limit = mesh.VertexPositions().col(0).mean();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const Vector3 side = mesh.Position(mesh.Head(3 * face)) - mesh.Position(mesh.Tail(3 * face));
    if (mesh.Position(mesh.Tail(3 * face))[0] > limit)
    {
      constraints.OnFaces.push_back({ face, side.normalized(), 1.0 });
    }
  }
  return constraints;
}

Constraints SomeValues(const TriangleMesh& mesh)
{
  Constraints constraints;
  for (int vertex = 5; vertex < mesh.NumberOfVertices(); vertex += 200)
  {
    constraints.Values.push_back({ vertex, std::sin(static_cast<double>(vertex)), 1.0 });
  }
  return constraints;
}

/// The same surface, field and constraints on one process and in pieces.
class Comparison
{
public:
  Comparison(const test::Surface& surface, const FieldOptions& options, const Constraints& whole)
    : Surface(surface)
    , All(MPI_COMM_WORLD)
    , Reference(surface.Mesh())
  {
    this->Whole.Options = options;
    this->Whole.Constraints = whole;
    this->Whole.Stop = { Tolerance, 100 };
    FieldProblem problem = this->Whole;
    problem.Options.Solver.Kind = SolverKind::ConjugateGradients;
    this->Iterations = this->Reference.Solve(problem).Report.Returned;
    problem.Options.Solver.Kind = SolverKind::Cholesky;
    this->Exact = this->Reference.Solve(problem).Solution->Unknowns;
  }

  void Check(const test::NamedPartition& partition, const std::string& name)
  {
    SCOPED_TRACE(name + ", " + partition.Name);
    const test::CutPiece cut =
      test::CutOut(this->Surface, partition.RanksOfTriangles(this->Surface, this->All.Size()), this->All.Rank());
    FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
    const Field& field = solver.Solve(test::OfPiece(this->Whole, cut, this->Surface));
    EXPECT_TRUE(field.Report.Converged);
    EXPECT_LE(field.Report.Returned, this->Iterations + 2);
    const double error = this->Error(solver.Piece(), field, cut);
    EXPECT_LE(error, 10 * Tolerance);
    if (this->All.Rank() == 0 && std::getenv("DMG_TELL"))
    {
      std::cout << name << ", " << partition.Name << ": " << field.Report.Returned << " against " << this->Iterations
                << " iterations, error " << error << ", levels " << field.Report.Levels.size() << std::endl;
    }
  }

private:
  /// Relative to the exact solution, over all points of all pieces.
  double Error(const PieceOfSurface& piece, const Field& field, const test::CutPiece& cut) const
  {
    const bool isFunction = this->Whole.Options.Field.Kind == DiscretisationKind::ScalarFunction;
    const Vector<Complex> found = test::UnknownsOf(field);
    double squares = 0.0;
    double differences = 0.0;
    for (std::size_t i = 0; i < cut.Points.size(); ++i)
    {
      const int here = piece.VerticesOfPoints()[i];
      const int there = cut.Points[i];
      Complex expected;
      if (isFunction)
      {
        expected = this->Exact[there];
      }
      else
      {
        // The axes of both frames may differ, and the powers turn N times as far.
        const Complex axis =
          piece.Surface().Vertices.ToComplex(here, this->Reference.Surface().Vertices.X.row(there).transpose());
        expected = AsComplex(this->Exact)[there] * std::pow(axis, field.N);
      }
      squares += std::norm(expected);
      differences += std::norm(found[here] - expected);
    }
    return std::sqrt(this->All.Sum(differences) / this->All.Sum(squares));
  }

  const test::Surface& Surface;
  const Ranks All;
  FieldSolver Reference;
  FieldProblem Whole;
  int Iterations = 0;
  Vector<double> Exact; ///< unknowns
};

FieldOptions Crosses()
{
  return {};
}

FieldOptions Functions()
{
  FieldOptions options;
  options.Field.Kind = DiscretisationKind::ScalarFunction;
  return options;
}

}

TEST(SolutionsInPieces, SoftDirectionsHaveTheFieldOfOneProcess)
{
  for (const Problem& problem : Problems())
  {
    Comparison comparison(problem.Surface, Crosses(), SomeDirections(problem.Surface.Mesh()));
    for (const test::NamedPartition& partition : test::Partitions())
    {
      comparison.Check(partition, problem.Name);
      if (Ranks(MPI_COMM_WORLD).Size() == 1) // which has all, whatever the partition
      {
        break;
      }
    }
  }
}

TEST(SolutionsInPieces, HardDirectionsHaveTheFieldOfOneProcess)
{
  FieldOptions options = Crosses();
  options.Constraints = ConstraintKind::Hard;
  for (const Problem& problem : Problems())
  {
    Comparison comparison(problem.Surface, options, SomeDirections(problem.Surface.Mesh()));
    comparison.Check(test::Partitions()[1], problem.Name);
  }
}

TEST(SolutionsInPieces, RegionsOfDirectionsHaveTheFieldOfOneProcess)
{
  FieldOptions options = Crosses();
  for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    options.Constraints = kind;
    const test::Surface surface = test::IrregularTorus(160, 60, 4);
    Comparison comparison(surface, options, DirectionsOfRegion(surface.Mesh()));
    comparison.Check(test::Partitions()[1], "half of a torus");
  }
}

TEST(SolutionsInPieces, AllWeightsHaveTheFieldOfOneProcess)
{
  const test::Surface surface = test::IrregularSphere(5, 3);
  for (const double alignment : { 1e-6, 1e-3, 1e4, 1e8, 1e12 })
  {
    FieldOptions options = Crosses();
    options.Alignment = alignment;
    Comparison comparison(surface, options, SomeDirections(surface.Mesh()));
    comparison.Check(test::Partitions()[1], "weight " + std::to_string(alignment));
  }
}

TEST(SolutionsInPieces, FunctionsAreThoseOfOneProcess)
{
  FieldOptions options = Functions();
  for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    options.Constraints = kind;
    for (const Problem& problem : Problems())
    {
      Comparison comparison(problem.Surface, options, SomeValues(problem.Surface.Mesh()));
      comparison.Check(test::Partitions()[kind == ConstraintKind::Soft ? 0 : 1], problem.Name);
    }
  }
}

TEST(SolutionsInPieces, FourLevelsHaveTheFieldOfOneProcess)
{
  const test::Surface surface = test::IrregularTorus(300, 120, 6);
  Comparison comparison(surface, Crosses(), SomeDirections(surface.Mesh()));
  comparison.Check(test::Partitions()[0], "large torus");
}

TEST(SolutionsInPieces, AnyNumberOfDirectionsHasTheFieldOfOneProcess)
{
  const test::Surface surface = test::IrregularSphere(4, 3);
  for (const int N : { 1, 2, 6 })
  {
    FieldOptions options = Crosses();
    options.Field.N = N;
    Comparison comparison(surface, options, SomeDirections(surface.Mesh()));
    comparison.Check(test::Partitions()[1], "N = " + std::to_string(N));
  }
}

TEST(SolutionsInPieces, PointsAreJoinedByGlobalIds)
{
  // The same places twice, which only ids tell apart.
  test::Surface surface = test::Union(test::Icosphere(3), test::Icosphere(3), Vector3::Zero());
  const Ranks ranks(MPI_COMM_WORLD);
  test::CutPiece cut =
    test::CutOut(surface, test::Partitions()[1].RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
  for (const int point : cut.Points)
  {
    cut.Piece.GlobalIds.push_back(1000LL * 1000LL * 1000LL * 1000LL + point);
  }
  const FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  EXPECT_EQ(solver.Piece().GlobalNumberOfVertices(), surface.V.rows());
}

TEST(SolutionsInPieces, FunctionsAreZeroOnComponentsWithoutValues)
{
  const test::Surface surface = test::Union(test::Union(test::Icosphere(3), test::Disk(12), Vector3(4.0, 0.0, 0.0)),
    test::Icosphere(2), Vector3(0.0, 4.0, 0.0));
  const Ranks ranks(MPI_COMM_WORLD);
  for (const test::NamedPartition& partition : test::Partitions())
  {
    const test::CutPiece cut = test::CutOut(surface, partition.RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
    FieldProblem whole;
    whole.Options = Functions();
    whole.Constraints.Values = { { 3, 1.0, 1.0 }, { 100, 2.0, 1.0 } };
    FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
    const Field& field = solver.Solve(test::OfPiece(whole, cut, surface));
    EXPECT_TRUE(field.Report.Converged);
    ASSERT_EQ(field.Report.Warnings.size(), 1);
    EXPECT_EQ(field.Report.Warnings[0].find("2 components"), 0);
    for (std::size_t i = 0; i < cut.Points.size(); ++i)
    {
      const bool isHeld = cut.Points[i] < test::Icosphere(3).V.rows();
      const double size = std::abs(field.Solution->Unknowns[solver.Piece().VerticesOfPoints()[i]]);
      EXPECT_EQ(size > 0.0, isHeld) << size;
    }
  }
}

/// The system follows from penalties, and other values leave it as it is.
TEST(SolutionsInPieces, OtherValuesKeepTheSystem)
{
  const test::Surface surface = test::IrregularTorus(80, 30, 4);
  const Ranks ranks(MPI_COMM_WORLD);
  const test::CutPiece cut =
    test::CutOut(surface, test::Partitions()[1].RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
  const TriangleMesh mesh = surface.Mesh();
  const Constraints first = SomeDirections(mesh);
  Constraints turned = first;
  for (Constraint& constraint : turned.OnFaces) // to another side of their triangles
  {
    const int h = 3 * constraint.Element + 1;
    constraint.Direction = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).normalized();
  }
  Constraints heavier = turned;
  heavier.OnFaces[2].Weight *= 2.0; // on one rank
  for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
    int systems = 0;
    int solves = 0;
    const auto solveAndCompare = [&](const Constraints& whole, int newSystems, int newSolves = 1)
    {
      FieldProblem problem;
      problem.Constraints = whole;
      problem.Options.Constraints = kind;
      problem.Stop = { Tolerance, 100 };
      const FieldProblem own = test::OfPiece(problem, cut, surface);
      const Field& field = solver.Solve(own);
      EXPECT_TRUE(field.Report.Converged);
      EXPECT_EQ(solver.Counts().Systems, systems += newSystems);
      EXPECT_EQ(solver.Counts().Solves, solves += newSolves);
      FieldSolverInPieces freshSolver(MPI_COMM_WORLD, cut.Piece);
      const Field& fresh = freshSolver.Solve(own);
      EXPECT_EQ(field.Report.Returned, fresh.Report.Returned);
      const Vector<double>& expected = fresh.Solution->Unknowns;
      const double size = ranks.Max(expected.size() > 0 ? expected.cwiseAbs().maxCoeff() : 0.0);
      EXPECT_LE((field.Solution->Unknowns - expected).norm(), 1e-12 * size);
    };
    const bool isHard = kind == ConstraintKind::Hard; // without penalties, weights only weigh what meets at a vertex
    solveAndCompare(first, 1);
    solveAndCompare(turned, 0);
    solveAndCompare(heavier, isHard ? 0 : 1, isHard ? 0 : 1);
    solveAndCompare(first, isHard ? 0 : 1);
    solveAndCompare({}, 1);
    solveAndCompare(turned, 1);
  }
}
