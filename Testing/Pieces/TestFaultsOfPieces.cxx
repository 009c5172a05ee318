#include "Pieces/FieldSolverInPieces.h"

#include "Partitions.h"
#include "Support/Errors.h"
#include "Support/ExecutionContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;

namespace
{

/// Whatever is wrong on the last rank is told on all of them, in the same words. A rank that went on alone would wait until the
/// test's time is over.
template <class Error>
void ExpectOnAllRanks(const std::function<void(bool isLast)>& run, const std::string& words)
{
  const Ranks all(MPI_COMM_WORLD);
  std::string message;
  try
  {
    run(all.Rank() == all.Size() - 1);
  }
  catch (const Error& error)
  {
    message = error.what();
  }
  EXPECT_NE(message.find(words), std::string::npos) << "rank " << all.Rank() << " says \"" << message << "\"";
  EXPECT_NO_THROW(all.CheckSame(message, "the message"));
}

/// Asks to stop after some checkpoints.
class StoppingContext : public SerialContext
{
public:
  explicit StoppingContext(int checkpoints)
    : Left(checkpoints)
  {
  }
  bool IsCancelled() const override { return this->Left <= 0; }

protected:
  void ReportProgress(double) const override { --this->Left; }

private:
  mutable int Left;
};

FieldProblem Following(const Constraints& constraints, DiscretisationKind kind = DiscretisationKind::VertexPowerField)
{
  FieldProblem problem;
  problem.Constraints = constraints;
  problem.Options.Field.Kind = kind;
  return problem;
}

}

TEST(FaultsOfPieces, AWrongDirectionOnOneRankIsRefusedOnAll)
{
  const test::CutPiece cut = test::PieceHere(test::Icosphere(3));
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  ExpectOnAllRanks<InvalidInput>(
    [&](bool isLast)
    {
      Constraints constraints = test::OneDirection(solver.Piece());
      if (isLast)
      {
        constraints.OnFaces[0].Direction[1] = std::nan("");
      }
      solver.Solve(Following(constraints));
    },
    "cell 0");
  // The solver is as it was.
  EXPECT_TRUE(solver.Solve(Following(test::OneDirection(solver.Piece()))).Report.Converged);
}

TEST(FaultsOfPieces, WrongConstraintsOnOneRankAreRefusedOnAll)
{
  test::CutPiece cut = test::PieceHere(test::Icosphere(3));
  cut.Piece.Positions.conservativeResize(cut.Piece.Positions.rows() + 1, 3);
  cut.Piece.Positions.bottomRows(1).setConstant(5.0); // without a triangle
  const int lastPoint = static_cast<int>(cut.Piece.Positions.rows()) - 1;
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  const Vector3 x(1.0, 0.0, 0.0);
  const std::vector<std::pair<Constraints, std::string>> wrong = {
    { { { { 1000000, x, 1.0 } }, {}, {} }, "1000000" },
    { { { { -1, x, 1.0 } }, {}, {} }, "-1" },
    { { { { 0, x, 0.0 } }, {}, {} }, "weight" },
    { { { { 0, x, -2.0 } }, {}, {} }, "weight" },
    { { { { 0, x, std::nan("") } }, {}, {} }, "weight" },
    { { { { 0, x, 1e30 } }, {}, {} }, "weight" },
    { { {}, { { 0, x, -1.0 } }, {} }, "weight" },
    { { {}, { { 1000000, x, 1.0 } }, {} }, "1000000" },
    { { {}, { { lastPoint, x, 1.0 } }, {} }, "has no triangle" },
  };
  for (const auto& [constraints, words] : wrong)
  {
    ExpectOnAllRanks<InvalidInput>([&, &constraints = constraints](bool isLast)
      { solver.Solve(Following(isLast ? constraints : test::OneDirection(solver.Piece()))); },
      words);
  }
  for (const ValueConstraint& value : { ValueConstraint{ 0, std::nan(""), 1.0 }, ValueConstraint{ 0, 1.0, -1.0 },
         ValueConstraint{ lastPoint, 1.0, 1.0 } })
  {
    ExpectOnAllRanks<InvalidInput>(
      [&](bool isLast)
      {
        Constraints constraints;
        constraints.Values.push_back(isLast ? value : ValueConstraint{ 0, 1.0, 1.0 });
        solver.Solve(Following(constraints, DiscretisationKind::ScalarFunction));
      },
      value.Vertex == lastPoint ? "has no triangle" : "not finite or its weight not positive");
  }
}

TEST(FaultsOfPieces, WrongWeightsAreRefused)
{
  const test::CutPiece cut = test::PieceHere(test::Icosphere(3));
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  for (const double alignment : { 0.0, -1.0, std::nan("") })
  {
    FieldProblem problem = Following(test::OneDirection(solver.Piece()));
    problem.Options.Alignment = alignment;
    ExpectOnAllRanks<InvalidInput>([&](bool) { solver.Solve(problem); }, "lignment");
  }
  EXPECT_TRUE(solver.Solve(Following(test::OneDirection(solver.Piece()))).Report.Converged);
}

