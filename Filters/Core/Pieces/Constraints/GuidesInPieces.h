#ifndef dmgGuidesInPieces_h
#define dmgGuidesInPieces_h

#include "Constraints/Guides.h"
#include "Mesh/SurfaceSizes.h"
#include "Pieces/Surface/PieceOfSurface.h"
#include "Places/NearestPlaces.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// Brings guides to a surface in pieces, as FollowGuides does to a whole one.
///
/// Ranks share out the segments and vectors of the guides. For its share, each gets the triangles of all pieces that may be nearest to a
/// place of it, and those that a search over the surface passes: what is nearest decides, whoever has it. FollowGuides then runs on
/// these triangles. A guide far from the surface, by many mean edges, is near to many triangles.
///
/// Collective. \param guides the same on all ranks.
/// \param places of the mesh of this piece.
/// \param sizes of the whole surface.
/// \return directions on own triangles, counted from 0; the report is that of all ranks.
/// \throw InvalidInput as FollowGuides.
/// Messages: some exchanges of 8 bytes for each mean edge of the lines, and one of 112 per triangle near to them.
FollowedGuides FollowGuidesInPieces(const Guides& guides, const PieceOfSurface& piece, const NearestPlaces& places,
  const SurfaceSizes& sizes, const ExecutionContext& context);

}

#endif
