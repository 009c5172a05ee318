#ifndef dmgPieceComponents_h
#define dmgPieceComponents_h

#include "Pieces/Surface/PieceOfSurface.h"

#include <vector>

namespace dmg
{

/// The connected components of a surface in pieces, by numbers that all ranks agree on.
struct PieceComponents
{
  std::vector<int> OfOwned; ///< per owned vertex the number of its component
  int NumberBound = 0;      ///< above all numbers; not all below it are in use
};

/// Collective. Every rank learns which components of pieces hang together.
PieceComponents ComponentsOfPieces(const PieceOfSurface& piece);

}

#endif
