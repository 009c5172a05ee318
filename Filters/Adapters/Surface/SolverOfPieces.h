#ifndef dmgSolverOfPieces_h
#define dmgSolverOfPieces_h

#include "Adapters/Ranks/RanksOfPipeline.h"
#include "Adapters/Surface/MeshFromDataSet.h"
#include "Pieces/FieldSolverInPieces.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <optional>
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
  /// \throw InvalidInput as MeshFromDataSet
  /// \throw Cancelled
  std::string SetSurface(const RanksOfPipeline& ranks, vtkDataSet* input, const PreparationOptions& preparation,
    const ExecutionContext& context);

  /// \pre SetSurface has returned no reason; so all others.
  FieldSolverInPieces& Solver() { return *this->SolverOfMeshes; }
  /// The triangles of this rank alone, as constraints are numbered; null where it has none.
  const FramedSurface* Own() const { return this->OwnSurface ? &*this->OwnSurface : nullptr; }

  /// The triangles of this rank, with those around them of others, which are no part of any cell.
  FramedSurface Surface() const { return { this->SolverOfMeshes->Piece().Surface(), this->Relation }; }
  /// The changes that made the piece a mesh.
  const PreparationReport& Preparation() const { return this->PreparationOfPiece; }
  /// The sum over the surface and the set-up of a field on it.
  double SetupSeconds(const Field& field) const;

  /// Over all surfaces.
  StageCounts Counts() const;
  /// The number of surfaces that there were, with this one.
  int NumberOfSurfaces() const { return this->Surfaces; }

private:
  void Relate(int numberOfCells, int numberOfPoints);

  std::string Digest;
  std::string Reason;
  std::unique_ptr<const FramedMesh> OwnGeometry;
  SurfaceRelation OwnRelation;
  std::optional<const FramedSurface> OwnSurface; ///< refers to these
  SurfaceRelation Relation;
  PreparationReport PreparationOfPiece;
  std::unique_ptr<FieldSolverInPieces> SolverOfMeshes;
  double SurfaceSeconds = 0.0;
  StageCounts FormerCounts;
  int Surfaces = 0;
};

}

#endif
