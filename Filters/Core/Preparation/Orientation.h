#ifndef dmgOrientation_h
#define dmgOrientation_h

#include "Preparation/SheetPairs.h"

#include <array>
#include <vector>

namespace dmg
{

/// The triangles that are to be turned so that neighbours agree.
struct Orientation
{
  std::vector<char> IsTurned;          ///< per triangle
  std::vector<std::array<int, 2>> Cut; ///< the points of edges that were parted, as no orientation suits both sides
};

/// Orients each component as most of its triangles are. A component with one side only is parted along a seam that no
/// triangle could shorten by changing to the other side of it.
/// Cost: linear; the seam of one sided components some passes over it.
Orientation Orient(const Points& positions, const Triangles& triangles, SheetPairs& pairs);

/// Turns a triangle over: its first corner stays, and side k becomes side 2 - k.
void TurnOver(Triangles& triangles, SheetPairs& pairs, const std::vector<char>& isTurned);

}

#endif
