#ifndef dmgSheetPairs_h
#define dmgSheetPairs_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

/// The triangles that go on across each other's sides. Side 3 t + k of triangle t runs from its corner k to the next.
struct SheetPairs
{
  std::vector<int> Opposite;               ///< per side: the one beyond it, -1 on a boundary
  std::vector<std::array<int, 2>> Crossed; ///< the points of edges of more than two triangles

  int Of(int side) const { return this->Opposite[side]; }
  void Part(int side)
  {
    if (this->Opposite[side] >= 0)
    {
      this->Opposite[this->Opposite[side]] = -1;
      this->Opposite[side] = -1;
    }
  }
};

/// Pairs the triangles at each edge, whatever their orientation. At an edge of more than two, the two that are nearest to
/// one plane stay joined, and so do the two nearest of the rest, if they meet within 45 degrees of a plane.
/// \pre the corners of a triangle differ. Cost: linear.
SheetPairs PairSheets(const Points& positions, const Triangles& triangles, const ExecutionContext& context);

}

#endif
