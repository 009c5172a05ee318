#include "Pieces/PetscSession.h"

#include "Support/Errors.h"

#include <string>

namespace dmg
{

void CheckPetsc(PetscErrorCode code)
{
  if (code == PETSC_ERR_MEM)
  {
    throw SolverFailure("PETSc has run out of memory; take more ranks, on more machines");
  }
  if (code)
  {
    const char* text = nullptr;
    static_cast<void>(PetscErrorMessage(code, &text, nullptr));
    throw UnexpectedFailure(
      "PETSc failed with code " + std::to_string(static_cast<int>(code)) + (text ? ", " + std::string(text) : ""));
  }
}

PetscSession::PetscSession(MPI_Comm communicator)
{
  PetscBool isInitialised = PETSC_FALSE;
  CheckPetsc(PetscInitialized(&isInitialised));
  this->IsOurs = !isInitialised;
  if (this->IsOurs)
  {
    PETSC_COMM_WORLD = communicator;
    char name[] = "DirectionalMultigrid";
    char skip[] = "-skip_petscrc";
    char quiet[] = "-no_signal_handler";
    char* texts[] = { name, skip, quiet, nullptr };
    char** arguments = texts;
    int count = 3;
    CheckPetsc(PetscInitialize(&count, &arguments, nullptr, nullptr));
  }
  CheckPetsc(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

PetscSession::~PetscSession()
{
  static_cast<void>(PetscPopErrorHandler());
  if (this->IsOurs)
  {
    static_cast<void>(PetscFinalize());
  }
}

}
