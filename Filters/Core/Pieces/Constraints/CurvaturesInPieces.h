#ifndef dmgCurvaturesInPieces_h
#define dmgCurvaturesInPieces_h

#include "Directions/PrincipalDirections.h"
#include "Mesh/SurfaceSizes.h"
#include "Pieces/Surface/PieceOfSurface.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The principal curvatures of own triangles, as FindPrincipalDirections gives them for the whole surface.
///
/// Regions cross partition boundaries; each exchange adds one ring.
/// Collective. \param scale finite, >= 0. \param sizes of the whole surface.
/// \return on the faces of piece.Surface(), without confidence on ghosts.
/// Messages: as many exchanges as regions have rings, of about 250 bytes per vertex in a region across a partition boundary.
PrincipalCurvatures CurvaturesInPieces(
  const PieceOfSurface& piece, double scale, const SurfaceSizes& sizes, const ExecutionContext& context);

}

#endif
