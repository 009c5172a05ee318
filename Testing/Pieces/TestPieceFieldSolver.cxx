#include "Pieces/PieceFieldSolver.h"

#include "FieldSolver.h"
#include "Partitions.h"
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

/// The constraints of a piece. All ranks that have a point give what holds there.
Constraints OfPiece(const Constraints& whole, const test::CutPiece& cut, const test::Surface& surface)
{
  std::vector<int> triangles(surface.F.rows(), -1);
  std::vector<int> points(surface.V.rows(), -1);
  for (std::size_t i = 0; i < cut.Triangles.size(); ++i)
  {
    triangles[cut.Triangles[i]] = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < cut.Points.size(); ++i)
  {
    points[cut.Points[i]] = static_cast<int>(i);
  }
  Constraints own;
  for (Constraint constraint : whole.OnFaces)
  {
    constraint.Element = triangles[constraint.Element];
    if (constraint.Element >= 0)
    {
      own.OnFaces.push_back(constraint);
    }
  }
  for (Constraint constraint : whole.AtVertices)
  {
    constraint.Element = points[constraint.Element];
    if (constraint.Element >= 0)
    {
      own.AtVertices.push_back(constraint);
    }
  }
  for (ValueConstraint value : whole.Values)
  {
    value.Vertex = points[value.Vertex];
    if (value.Vertex >= 0)
    {
      own.Values.push_back(value);
    }
  }
  return own;
}

/// The same surface, field and constraints on one process and in pieces.
class Comparison
{
public:
  Comparison(const test::Surface& surface, const FieldOptions& options, const Constraints& whole)
    : Surface(surface)
    , Options(options)
    , Whole(whole)
    , All(MPI_COMM_WORLD)
  {
    FieldProblem problem;
    problem.Options = options;
    problem.Constraints = whole;
    problem.Stop = { Tolerance, 100 };
    problem.Options.Solver.Kind = SolverKind::ConjugateGradients;
    FieldSolver iterating(surface.Mesh());
    this->Iterations = iterating.Solve(problem).Report.Returned;
    problem.Options.Solver.Kind = SolverKind::Cholesky;
    this->Reference = std::make_unique<FieldSolver>(surface.Mesh());
    this->Reference->Solve(problem);
    this->Exact = problem;
  }

