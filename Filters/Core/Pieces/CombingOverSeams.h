#ifndef dmgCombingOverSeams_h
#define dmgCombingOverSeams_h

#include "Field.h"
#include "Pieces/Surface/PieceOfSurface.h"

namespace dmg
{

/// Rotates the combed directions of pieces so that direction 0 continues over partition boundaries, too, wherever possible: along a
/// spanning tree of the pieces. At vertices that several ranks have, all take the direction of the owner.
/// Collective. \param field on piece.Surface(), combed by each rank alone.
/// Messages: one exchange of 24 bytes per ghost triangle, one of 16 per ghost vertex, and 12 bytes per pair of touching pieces to all.
void CombOverSeams(const PieceOfSurface& piece, Field& field);

}

#endif
