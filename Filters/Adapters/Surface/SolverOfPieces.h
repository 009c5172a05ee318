#ifndef dmgSolverOfPieces_h
#define dmgSolverOfPieces_h

#include "Adapters/Ranks/RanksOfPipeline.h"
#include "Adapters/Surface/MeshFromDataSet.h"
#include "Pieces/FieldSolverInPieces.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <string>

class vtkDataSet;

namespace dmg
{

/// A FieldSolverInPieces for the datasets of all ranks, each of which has a piece of a surface. A filter keeps it from one execution to
/// the next, as a SolverOfSurface. Keys are contents. Functions that are not const are collective.
class SolverOfPieces
{
public:
  /// Takes another surface, if the content of a piece is another on any rank.
  /// \param input of this rank; without cells where it has no piece.
  /// \return the reason why the pieces cannot be joined where they are; empty where they are.
  /// \throw FailedTogether as MeshFromDataSet
  /// \throw Cancelled
  std::string SetSurface(const RanksOfPipeline& ranks, vtkDataSet* input, const PreparationOptions& preparation,
    const ExecutionContext& context);

  /// \pre SetSurface has returned no reason; so all others.
  FieldSolverInPieces& Solver() { return *this->SolverOfMeshes; }
  /// Whether this rank has triangles. Else there is no Surface.
  bool HasSurface() const { return !this->SolverOfMeshes->Piece().IsEmpty(); }
  /// The triangles of this rank alone, as constraints are numbered.
  FramedSurface Own() const { return { *this->OwnGeometry, this->OwnRelation }; }
  /// The triangles of this rank, with those around them of others, which are no part of any cell: fields are on these.
  FramedSurface Surface() const { return { this->SolverOfMeshes->Piece().Surface(), this->Relation }; }
  const PreparationReport& Preparation() const { return this->PreparationOfPiece; }

  /// Over all surfaces.
  StageCounts Counts() const;
  /// The sum over the surface and the set-up of a field on it.
  double SetupSeconds(const Field& field) const;

private:
  void Relate(int numberOfCells, int numberOfPoints);

  std::string Digest;
  std::string Reason;
  std::unique_ptr<const FramedMesh> OwnGeometry;
  SurfaceRelation OwnRelation;
  SurfaceRelation Relation;
  PreparationReport PreparationOfPiece;
  std::unique_ptr<FieldSolverInPieces> SolverOfMeshes;
  double SurfaceSeconds = 0.0;
  StageCounts FormerCounts;
};

}

#endif
