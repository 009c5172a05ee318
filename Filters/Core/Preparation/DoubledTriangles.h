#ifndef dmgDoubledTriangles_h
#define dmgDoubledTriangles_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// For each triangle the first one that is the same, or itself. Triangles are the same if they have the same corners in
/// any order, or if their corners are at the same places in the same cyclic order, as those of a copied sheet. Solids
/// that touch have triangles at the same places in opposite order, which are not the same.
/// \param places a number for each point, equal where points coincide.
/// \param takesPart triangles for which it is 0 are the same as none, and none is the same as them.
/// Cost: linear.
std::vector<int> FirstOfDoubled(const Triangles& triangles, const std::vector<int>& places,
  const std::vector<char>& takesPart, const ExecutionContext& context);

/// Makes twins of opposite order that have the same corners different again where two solids share a face: else one of them
/// would be open. A patch of such twins lies between solids if two other triangles, or four and so on, meet it at an edge of its rim.
/// A patch that nothing meets is one sheet that is given with both of its sides.
/// \param takesPart triangles for which it is 0 are no twins.
/// \param firsts as FirstOfDoubled gives them.
/// Cost: linear.
void KeepTwinsOfSolids(const Triangles& triangles, const std::vector<char>& takesPart, std::vector<int>& firsts,
  const ExecutionContext& context);

}

#endif
