#ifndef dmgSeamSides_h
#define dmgSeamSides_h

#include "Pieces/Surface/Ranks.h"
#include "Pieces/Surface/ValuesOfOwners.h"
#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

/// The part of a surface that a rank has: triangles that no other rank has.
struct SurfacePiece
{
  Points Positions;  ///< some may be used by no triangle
  Triangles Corners; ///< counter-clockwise seen from outside, in all pieces alike
  /// Points of different pieces with the same number are one; empty: points at the same place are one, to the last bit.
  std::vector<long long> GlobalIds;
};

/// The fans of the triangles of a piece around their points. A point where the piece is pinched has several of them.
struct FansOfPiece
{
  Triangles Corners;         ///< fans, numbered by their points
  std::vector<int> OfPoints; ///< the point that each fan is at; ascending
  std::vector<int>
    Boundary; ///< sides without a triangle beyond them, ascending; side 3 t + k of triangle t starts at corner k
};

/// \throw InvalidInput an edge has more than two triangles, or two that run along it in the same direction.
FansOfPiece FansAround(int numberOfPoints, const Triangles& triangles, const ExecutionContext& context);

/// A side of a piece that goes on beyond: in another piece, or beyond a slit of the same one.
struct SeamSide
{
  int Here;           ///< a side of this piece
  PlaceOnRank Beyond; ///< a side of the piece of that rank, in the opposite direction
};

/// Pairs the boundary sides of all pieces that have the same ends. Collective.
/// \throw InvalidInput more than two sides meet, or two in the same direction.
/// Messages: one exchange of 64 bytes per boundary side and one of 12 per seam.
std::vector<SeamSide> PairSides(const Ranks& ranks, const SurfacePiece& piece, const FansOfPiece& fans);

/// The vertices of the whole surface: per fan of this piece the smallest rank, and the smallest number there, of the fans that
/// seams join it with. Collective. Exchanges: as many as pieces meet around one vertex.
std::vector<PlaceOnRank> JoinFans(const Ranks& ranks, const FansOfPiece& fans, const std::vector<SeamSide>& seams);

}

#endif
