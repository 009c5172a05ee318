#ifndef dmgPetscSession_h
#define dmgPetscSession_h

#include <petscsys.h>

namespace dmg
{

/// Does nothing where \p code says that a function of PETSc has succeeded. One that fails on a rank, as for want of memory, leaves
/// the others waiting inside of PETSc: see EndWithOthers.
/// \throw SolverFailure there is one rank only.
void CheckPetsc(PetscErrorCode code);

/// The same for destructors, which throw nothing. Where there is one rank only, what is left is lost.
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

  /// The number of times that PETSc was ended in this process, by whomever. Objects from before are no longer there.
  static int Ends();

private:
  bool IsOurs;
  int EndsBefore;
};

}

#endif