  void Check(const test::NamedPartition& partition, const std::string& name)
  {
    SCOPED_TRACE(name + ", " + partition.Name);
    const test::CutPiece cut =
      test::CutOut(this->Surface, partition.RanksOfTriangles(this->Surface, this->All.Size()), this->All.Rank());
    PieceFieldSolver solver(MPI_COMM_WORLD, cut.Piece, this->Options.Field);
    const PieceField field =
      solver.Solve(OfPiece(this->Whole, cut, this->Surface), this->Options.Weights(), { Tolerance, 100 });
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

  /// Directions and singularities of own triangles.
  void CheckDirections(const test::NamedPartition& partition)
  {
    const int N = this->Options.Field.N;
    const test::CutPiece cut =
      test::CutOut(this->Surface, partition.RanksOfTriangles(this->Surface, this->All.Size()), this->All.Rank());
    PieceFieldSolver solver(MPI_COMM_WORLD, cut.Piece, this->Options.Field);
    const Field field = solver.Directions(
      solver.Solve(OfPiece(this->Whole, cut, this->Surface), this->Options.Weights(), { 1e-11, 100 }));
    const Field& exact = this->Reference->Solve(this->Exact);
    double sum = 0.0;
    for (std::size_t i = 0; i < cut.Triangles.size(); ++i)
    {
      const int face = solver.Piece().FirstOwnFace() + static_cast<int>(i);
      const int there = cut.Triangles[i];
      // The corners come in the same order, so frames are equal. Any of the N directions may be the first.
      const Complex quotient = field.OnFaces[face] / exact.OnFaces[there];
      EXPECT_LE(std::abs(std::pow(quotient, N) - 1.0), 1e-5) << "triangle " << there;
      EXPECT_NEAR(field.Indices[face], exact.Indices[there], 1e-9) << "triangle " << there;
      sum += field.Indices[face];
    }
    EXPECT_NEAR(this->All.Sum(sum), this->Surface.Mesh().EulerCharacteristic(), 1e-9);
  }

private:
  /// Relative to the exact solution, over all points of all pieces.
  double Error(const PieceOfSurface& piece, const PieceField& field, const test::CutPiece& cut) const
  {
    const bool isFunction = this->Options.Field.Kind == DiscretisationKind::ScalarFunction;
    const Field& exact = this->Reference->Solve(this->Exact);
    const Vector<double>& unknowns = exact.Solution->Unknowns;
    double squares = 0.0;
    double differences = 0.0;
    for (std::size_t i = 0; i < cut.Points.size(); ++i)
    {
      const int here = piece.VerticesOfPoints()[i];
      const int there = cut.Points[i];
      Complex expected;
      if (isFunction)
      {
        expected = unknowns[there];
      }
      else
      {
        // The axes of both frames may differ, and the powers turn N times as far.
        const Complex axis =
          piece.Surface().Vertices.ToComplex(here, this->Reference->Surface().Vertices.X.row(there).transpose());
        expected = AsComplex(unknowns)[there] * std::pow(axis, this->Options.Field.N);
      }
      squares += std::norm(expected);
      differences += std::norm(field.AtVertices[here] - expected);
    }
    return std::sqrt(this->All.Sum(differences) / this->All.Sum(squares));
  }

  const test::Surface& Surface;
  const FieldOptions Options;
  const Constraints Whole;
  const Ranks All;
  int Iterations = 0;
  FieldProblem Exact;
  std::unique_ptr<FieldSolver> Reference;
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

TEST(TestPieceFieldSolver, SoftDirectionsAsOnOneProcess)
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

TEST(TestPieceFieldSolver, HardDirectionsAsOnOneProcess)
{
  FieldOptions options = Crosses();
  options.Constraints = ConstraintKind::Hard;
  for (const Problem& problem : Problems())
  {
    Comparison comparison(problem.Surface, options, SomeDirections(problem.Surface.Mesh()));
    comparison.Check(test::Partitions()[1], problem.Name);
  }
}

TEST(TestPieceFieldSolver, RegionsOfDirectionsAsOnOneProcess)
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

TEST(TestPieceFieldSolver, AllWeightsAsOnOneProcess)
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

TEST(TestPieceFieldSolver, FunctionsAsOnOneProcess)
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

TEST(TestPieceFieldSolver, FourLevelsAsOnOneProcess)
{
  const test::Surface surface = test::IrregularTorus(300, 120, 6);
  Comparison comparison(surface, Crosses(), SomeDirections(surface.Mesh()));
  comparison.Check(test::Partitions()[0], "large torus");
}

TEST(TestPieceFieldSolver, AnyNumberOfDirectionsAsOnOneProcess)
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

TEST(TestPieceFieldSolver, PointsAreJoinedByGlobalIds)
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
  const PieceFieldSolver solver(MPI_COMM_WORLD, cut.Piece, {});
  EXPECT_EQ(solver.Piece().GlobalNumberOfVertices(), surface.V.rows());
}

TEST(TestPieceFieldSolver, FunctionsAreZeroOnComponentsWithoutValues)
{
  const test::Surface surface = test::Union(test::Union(test::Icosphere(3), test::Disk(12), Vector3(4.0, 0.0, 0.0)),
    test::Icosphere(2), Vector3(0.0, 4.0, 0.0));
  const Ranks ranks(MPI_COMM_WORLD);
  for (const test::NamedPartition& partition : test::Partitions())
  {
    const test::CutPiece cut = test::CutOut(surface, partition.RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
    Constraints whole;
    whole.Values = { { 3, 1.0, 1.0 }, { 100, 2.0, 1.0 } };
    PieceFieldSolver solver(MPI_COMM_WORLD, cut.Piece, Functions().Field);
    const PieceField field = solver.Solve(OfPiece(whole, cut, surface));
    EXPECT_TRUE(field.Report.Converged);
    EXPECT_EQ(field.UnheldComponents, 2);
    EXPECT_EQ(field.Report.Warnings.size(), 1);
    for (std::size_t i = 0; i < cut.Points.size(); ++i)
    {
      const bool isHeld = cut.Points[i] < test::Icosphere(3).V.rows();
      const double size = std::abs(field.AtVertices[solver.Piece().VerticesOfPoints()[i]]);
      EXPECT_EQ(size > 0.0, isHeld) << size;
    }
  }
}

TEST(TestPieceFieldSolver, DirectionsAndSingularitiesAsOnOneProcess)
{
  for (const test::Surface& surface : { test::IrregularSphere(4, 3), test::DoubleTorus(8) })
  {
    Comparison comparison(surface, Crosses(), SomeDirections(surface.Mesh()));
    for (const test::NamedPartition& partition : test::Partitions())
    {
      SCOPED_TRACE(partition.Name);
      comparison.CheckDirections(partition);
    }
  }
}

/// The system follows from penalties, and other values leave it as it is.
TEST(TestPieceFieldSolver, OtherValuesKeepTheSystem)
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
    FieldWeights weights;
    weights.Constraints = kind;
    PieceFieldSolver solver(MPI_COMM_WORLD, cut.Piece, {});
    int systems = 0;
    int solves = 0;
    const auto solveAndCompare = [&](const Constraints& whole, int newSystems)
    {
      const Constraints own = OfPiece(whole, cut, surface);
      const PieceField field = solver.Solve(own, weights, { Tolerance, 100 });
      EXPECT_TRUE(field.Report.Converged);
      EXPECT_EQ(solver.Counts().Systems, systems += newSystems);
      EXPECT_EQ(solver.Counts().Solves, ++solves);
      PieceFieldSolver fresh(MPI_COMM_WORLD, cut.Piece, {});
      const PieceField expected = fresh.Solve(own, weights, { Tolerance, 100 });
      EXPECT_EQ(field.Report.Returned, expected.Report.Returned);
      const double size = ranks.Max(expected.AtVertices.size() > 0 ? expected.AtVertices.cwiseAbs().maxCoeff() : 0.0);
      EXPECT_LE((field.AtVertices - expected.AtVertices).norm(), 1e-12 * size);
    };
    const bool isHard = kind == ConstraintKind::Hard; // without penalties, weights only weigh what meets at a vertex
    solveAndCompare(first, 1);
    solveAndCompare(turned, 0);
    solveAndCompare(heavier, isHard ? 0 : 1);
    solveAndCompare(first, isHard ? 0 : 1);
    solveAndCompare({}, 1);
    solveAndCompare(turned, 1);
  }
}
