#ifndef dmgSheetPairs_h
#define dmgSheetPairs_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

/// The side after one in its triangle. Side 3 t + k of triangle t runs from its corner k to the next.
inline int NextSide(int side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// For each side, the side of the triangle that continues the sheet.
struct SheetPairs
{
  std::vector<int> Opposite;               ///< per side; -1 on a boundary
  std::vector<std::array<int, 2>> Crossed; ///< the points of edges of more than two triangles

  int Of(int side) const { return this->Opposite[side]; }

  /// \param a, b may be -1: then the other one is on a boundary.
  void Join(int a, int b)
  {
    if (a >= 0)
    {
      this->Opposite[a] = b;
    }
    if (b >= 0)
    {
      this->Opposite[b] = a;
    }
  }

  void Part(int side)
  {
    if (this->Opposite[side] >= 0)
    {
      this->Opposite[this->Opposite[side]] = -1;
      this->Opposite[side] = -1;
    }
  }
};

struct PairingOptions
{
  /// Whether only sides of opposite directions are paired at edges of more than two triangles, so that no triangle is turned for one there.
  bool KeepsDirections = false;
  std::vector<char> HasBothSides = {}; ///< per triangle, whether it is given in the other direction, too; or empty
};

/// Pairs the triangles at each edge: two triangles whatever their orientation, more than two as SheetsAtEdge does.
/// \pre the corners of a triangle differ.
/// Cost: linear; n log n in the number of triangles at an edge.
SheetPairs PairSheets(
  const Points& positions, const Triangles& triangles, const PairingOptions& options, const ExecutionContext& context);

}

#endif
