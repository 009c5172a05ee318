#ifndef dmgSetupInPieces_h
#define dmgSetupInPieces_h

#include "Discretisations/VertexDiscretisation.h"
#include "Pieces/Solvers/PetscMultigrid.h"
#include "Pieces/Surface/PieceComponents.h"
#include "Pieces/Surface/PieceOfSurface.h"
#include "Support/ExecutionContext.h"

#include <memory>

namespace dmg
{

/// The part of a solver in pieces that depends on the surface and the discretisation alone.
class SetupInPieces
{
public:
  /// Collective. \param piece is borrowed. \param options of a discretisation that has no ReasonForOneProcess.
  /// \throw InvalidInput the number of directions is out of range.
  /// Cost: linear in the size of the largest piece.
  SetupInPieces(const PieceOfSurface& piece, const DiscretisationOptions& options, const ExecutionContext& context);

  const PieceOfSurface& Piece;
  std::shared_ptr<const VertexDiscretisation> Fields; ///< on Piece.Surface()
  PieceComponents Components;
  double MeanArea = 1.0; ///< of a vertex
  Vector<double> Mass;   ///< the areas of owned vertices over MeanArea
  std::unique_ptr<PetscMultigrid> Multigrid;
  double Seconds = 0.0;

private:
  RowsOfRank<Complex> OwnedRows(const ExecutionContext& context) const;
  std::vector<RowsOfRank<Complex>> Prolongations(const ExecutionContext& context) const;
};

}

#endif
