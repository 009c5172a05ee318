#ifndef dmgFieldSolverInPieces_h
#define dmgFieldSolverInPieces_h

#include "Field.h"
#include "FieldProblem.h"
#include "Pieces/ReasonToGather.h"
#include "Pieces/Surface/PieceOfSurface.h"
#include "Setup/StageCounts.h"
#include "Support/ExecutionContext.h"

#include <mpi.h>

#include <memory>

namespace dmg
{

/// FieldSolver for a surface of which each rank has a piece: the same fields up to the tolerance, from the same problems. No rank ever has
/// more than its piece and the triangles around it.
///
///   stage       is redone when this changes, on any rank
///   set-up      discretisation, with N and areas
///   system      which vertices are prescribed, and their penalties
///   solve       prescribed values, source, tolerance, iteration limit
///   directions  the solution, Combing
///
///   dmg::FieldSolverInPieces solver(MPI_COMM_WORLD, piece);
///   dmg::FieldProblem problem;
///   problem.Constraints.OnFaces = { { triangle, direction, weight } }; // of this rank's piece
///   if (dmg::ReasonToGather(problem).empty())
///   {
///     const dmg::Field& field = solver.Solve(problem);
///     const int face = solver.Piece().FirstOwnFace() + triangle;
///     const dmg::Complex direction = field.OnFaces[face];
///   }
///
/// All functions are collective, those that are const excepted. Ranks without triangles or constraints call them, too. An error on one rank,
/// or a request to stop, is thrown on all of them.
class FieldSolverInPieces
{
public:
  /// \param communicator of the ranks that have the surface.
  /// \param names says how messages call the triangles and points of this rank's piece.
  /// \throw InvalidInput as PieceOfSurface, or no rank has a triangle.
  FieldSolverInPieces(MPI_Comm communicator, const SurfacePiece& piece, const ElementNames& names = {},
    const ExecutionContext& context = SerialContext());
  ~FieldSolverInPieces();

  const PieceOfSurface& Piece() const;

  /// Brings all stages up to date, as FieldSolver::Solve does.
  /// \param problem Constraints, Source and RotationAngles count own triangles from 0, and the points of the piece. At a point that
  ///   several ranks have, each may give the same; what the lowest of these ranks gives counts. Guides are the same on all ranks,
  ///   and so is all else.
  /// \return the field on Piece().Surface(). It is that of the whole surface on own triangles and at their vertices. It means nothing
  ///   elsewhere, but for Indices, which are zero there. Report, Guides, and Warnings are the same on all ranks, but for seconds.
  /// \throw InvalidInput as FieldSolver::Solve, ranks differ in the problem, or there is a ReasonToGather.
  /// \throw SolverFailure
  /// \throw Cancelled
  const Field& Solve(const FieldProblem& problem, const ExecutionContext& context = SerialContext());

  /// Whether this rank reports the singularity of an element of Field::Indices: an own triangle, or an owned vertex. Every element of the
  /// surface has one reporting rank.
  bool ReportsIndexOf(int element) const;

  /// See FieldSolver::Counts.
  StageCounts Counts() const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
