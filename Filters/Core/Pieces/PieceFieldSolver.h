#ifndef dmgPieceFieldSolver_h
#define dmgPieceFieldSolver_h

#include "Constraints/Constraints.h"
#include "Discretisations/DiscretisationOptions.h"
#include "Discretisations/FieldConstraints.h"
#include "Discretisations/VertexConstraints.h"
#include "Field.h"
#include "Pieces/PetscSession.h"
#include "Pieces/PieceComponents.h"
#include "Pieces/PieceLevels.h"
#include "Pieces/PieceOfSurface.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"
#include "Support/Stopwatch.h"

#include <memory>
#include <vector>

namespace dmg
{

class PetscMultigrid;

/// A field on a surface in pieces, as one rank sees it.
struct PieceField
{
  /// Per vertex of PieceOfSurface::Surface, ghosts included: the N-th power in VertexFrames, or the value of a function, a real
  /// number. Of vertices that only ghosts have, the frame is not that of the whole surface.
  Vector<Complex> AtVertices;
  SolveReport Report; ///< the same on all ranks, but for seconds
  double SetupSeconds = 0.0;
  /// Components that no constraint holds. Power fields are the smoothest ones of mean square magnitude 1 there, whose eigenvalues
  /// are in the report, and functions are zero.
  int UnheldComponents = 0;
};

/// Finds smooth fields on a surface of which each rank has a piece: power fields at points and functions, the same as FieldSolver up to
/// the tolerance. No rank ever has more than its piece and the triangles around it; PETSc solves.
///
///   dmg::PieceFieldSolver solver(MPI_COMM_WORLD, piece, {});
///   dmg::Constraints constraints;
///   constraints.OnFaces = { { triangle, direction, weight } }; // of this rank's piece
///   const dmg::PieceField field = solver.Solve(constraints);
///
/// All functions are collective: every rank calls them with the same options, those without triangles and without
/// constraints, too. An error on one rank is thrown on all of them.
class PieceFieldSolver
{
public:
  /// \param communicator of the ranks that have the surface.
  /// \param names how messages call the triangles and points of this rank's piece.
  /// \throw InvalidInput as PieceOfSurface; the discretisation is another one; ranks differ in it; no rank has a triangle.
  /// Cost: linear in the size of the largest piece.
  PieceFieldSolver(MPI_Comm communicator, const SurfacePiece& piece, const DiscretisationOptions& field,
    const ElementNames& names = {}, const ExecutionContext& context = SerialContext());
  /// \param piece is borrowed.
  PieceFieldSolver(const PieceOfSurface& piece, const DiscretisationOptions& field, const ElementNames& names = {},
    const ExecutionContext& context = SerialContext());

  ~PieceFieldSolver();

  PieceFieldSolver(const PieceFieldSolver&) = delete;
  PieceFieldSolver& operator=(const PieceFieldSolver&) = delete;

  const PieceOfSurface& Piece() const { return this->Part; }

  /// \param constraints on own triangles, counted from 0, and at points of the piece; of functions, Values and a Source. See
  ///   ConstraintsAtOwned.
  /// \throw InvalidInput a constraint or weight is wrong, what is prescribed holds nothing, or a function has no value and no source on
  ///   any rank.
  /// \throw SolverFailure
  /// \throw Cancelled on all ranks
  /// Cost: of the first solve and after penalties have changed, Galerkin products.
  PieceField Solve(const Constraints& constraints, const FieldWeights& weights = {}, const StoppingCriteria& stop = {},
    const ExecutionContext& context = SerialContext());

  /// The directions and singularities of a field on the mesh of Piece(), by this rank alone. On own triangles and at
  /// their vertices they are those of the whole surface; on ghosts they mean nothing. Empty where there are no triangles.
  /// \param combing whether direction 0 continues from triangle to triangle, as far as this mesh goes.
  dmg::Field Directions(
    const PieceField& field, bool combing = true, const ExecutionContext& context = SerialContext()) const;

  /// The number of times that stages have been completed. The system follows from penalties: which vertices are prescribed, with
  /// which weights. It is kept where only values change.
  struct StageCounts
  {
    int Systems = 0;
    int Solves = 0;
  };
  StageCounts Counts() const { return this->Completed; }

private:
  struct System;

  void SetUp(const ExecutionContext& context);
  bool IsFunction() const { return this->OptionsOfField.Kind == DiscretisationKind::ScalarFunction; }
  void CheckField() const;
  void SetMass(const ExecutionContext& context);
  RowsOfRank<Complex> Laplacian(const ExecutionContext& context) const;
  std::vector<RowsOfRank<Complex>> Prolongations(const ExecutionContext& context) const;
  System MakeSystem(const std::vector<PowerAtVertex>& constraints, const FieldWeights& weights) const;
  void HoldComponents(System& system, const std::vector<PowerAtVertex>& constraints, bool hasSource) const;
  void HoldOneVertex(std::vector<int>& ranks, System& system) const;
  void SetSystem(const System& system, const ExecutionContext& context);
  Vector<Complex> RightHandSide(const System& system) const;
  Vector<Complex> SolveSystem(const System& system, const Vector<Complex>& b, const StoppingCriteria& stop,
    SolveReport& report, const ExecutionContext& context);

  const Stopwatch Watch; ///< of the set-up
  const PetscSession Session;
  const Ranks All;
  const DiscretisationOptions OptionsOfField;
  const ElementNames Names;
  const std::unique_ptr<const PieceOfSurface> OwnPart; // null where it is borrowed
  const PieceOfSurface& Part;
  PieceComponents Components;
  Vector<double> Mass;                       // of owned vertices, over the mean of all
  double MeanMass = 1.0;                     // an area
  std::unique_ptr<PetscMultigrid> Multigrid; // of the Laplacian and, if there is a system, its penalties
  bool HasSystem = false;
  Vector<double> Penalties;       // of the system
  std::vector<char> HeldVertices; // of the system
  Vector<Complex> FormerSmoothest;
  StageCounts Completed;
  double SetupSeconds = 0.0;
};

}

#endif
