#ifndef dmgPetscSession_h
#define dmgPetscSession_h

#include <petscsys.h>

namespace dmg
{

/// \throw SolverFailure a function of PETSc has failed. It says so on the rank where that was; others then wait for it, or fail, too.
void CheckPetsc(PetscErrorCode code);

/// PETSc, initialised. Where somebody else has initialised it, it is left to them; else it ends with the session. Errors are
/// returned to the caller while there is a session, and options of files, of the command line and of the environment are not read.
class PetscSession
{
public:
  /// Collective. \param communicator of all ranks that take part.
  /// \throw SolverFailure PETSc is one for real numbers, or ended for good.
  explicit PetscSession(MPI_Comm communicator);
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

private:
  bool IsOurs;
};

}

#endif
