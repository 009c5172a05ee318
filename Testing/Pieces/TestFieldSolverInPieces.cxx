#include "Pieces/FieldSolverInPieces.h"

#include "FieldSolver.h"
#include "Partitions.h"
#include "ProblemsInPieces.h"
#include "Support/Errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace dmg;

namespace
{

const double Tolerance = 1e-8;

/// The same problem on one process and in pieces.
class Comparison
{
public:
  Comparison(const test::Surface& surface, FieldProblem problem)
    : Surface(surface)
    , Whole(std::move(problem))
    , Reference(surface.Mesh())
    , All(MPI_COMM_WORLD)
  {
    this->Whole.Stop = { Tolerance, 100 };
    FieldProblem factored = this->Whole;
    factored.Options.Solver.Kind = SolverKind::Cholesky;
    this->Reference.Solve(factored);
    this->Exact = &this->Reference.Solve(factored);
  }

  test::CutPiece Cut(const test::NamedPartition& partition) const
  {
    return test::CutOut(this->Surface, partition.RanksOfTriangles(this->Surface, this->All.Size()), this->All.Rank());
  }

  void Check(const test::NamedPartition& partition) const
  {
    SCOPED_TRACE(partition.Name);
    const test::CutPiece cut = this->Cut(partition);
    FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
    const Field& field = solver.Solve(test::OfPiece(this->Whole, cut, this->Surface));
    EXPECT_TRUE(field.Report.Converged);
    EXPECT_EQ(field.N, this->Exact->N);
    EXPECT_EQ(field.AreSingularitiesOnFaces, this->Exact->AreSingularitiesOnFaces);
    this->CheckPowers(solver, field, cut);
    this->CheckIndices(solver, field, cut);
    this->CheckPrescribed(solver, *field.Solution, cut);
  }

private:
  /// The frames of own triangles are those of the whole surface, as the corners come in the same order.
  void CheckPowers(const FieldSolverInPieces& solver, const Field& field, const test::CutPiece& cut) const
  {
    double squares = 0.0, differences = 0.0;
    for (std::size_t i = 0; i < cut.Triangles.size(); ++i)
    {
      const Complex expected = this->Exact->Powers.Faces[cut.Triangles[i]];
      const int face = solver.Piece().FirstOwnFace() + static_cast<int>(i);
      squares += std::norm(expected);
      differences += std::norm(field.Powers.Faces[face] - expected);
      EXPECT_NEAR(std::abs(PowerOfDirection(field.OnFaces[face], field.N) - field.Powers.Faces[face]), 0.0, 1e-9);
    }
    const double error = std::sqrt(this->All.Sum(differences) / this->All.Sum(squares));
    EXPECT_LE(error, 10.0 * Tolerance);
  }

  /// The elements that hold something, without those that are held only because a constant is free.
  static std::vector<double> WeightsOf(const FieldConstraints& constraints, int size)
  {
    std::vector<double> weights(size, 0.0);
    for (std::size_t k = 0; k < constraints.Elements.size(); ++k)
    {
      weights[constraints.Elements[k]] = constraints.Weights[k];
    }
    for (const int element : constraints.Pinned)
    {
      weights[element] = 0.0;
    }
    return weights;
  }

  void CheckPrescribed(
    const FieldSolverInPieces& solver, const FieldSolution& solution, const test::CutPiece& cut) const
  {
    const std::vector<double> here = WeightsOf(solution.Constraints, solver.Piece().NumberOfVertices());
    const std::vector<double> there =
      WeightsOf(this->Exact->Solution->Constraints, static_cast<int>(this->Surface.V.rows()));
    for (std::size_t i = 0; i < cut.Points.size(); ++i)
    {
      const double expected = there[cut.Points[i]];
      EXPECT_NEAR(here[solver.Piece().VerticesOfPoints()[i]], expected, 1e-9 * expected) << "point " << cut.Points[i];
    }
  }

