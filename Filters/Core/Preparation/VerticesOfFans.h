#ifndef dmgVerticesOfFans_h
#define dmgVerticesOfFans_h

#include "Preparation/SheetPairs.h"

#include <vector>

namespace dmg
{

/// A vertex for each fan of triangles around a point.
struct FanVertices
{
  Triangles Corners;         ///< vertices
  std::vector<int> Points;   ///< the point that each vertex is at; ascending
  int TrianglesDetached = 0; ///< that share no vertices with others, as their neighbours do not meet in a manifold
};

/// Gives corners the same vertex where their triangles are neighbours in \p pairs, so that pinched points, parted sheets
/// and seams come apart.
/// \param triangles oriented alike: paired sides run in opposite directions.
/// Cost: linear in the number of triangles.
FanVertices VerticesOfFans(
  int numberOfPoints, const Triangles& triangles, SheetPairs& pairs, const ExecutionContext& context);

}

#endif
