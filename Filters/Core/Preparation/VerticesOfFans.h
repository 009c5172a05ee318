#ifndef dmgVerticesOfFans_h
#define dmgVerticesOfFans_h

#include "Preparation/SheetPairs.h"

#include <vector>

namespace dmg
{

/// A vertex for each fan of triangles around a point.
struct FanVertices
{
  Triangles Corners;       ///< vertices
  std::vector<int> Points; ///< the point that each vertex is at; ascending
};

/// Gives corners the same vertex where their triangles are neighbours in \p pairs, so that pinched points, parted sheets
/// and seams come apart.
///
/// Two sheets that cross at an edge may meet elsewhere, so that they share both vertices of it; but an edge of a mesh is its two
/// vertices. Such sheets exchange their continuations in \p pairs: the fan around each of the vertices that they share falls into
/// two, as its way over the edge and back is now closed, so both become two vertices. Nothing is left open. A second exchange at
/// the same vertex could join what the first has parted, so it waits for the next round.
/// \param triangles oriented alike: paired sides run in opposite directions.
/// Cost: linear in the number of triangles, for each round of exchanges.
FanVertices VerticesOfFans(
  int numberOfPoints, const Triangles& triangles, SheetPairs& pairs, const ExecutionContext& context);

}

#endif
