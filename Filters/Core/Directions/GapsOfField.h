#ifndef dmgGapsOfField_h
#define dmgGapsOfField_h

#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceRelation.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Gives the faces of a cell that is alone without a direction that of a face beside it: a vector that vanishes in the middle of a vortex is no gap
/// in the data, and the vortex becomes a singularity at a corner of that cell.
/// \param first a direction of each face in its frame, 0 where there is none.
/// Cost: linear.
void FillLoneCells(const FramedMesh& surface, const SurfaceRelation& relation, Vector<Complex>& first);

/// The gaps of a field, as of masked data: for each cell whether one of its faces has no direction. Drawings hide such cells, as nothing is known there.
/// Quads are of the whole surface: they keep each face that has a direction and fill the others (MakeQuadsAcrossGaps).
/// \param cells their number. Cost: linear.
std::vector<char> CellsWithoutDirection(const SurfaceRelation& relation, const Vector<Complex>& first, long long cells);

}

#endif
