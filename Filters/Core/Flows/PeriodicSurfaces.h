#ifndef dmgPeriodicSurfaces_h
#define dmgPeriodicSurfaces_h

#include "Mesh/TriangleMesh.h"

#include <string>

/// Surfaces of files that are meant to be periodic and are not closed, on which flows are decomposed as nobody means it.
namespace dmg
{

/// A globe around the origin with a slit along a meridian, from a grid that ends one step short of a full circle: all of the boundary along
/// meridians stands on two of them, no farther apart than one and a half cells.
/// \param axis from the origin to the north pole, not zero.
/// \return a warning with a remedy; empty where there is no such slit. Cost: O(#E).
std::string WarningOfSlit(const TriangleMesh& mesh, const Vector3& axis);

/// A periodic box in a plane of constant z, folded: cells that join opposite sides are as long as the box.
/// \return a warning with a remedy; empty where there are no such cells. Cost: O(#E).
std::string WarningOfFoldedBox(const TriangleMesh& mesh);

}

#endif