  void CheckIndices(const FieldSolverInPieces& solver, const Field& field, const test::CutPiece& cut) const
  {
    double sum = 0.0;
    for (Eigen::Index element = 0; element < field.Indices.size(); ++element)
    {
      sum += solver.ReportsIndexOf(static_cast<int>(element)) ? field.Indices[element] : 0.0;
    }
    EXPECT_NEAR(this->All.Sum(sum), this->Exact->Indices.sum(), 1e-9);
    const std::vector<int>& elements = field.AreSingularitiesOnFaces ? cut.Triangles : cut.Points;
    for (std::size_t i = 0; i < elements.size(); ++i)
    {
      const int here = field.AreSingularitiesOnFaces ? solver.Piece().FirstOwnFace() + static_cast<int>(i)
                                                     : solver.Piece().VerticesOfPoints()[i];
      EXPECT_NEAR(field.Indices[here], this->Exact->Indices[elements[i]], 1e-9) << "element " << elements[i];
    }
  }

  const test::Surface Surface;
  FieldProblem Whole;
  FieldSolver Reference;
  const Field* Exact;
  const Ranks All;
};

FieldProblem SomeDirections(const TriangleMesh& mesh)
{
  FieldProblem problem;
  for (int face = 7; face < mesh.NumberOfFaces(); face += 100)
  {
    const Vector3 side = mesh.Position(mesh.Head(3 * face)) - mesh.Position(mesh.Tail(3 * face));
    problem.Constraints.OnFaces.push_back({ face, side.normalized(), 1.0 + (face % 3) });
  }
  for (int vertex = 11; vertex < mesh.NumberOfVertices(); vertex += 90)
  {
    const int h = mesh.OutgoingHalfedge(vertex);
    problem.Constraints.AtVertices.push_back({ vertex, mesh.Position(mesh.Head(h)) - mesh.Position(vertex), 2.0 });
  }
  return problem;
}

FieldProblem SomeValues(const TriangleMesh& mesh)
{
  FieldProblem problem;
  problem.Options.Field.Kind = DiscretisationKind::ScalarFunction;
  for (int vertex = 5; vertex < mesh.NumberOfVertices(); vertex += 200)
  {
    problem.Constraints.Values.push_back({ vertex, std::sin(static_cast<double>(vertex)), 1.0 });
  }
  return problem;
}

void CheckOnAllPartitions(const test::Surface& surface, const FieldProblem& problem)
{
  const Comparison comparison(surface, problem);
  for (const test::NamedPartition& partition : test::Partitions())
  {
    comparison.Check(partition);
  }
}

}

TEST(FieldSolverInPieces, FollowsArraysAsOnOneProcess)
{
  for (const test::Surface& surface : { test::DoubleTorus(8), test::Annulus(30, 6), test::IrregularSphere(4, 3) })
  {
    CheckOnAllPartitions(surface, SomeDirections(surface.Mesh()));
    CheckOnAllPartitions(surface, SomeValues(surface.Mesh()));
  }
}

TEST(FieldSolverInPieces, FollowsGuidesAndFeaturesAsOnOneProcess)
{
  const test::Surface surface = test::Prism(24, 16);
  FieldProblem problem;
  problem.Guides.Lines = { { { Vector3(1.0, 0.1, 0.1), Vector3(0.1, 1.0, 0.5), Vector3(-0.9, 0.2, 0.8) } } };
  problem.Guides.Vectors = { { Vector3(0.0, -1.1, 0.4), Vector3(1.0, 0.0, 1.0), 3.0 } };
  problem.Features.BoundaryWeight = 1.0;
  problem.Features.SharpEdgesWeight = 0.5;
  problem.Features.FeatureAngle = 10.0;
  problem.Features.CurvatureWeight = 0.1;
  problem.Rotation.Everywhere = 0.2;
  CheckOnAllPartitions(surface, problem);
  problem.Features.CurvatureWeight = 0.0;
  problem.Options.Constraints = ConstraintKind::Hard;
  Comparison(surface, problem).Check(test::Partitions()[1]); // sharp edges hold all vertices
  problem.Features.SharpEdgesWeight = 0.0;
  CheckOnAllPartitions(surface, problem);
}

TEST(FieldSolverInPieces, FollowsSourcesAsOnOneProcess)
{
  // The second component has no value: its function has the mean zero.
  const test::Surface surface =
    test::Union(test::IrregularSphere(3, 3), test::IrregularTorus(40, 20, 4), Vector3(4.0, 0.0, 0.0));
  FieldProblem problem = SomeValues(surface.Mesh());
  problem.Constraints.Values.resize(2);
  problem.Constraints.Source = surface.V.col(0).array().sin() * surface.V.col(1).array();
  problem.Constraints.Net = NetSource::TakeOut;
  problem.Options.Smoothness = 2.0;
  for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    problem.Options.Constraints = kind;
    CheckOnAllPartitions(surface, problem);
  }
  problem.Constraints.Values.clear();
  CheckOnAllPartitions(surface, problem);
}

