#include "Pieces/Solvers/PetscSession.h"

#include "Partitions.h"
#include "Pieces/FieldSolverInPieces.h"
#include "Support/Errors.h"

#include <gtest/gtest.h>

#include <petscksp.h>

#include <memory>

using namespace dmg;

namespace
{

int SizeOf(MPI_Comm communicator)
{
  int size = 0;
  MPI_Comm_size(communicator, &size);
  return size;
}

/// A surface in pieces on the ranks of a communicator, solved for.
class Solved
{
public:
  explicit Solved(MPI_Comm communicator = MPI_COMM_WORLD, const test::Surface& surface = test::Icosphere(3))
    : Solver(communicator, test::PieceHere(surface, communicator).Piece)
  {
    this->Again();
  }
  /// For another limit, so that it is solved for anew.
  void Again()
  {
    this->Problem.Constraints = test::OneDirection(this->Solver.Piece());
    this->Problem.Stop.MaximumIterations += 1;
    EXPECT_TRUE(this->Solver.Solve(this->Problem).Report.Converged);
  }

private:
  FieldSolverInPieces Solver;
  FieldProblem Problem;
};

/// What somebody else has in PETSc, and whether it is as it was.
class SomebodysVector
{
public:
  SomebodysVector()
  {
    EXPECT_EQ(SizeOf(PETSC_COMM_WORLD), SizeOf(MPI_COMM_WORLD));
    EXPECT_EQ(VecCreateMPI(PETSC_COMM_WORLD, 3, PETSC_DETERMINE, &this->Vector), 0);
  }
  ~SomebodysVector()
  {
    PetscReal norm = 0.0;
    EXPECT_EQ(VecSet(this->Vector, 2.0), 0);
    EXPECT_EQ(VecNorm(this->Vector, NORM_1, &norm), 0);
    EXPECT_EQ(norm, 6.0 * SizeOf(MPI_COMM_WORLD));
    EXPECT_EQ(VecDestroy(&this->Vector), 0);
  }
  SomebodysVector(const SomebodysVector&) = delete;
  SomebodysVector& operator=(const SomebodysVector&) = delete;

private:
  Vec Vector = nullptr;
};

/// The ranks with the same color, as long as this lives.
class PartOfRanks
{
public:
  explicit PartOfRanks(int color) { MPI_Comm_split(MPI_COMM_WORLD, color, 0, &this->Part); }
  ~PartOfRanks() { MPI_Comm_free(&this->Part); }
  PartOfRanks(const PartOfRanks&) = delete;
  PartOfRanks& operator=(const PartOfRanks&) = delete;
  operator MPI_Comm() const { return this->Part; }

private:
  MPI_Comm Part;
};

}

TEST(PetscSession, OursEndsWithTheSolver)
{
  for (int k = 0; k < 3; ++k)
  {
    {
      const Solved solved;
      EXPECT_TRUE(IsPetscInitialised());
    }
    EXPECT_FALSE(IsPetscInitialised());
  }
}

/// As filters in a server, of which any may be deleted first.
TEST(PetscSession, OursEndsWithTheLastSolver)
{
  auto first = std::make_unique<Solved>();
  Solved second(MPI_COMM_WORLD, test::Icosphere(2));
  first.reset();
  EXPECT_TRUE(IsPetscInitialised());
  second.Again();
  const Solved third;
  second.Again();
}

TEST(PetscSession, SomebodyElseMayComeBeforeAndAfter)
{
  for (int k = 0; k < 3; ++k)
  {
    {
      const Solved beforeThem;
    }
    ASSERT_EQ(PetscInitializeNoArguments(), 0);
    {
      const SomebodysVector vector;
      {
        Solved first;
        Solved second;
        first.Again();
      }
      EXPECT_TRUE(IsPetscInitialised());
    }
    EXPECT_EQ(PetscFinalize(), 0);
    EXPECT_FALSE(IsPetscInitialised());
    const Solved afterThem;
  }
}

/// Their options and their handler of errors count for them, not for us.
TEST(PetscSession, OptionsOfSomebodyElseDoNotCount)
{
  ASSERT_EQ(PetscInitializeNoArguments(), 0);
  EXPECT_EQ(PetscOptionsSetValue(nullptr, "-ksp_type", "gmres"), 0);
  EXPECT_EQ(PetscOptionsSetValue(nullptr, "-ksp_max_it", "1"), 0);
  EXPECT_EQ(PetscOptionsSetValue(nullptr, "-pc_type", "none"), 0);
  {
    const Solved solved;
  }
  EXPECT_EQ(PetscFinalize(), 0);
}

TEST(PetscSession, EndingItUnderASolverIsAnError)
{
  ASSERT_EQ(PetscInitializeNoArguments(), 0);
  FieldSolverInPieces solver(MPI_COMM_WORLD, test::PieceHere(test::Icosphere(3)).Piece);
  FieldProblem problem;
  problem.Constraints = test::OneDirection(solver.Piece());
  solver.Solve(problem);
  EXPECT_EQ(PetscFinalize(), 0);
  EXPECT_THROW(solver.Solve(problem), SolverFailure);
  const Solved another;
}

/// The parts solve at the same time, each for a surface of its own.
TEST(PetscSession, PartsOfTheRanksSolveAtTheSameTime)
{
  const Ranks all(MPI_COMM_WORLD);
  const int half = 2 * all.Rank() < all.Size() ? 0 : 1;
  for (const int color : { half, all.Rank() % 2, all.Rank() })
  {
    const PartOfRanks part(color);
    Solved solved(part, color == 0 ? test::Icosphere(3) : test::IrregularTorus(40, 20, 4));
    solved.Again();
  }
}

/// The first solver is of some ranks, the next one of all, and they end in this order or in the other one.
TEST(PetscSession, SolversOfSomeRanksAndOfAllEndInAnyOrder)
{
  const Ranks all(MPI_COMM_WORLD);
  const PartOfRanks part(all.Rank() == 0 ? 1 : 0);
  for (const bool someEndFirst : { true, false })
  {
    std::unique_ptr<Solved> ofSome;
    if (all.Rank() > 0)
    {
      ofSome = std::make_unique<Solved>(part);
    }
    auto ofAll = std::make_unique<Solved>();
    if (someEndFirst)
    {
      ofSome.reset();
      ofAll->Again();
    }
    ofAll.reset();
    if (ofSome)
    {
      ofSome->Again();
    }
  }
}

TEST(PetscSession, PartsOfTheRanksMayUseThatOfSomebodyElse)
{
  const Ranks all(MPI_COMM_WORLD);
  const PartOfRanks part(all.Rank() % 2);
  ASSERT_EQ(PetscInitializeNoArguments(), 0);
  {
    const SomebodysVector vector;
    const Solved solved(part);
  }
  EXPECT_EQ(PetscFinalize(), 0);
}
