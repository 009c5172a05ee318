#ifndef dmgPetscSession_h
#define dmgPetscSession_h

#include <petscsys.h>

namespace dmg
{

/// Checks an error code of PETSc. On several ranks a failure ends all of them (EndWithOthers), as the others wait in a collective call.
/// \throw SolverFailure there is one rank only.
void CheckPetsc(PetscErrorCode code);

/// CheckPetsc for destructors: on one rank the error is ignored, and the object leaks.
void CheckDestroyed(PetscErrorCode code);

/// False before PETSc begins and after it has ended; objects cannot be destroyed any more then.
bool IsPetscInitialised();

/// PETSc, initialised. Where somebody else has initialised it, it is left to them; else it ends with the last session. Errors are
/// returned to the caller while there is a session, and options of files, of the command line and of the environment are not read.
///
/// Each rank initialises its PETSc alone: PETSC_COMM_WORLD is MPI_COMM_SELF then, and objects name their ranks. So surfaces may
/// belong to any parts of MPI_COMM_WORLD, at any time. A program that uses PETSC_COMM_WORLD initialises PETSc before.
///
/// \pre MPI is initialised. Who initialises PETSc ends it after the session.
class PetscSession
{
public:
  /// \throw SolverFailure PETSc has not started, or a PETSc for real numbers has taken the place of the one for complex numbers.
  PetscSession();
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

  /// \throw SolverFailure somebody else has ended PETSc.
  void Check() const;

  /// The number of times that PetscFinalize has run in this process. Older objects are invalid.
  static int Ends();

private:
  bool IsOurs;
  int EndsBefore;
};

}

#endif
