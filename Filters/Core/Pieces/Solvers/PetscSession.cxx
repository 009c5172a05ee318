#include "Pieces/Solvers/PetscSession.h"

#include "Pieces/Surface/Ranks.h"
#include "Support/Errors.h"

#include <petscvec.h>

#include <string>

namespace dmg
{

bool IsPetscInitialised()
{
  PetscBool isInitialised = PETSC_FALSE;
  return !PetscInitialized(&isInitialised) && isInitialised;
}

namespace
{

/// The sessions that use a PETSc of ours. PETSc itself is there once in a process.
int sessionsOfOurs = 0;

/// The times that PETSc was ended, and the number of them when it was told to count the next one.
int endsOfPetsc = 0;
int endsWhenTold = -1;

PetscErrorCode CountEnd()
{
  ++endsOfPetsc;
  return static_cast<PetscErrorCode>(0);
}

void CountNextEnd()
{
  if (endsWhenTold != endsOfPetsc)
  {
    CheckPetsc(PetscRegisterFinalize(CountEnd));
    endsWhenTold = endsOfPetsc;
  }
}

std::string TextOf(PetscErrorCode code)
{
  if (code == PETSC_ERR_MEM)
  {
    return "PETSc has run out of memory; take more ranks, on more machines";
  }
  const char* text = nullptr;
  static_cast<void>(PetscErrorMessage(code, &text, nullptr));
  return "PETSc failed with code " + std::to_string(static_cast<int>(code)) + (text ? ", " + std::string(text) : "");
}

void Initialise()
{
  PETSC_COMM_WORLD = MPI_COMM_SELF;
  char name[] = "DirectionalMultigrid";
  char skip[] = "-skip_petscrc";
  char quiet[] = "-no_signal_handler";
  char* texts[] = { name, skip, quiet, nullptr };
  char** arguments = texts;
  int count = 3;
  CheckPetsc(PetscInitialize(&count, &arguments, nullptr, nullptr));
}

void End(bool isLast)
{
  if (isLast && IsPetscInitialised())
  {
    static_cast<void>(PetscFinalize());
    PETSC_COMM_WORLD = MPI_COMM_NULL; // the next one to initialise PETSc finds it as at the beginning
  }
}

/// Both kinds of PETSc have functions of the same names, so a program that links to the other kind may call that one here. Its
/// numbers have no imaginary part.
bool HasComplexNumbers()
{
  Vec one;
  PetscReal norm = 0.0;
  CheckPetsc(VecCreateSeq(PETSC_COMM_SELF, 1, &one));
  CheckPetsc(VecSet(one, PetscScalar(0.0, 1.0)));
  CheckPetsc(VecNorm(one, NORM_INFINITY, &norm));
  CheckPetsc(VecDestroy(&one));
  return norm == 1.0;
}

}

void CheckPetsc(PetscErrorCode code)
{
  if (!code)
  {
    return;
  }
  EndWithOthers(MPI_COMM_WORLD, TextOf(code));
  if (code == PETSC_ERR_MEM)
  {
    throw SolverFailure(TextOf(code));
  }
  throw UnexpectedFailure(TextOf(code));
}

void CheckDestroyed(PetscErrorCode code)
{
  if (code)
  {
    EndWithOthers(MPI_COMM_WORLD, TextOf(code));
  }
}

PetscSession::PetscSession()
  : IsOurs(sessionsOfOurs > 0 || !IsPetscInitialised())
  , EndsBefore(Ends())
{
  if (!IsPetscInitialised())
  {
    Initialise();
  }
  if (!HasComplexNumbers())
  {
    End(this->IsOurs && sessionsOfOurs == 0);
    throw SolverFailure(
      "a PETSc for real numbers has taken the place of the one for complex numbers here; link the program "
      "to one of them, or load the other without RTLD_GLOBAL");
  }
  CountNextEnd();
  CheckPetsc(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
  sessionsOfOurs += this->IsOurs;
}

PetscSession::~PetscSession()
{
  static_cast<void>(PetscPopErrorHandler());
  sessionsOfOurs -= this->IsOurs;
  End(this->IsOurs && sessionsOfOurs == 0);
}

int PetscSession::Ends()
{
  return endsOfPetsc;
}

void PetscSession::Check() const
{
  if (!IsPetscInitialised() || this->EndsBefore != Ends())
  {
    throw SolverFailure(
      "PETSc was ended while a solver for surfaces in pieces was there; end it after the solver, and make "
      "another solver now");
  }
}

}
