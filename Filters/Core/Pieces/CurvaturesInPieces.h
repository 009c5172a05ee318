#ifndef dmgCurvaturesInPieces_h
#define dmgCurvaturesInPieces_h

#include "Mesh/SurfaceSizes.h"
#include "Operators/PrincipalDirections.h"
#include "Pieces/PieceOfSurface.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The principal curvatures of own triangles, as FindPrincipalDirections gives them for the whole surface.
///
/// Regions go on over seams: owners tell what they have of vertices, one ring after the other, as far as regions reach.
/// Collective. \param scale finite, >= 0. \param sizes of the whole surface.
/// \return on the faces of piece.Surface(), without confidence on ghosts; empty where there is no triangle.
/// Messages: as many exchanges as regions have rings, of about 250 bytes per vertex in a region over a seam.
PrincipalCurvatures CurvaturesInPieces(
  const PieceOfSurface& piece, double scale, const SurfaceSizes& sizes, const ExecutionContext& context);

}

#endif