TEST(FaultsOfPieces, AWrongSurfaceOnOneRankIsRefusedOnAll)
{
  ExpectOnAllRanks<InvalidInput>(
    [](bool isLast)
    {
      test::CutPiece cut = test::PieceHere(test::Icosphere(3));
      if (isLast)
      {
        cut.Piece.Corners(2, 1) = 1000000;
      }
      FieldSolverInPieces(MPI_COMM_WORLD, cut.Piece);
    },
    "triangle 2");
  ExpectOnAllRanks<InvalidInput>(
    [](bool isLast)
    {
      test::CutPiece cut = test::PieceHere(test::Icosphere(3));
      if (isLast)
      {
        cut.Piece.Positions(cut.Piece.Corners(5, 0), 1) = std::nan("");
      }
      FieldSolverInPieces(MPI_COMM_WORLD, cut.Piece);
    },
    "point");
}

TEST(FaultsOfPieces, ReversedAndDoubledPiecesAreRefused)
{
  const Ranks all(MPI_COMM_WORLD);
  if (all.Size() == 1)
  {
    GTEST_SKIP() << "one rank has no seams";
  }
  ExpectOnAllRanks<InvalidInput>(
    [](bool isLast)
    {
      test::CutPiece cut = test::PieceHere(test::Icosphere(3));
      if (isLast)
      {
        cut.Piece.Corners.col(1).swap(cut.Piece.Corners.col(2));
      }
      FieldSolverInPieces(MPI_COMM_WORLD, cut.Piece);
    },
    "in the same direction");
  ExpectOnAllRanks<InvalidInput>(
    [](bool)
    {
      test::Surface open = test::Disk(5);
      FieldSolverInPieces(MPI_COMM_WORLD, { open.V, open.F, {} });
    },
    "ranks 0");
}

TEST(FaultsOfPieces, ProblemsThatDifferBetweenRanksAreRefused)
{
  const Ranks all(MPI_COMM_WORLD);
  if (all.Size() == 1)
  {
    GTEST_SKIP() << "one rank does not differ";
  }
  const test::CutPiece cut = test::PieceHere(test::Icosphere(3));
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  FieldProblem problem = Following(test::OneDirection(solver.Piece()));
  ExpectOnAllRanks<InvalidInput>(
    [&](bool isLast)
    {
      problem.Options.Field.N = isLast ? 2 : 4;
      solver.Solve(problem);
    },
    "N = 2");
  problem.Options.Field.N = 4;
  ExpectOnAllRanks<InvalidInput>(
    [&](bool isLast)
    {
      problem.Options.Alignment = isLast ? 2.0 : 3.0;
      solver.Solve(problem);
    },
    "alignment 2");
  problem.Options.Alignment = 2.0;
  ExpectOnAllRanks<InvalidInput>(
    [&](bool isLast)
    {
      problem.Options.Solver.ExpectedSolves = isLast ? 7 : 8; // of which no text tells
      solver.Solve(problem);
    },
    "an option of the field");
  problem.Options.Solver.ExpectedSolves = 7;
  ExpectOnAllRanks<InvalidInput>(
    [&](bool isLast)
    {
      problem.Stop.RelativeTolerance = isLast ? 1e-4 : std::nextafter(1e-4, 1.0); // of which a text has not all digits
      solver.Solve(problem);
    },
    "differ in");
  ExpectOnAllRanks<InvalidInput>(
    [&](bool isLast)
    {
      SurfacePiece piece = cut.Piece;
      if (isLast)
      {
        piece.GlobalIds.assign(piece.Positions.rows(), 0);
      }
      FieldSolverInPieces(MPI_COMM_WORLD, piece);
    },
    "global ids");
}

TEST(FaultsOfPieces, NothingToSolveIsRefused)
{
  ExpectOnAllRanks<InvalidInput>(
    [](bool) { FieldSolverInPieces(MPI_COMM_WORLD, SurfacePiece()); }, "no rank has a triangle");
  const test::CutPiece cut = test::PieceHere(test::Icosphere(2));
  FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
  ExpectOnAllRanks<InvalidInput>(
    [&](bool) { solver.Solve(Following({}, DiscretisationKind::ScalarFunction)); }, "no rank prescribes a value");
  ExpectOnAllRanks<InvalidInput>(
    [&](bool) { solver.Solve(Following({}, DiscretisationKind::FaceField)); }, "gather the surface");
}

TEST(FaultsOfPieces, WantOfMemoryOnOneRankIsToldToAll)
{
  const Ranks all(MPI_COMM_WORLD);
  ExpectOnAllRanks<MemoryRanOut>(
    [&](bool isLast)
    {
      all.Together(
        [&]
        {
          if (isLast)
          {
            throw std::bad_alloc();
          }
        });
    },
    "more ranks");
}

TEST(FaultsOfPieces, OneRankStopsAll)
{
  const Ranks all(MPI_COMM_WORLD);
  const test::CutPiece cut = test::PieceHere(test::IrregularSphere(4, 3));
  int stopped = 0;
  for (int checkpoints = 0; checkpoints < 30; checkpoints += 2)
  {
    const bool isLast = all.Rank() == all.Size() - 1;
    const StoppingContext context(isLast ? checkpoints : 1000000);
    bool isStopped = false;
    try
    {
      FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece, {}, context);
      solver.Solve(Following(test::OneDirection(solver.Piece())), context);
      solver.Solve({}, context); // the smoothest field
    }
    catch (const Cancelled&)
    {
      isStopped = true;
    }
    EXPECT_EQ(all.Sum(isStopped ? 1LL : 0LL), isStopped ? all.Size() : 0);
    stopped += isStopped;
  }
  EXPECT_GE(stopped, 2);
}