TEST(FieldSolverInPieces, FindsTheSmoothestFieldWhereNothingIsPrescribed)
{
  const test::Surface surface = test::IrregularTorus(40, 20, 4);
  const Ranks ranks(MPI_COMM_WORLD);
  const test::CutPiece cut =
    test::CutOut(surface, test::Partitions()[1].RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  const Field& field = solver.Solve({});
  EXPECT_TRUE(field.Report.Converged);
  ASSERT_EQ(field.Report.Eigenvalues.size(), 1u);
  FieldSolver whole(surface.Mesh());
  const double expected = whole.Solve({}).Report.Eigenvalues[0];
  EXPECT_NEAR(field.Report.Eigenvalues[0], expected, 1e-3 * expected);
}

TEST(FieldSolverInPieces, StagesAreKept)
{
  const test::Surface surface = test::IrregularSphere(4, 3);
  const Ranks ranks(MPI_COMM_WORLD);
  const test::CutPiece cut =
    test::CutOut(surface, test::Partitions()[1].RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  FieldProblem problem;
  problem.Guides.Vectors = { { Vector3(1.0, 0.2, 0.1), Vector3(0.0, 1.0, 0.3) } };
  solver.Solve(problem);
  solver.Solve(problem);
  EXPECT_EQ(solver.Counts().Solves, 1);
  problem.Guides.Vectors[0].Direction[2] = -0.7; // other values of the same system
  solver.Solve(problem);
  EXPECT_EQ(solver.Counts().Systems, 1);
  EXPECT_EQ(solver.Counts().Solves, 2);
  problem.Guides.Vectors[0].Position[1] = -0.7;
  solver.Solve(problem);
  EXPECT_EQ(solver.Counts().Setups, 1);
  EXPECT_EQ(solver.Counts().Systems, 2);
  EXPECT_EQ(solver.Counts().Solves, 3);
  problem.Combing = false;
  EXPECT_FALSE(solver.Solve(problem).IsCombed);
  EXPECT_EQ(solver.Counts().Solves, 3);
  problem.Options.Field.N = 2;
  EXPECT_EQ(solver.Solve(problem).N, 2);
  EXPECT_EQ(solver.Counts().Setups, 2);
}

TEST(FieldSolverInPieces, ReasonsToGatherAreReported)
{
  EXPECT_EQ(ReasonToGather({}), "");
  const auto reasonOf = [](const auto& change)
  {
    FieldProblem problem;
    change(problem);
    return ReasonToGather(problem);
  };
  EXPECT_NE(reasonOf([](FieldProblem& p) { p.Options.Field.Kind = DiscretisationKind::OneForm; }), "");
  EXPECT_NE(reasonOf([](FieldProblem& p) { p.Options.Field.Kind = DiscretisationKind::PowerField; }), "");
  EXPECT_NE(reasonOf([](FieldProblem& p) { p.Singularities.emplace(); }), "");
  EXPECT_NE(reasonOf([](FieldProblem& p) { p.Options.Solver.Kind = SolverKind::Cholesky; }), "");
  EXPECT_EQ(reasonOf([](FieldProblem& p) { p.Options.Field.Kind = DiscretisationKind::ScalarFunction; }), "");
  EXPECT_EQ(reasonOf([](FieldProblem& p) { p.Features.CurvatureWeight = 1.0; }), "");
}

TEST(FieldSolverInPieces, WrongProblemsAreRefusedOnAllRanks)
{
  const test::Surface surface = test::IrregularSphere(3, 3);
  const Ranks ranks(MPI_COMM_WORLD);
  const test::CutPiece cut =
    test::CutOut(surface, test::Partitions()[0].RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  const bool isLast = ranks.Rank() == ranks.Size() - 1;
  const auto messageOf = [&](const FieldProblem& problem)
  {
    std::string message;
    try
    {
      solver.Solve(problem);
    }
    catch (const InvalidInput& error)
    {
      message = error.what();
    }
    EXPECT_NO_THROW(ranks.CheckSame(message, "the message"));
    return message;
  };
  FieldProblem problem;
  problem.Constraints.OnFaces = { { 0, Vector3(1.0, 0.3, 0.2), 1.0 } };
  problem.Rotation.Faces = Vector<double>::Zero(cut.Piece.Corners.rows());
  problem.Rotation.Faces[0] = isLast ? std::nan("") : 0.0;
  EXPECT_NE(messageOf(problem).find("rotation at"), std::string::npos);

  problem = {};
  problem.Guides.Vectors = { { Vector3(1.0, 0.0, 0.0), Vector3(0.0, std::nan(""), 0.0) } };
  EXPECT_NE(messageOf(problem).find("guide vector 0"), std::string::npos);
  problem.Guides.Vectors = { { Vector3(50.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0) } };
  EXPECT_NE(messageOf(problem).find("no direction is prescribed"), std::string::npos);

  problem = {};
  problem.Options.Field.Kind = DiscretisationKind::FaceField;
  EXPECT_NE(messageOf(problem).find("gather the surface"), std::string::npos);

  problem = {};
  problem.Options.Field.Kind = DiscretisationKind::ScalarFunction;
  EXPECT_NE(messageOf(problem).find("value"), std::string::npos);
  problem.Constraints.Source = Vector<double>::Ones(cut.Piece.Positions.rows());
  EXPECT_NE(messageOf(problem).find("the source sums to"), std::string::npos);
  problem.Constraints.Source[0] = isLast ? std::nan("") : 1.0;
  EXPECT_NE(messageOf(problem).find("the source is"), std::string::npos);

  if (ranks.Size() > 1)
  {
    problem = {};
    problem.Features.BoundaryWeight = isLast ? 1.0 : 2.0;
    EXPECT_NE(messageOf(problem).find("the features"), std::string::npos);
    problem = {};
    problem.Guides.Vectors = { { Vector3(1.0, isLast ? 0.1 : 0.2, 0.0), Vector3(0.0, 1.0, 0.0) } };
    EXPECT_NE(messageOf(problem).find("the guides"), std::string::npos);
  }
  // The solver is as it was.
  EXPECT_TRUE(solver.Solve({}).Report.Converged);
}

// A plane has no holes and the field no singularities: combed, direction 0 continues over all edges.
TEST(FieldSolverInPieces, CombedDirectionsContinueOverSeams)
{
  const test::Surface surface = test::IrregularPlane(40, 30, 5);
  const Ranks ranks(MPI_COMM_WORLD);
  FieldProblem whole;
  for (const int face : { 100, 700, 1500, 2300 })
  {
    whole.Constraints.OnFaces.push_back({ face, Vector3(1.0, 1e-4 * face, 0.0), 1.0 });
  }
  for (const test::NamedPartition& partition : test::Partitions())
  {
    SCOPED_TRACE(partition.Name);
    const test::CutPiece cut = test::CutOut(surface, partition.RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
    FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
    FieldProblem problem = test::OfPiece(whole, cut, surface);
    for (const double turn : { 0.0, 0.4 }) // the second one stays near to the first
    {
      problem.Rotation.Everywhere = turn;
      const Field& field = solver.Solve(problem);
      const PieceOfSurface& piece = solver.Piece();
      const std::vector<Complex> ofOwners = piece.OwnersOfGhostFaces().Fetch<Complex>(
        [&](int triangle) { return field.OnFaces[piece.FirstOwnFace() + triangle]; });
      for (std::size_t k = 0; k < ofOwners.size(); ++k)
      {
        EXPECT_LE(std::abs(field.OnFaces[piece.GhostFaces()[k]] / ofOwners[k] - 1.0), 1e-6);
      }
      const std::vector<Complex> atVertices =
        piece.WithGhosts<Complex>(field.AtVertices.segment(piece.FirstOwned(), piece.NumberOfOwned()));
      for (std::size_t vertex = 0; vertex < atVertices.size(); ++vertex)
      {
        EXPECT_EQ(field.AtVertices[vertex], atVertices[vertex]);
      }
      for (int i = 0; i < piece.NumberOfOwnFaces(); ++i)
      {
        const Vector3 direction =
          piece.Surface().Faces.ToVector(piece.FirstOwnFace() + i, field.OnFaces[piece.FirstOwnFace() + i]);
        const Vector3 first = piece.Surface().Faces.ToVector(piece.FirstOwnFace(), field.OnFaces[piece.FirstOwnFace()]);
        EXPECT_GT(direction.normalized().dot(first.normalized()), 0.5);
      }
    }
  }
}
