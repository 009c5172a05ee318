// A field on a surface in pieces, where memory runs out on the last rank:
//
//   WithoutMemory K    the K-th request of the code of this project or of PETSc fails, there; 0: none
//
// Prints how many requests there were, or what all ranks throw.

#include "Pieces/FieldSolverInPieces.h"
#include "Pieces/Solvers/PetscSession.h"
#include "Pieces/Surface/Ranks.h"

#include "../Partitions.h"
#include "Support/Errors.h"
#include "Support/FailingRequests.h"

#include <array>
#include <cstdio>
#include <cstdlib>

namespace
{

bool isCounting = false;
long long requests = 0;
long long failing = 0;

/// Requests of MPI and of the standard library are spared, which do not survive that.
std::array<dmg::test::CodeRange, 2> code;

}

bool dmg::test::Fails(const void* caller)
{
  return isCounting && (code[0].Contains(caller) || code[1].Contains(caller)) && ++requests == failing;
}

namespace
{

using namespace dmg;

void Solve(const SurfacePiece& piece)
{
  FieldSolverInPieces solver(MPI_COMM_WORLD, piece);
  FieldProblem problem;
  problem.Constraints = test::OneDirection(solver.Piece());
  if (!solver.Solve(problem).Report.Converged)
  {
    throw SolverFailure("the field has not converged");
  }
}

}

int main(int count, char** arguments)
{
  MPI_Init(&count, &arguments);
  code = { test::CodeOf(""), test::CodeOf("petsc") };
  failing = count > 1 ? std::atoll(arguments[1]) : 0;
  {
    const Ranks all(MPI_COMM_WORLD);
    const PetscSession started; // PETSc itself does not survive a failure before its handlers of errors are there
    const bool isLast = all.Rank() == all.Size() - 1;
    const test::CutPiece cut = test::PieceHere(test::IrregularSphere(4, 3));
    bool hasThrown = false;
    isCounting = isLast;
    try
    {
      Solve(cut.Piece);
    }
    catch (const MemoryRanOut&)
    {
      hasThrown = true;
    }
    isCounting = false;
    if (all.Sum(hasThrown ? 1LL : 0LL) == all.Size())
    {
      std::printf("all ranks throw\n");
    }
    else if (isLast)
    {
      std::printf("%lld requests\n", requests);
    }
    Solve(cut.Piece); // as if nothing had been
  }
  MPI_Finalize();
  return 0;
}
