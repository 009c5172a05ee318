#ifndef dmgGhostTriangles_h
#define dmgGhostTriangles_h

#include "Pieces/Surface/Ranks.h"
#include "Pieces/Surface/SeamSides.h"
#include "Pieces/Surface/ValuesOfOwners.h"

#include <array>
#include <vector>

namespace dmg
{

/// A triangle of a piece, as other ranks get it.
struct TravellingTriangle
{
  PlaceOnRank Place;                              ///< of the piece that it belongs to, and its number there
  std::array<PlaceOnRank, 3> Vertices;            ///< of the whole surface; see JoinFans
  std::array<std::array<double, 3>, 3> Positions; ///< of its corners
};

/// The triangles of other pieces that share a vertex with this one, each once, in ascending order of rank and number. A rank without
/// triangles gets the first triangle of the surface, so that no mesh is empty.
/// Collective. Triangles at partition boundaries travel over the owners of their vertices.
/// \param joined JoinFans of the fans.
std::vector<TravellingTriangle> GhostTriangles(const Ranks& ranks, const SurfacePiece& piece, const FansOfPiece& fans,
  const std::vector<SeamSide>& seams, const std::vector<PlaceOnRank>& joined);

}

#endif
