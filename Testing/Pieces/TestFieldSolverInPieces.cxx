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

  void CheckIndices(const FieldSolverInPieces& solver, const Field& field, const test::CutPiece& cut) const
  {
    double sum = 0.0;
    for (Eigen::Index element = 0; element < field.Indices.size(); ++element)
    {
      sum += solver.TellsIndexOf(static_cast<int>(element)) ? field.Indices[element] : 0.0;
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

TEST(TestFieldSolverInPieces, ArraysAsOnOneProcess)
{
  for (const test::Surface& surface : { test::IrregularSphere(4, 3), test::DoubleTorus(8), test::Annulus(30, 6) })
  {
    CheckOnAllPartitions(surface, SomeDirections(surface.Mesh()));
    CheckOnAllPartitions(surface, SomeValues(surface.Mesh()));
  }
}
