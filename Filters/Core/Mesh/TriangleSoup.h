#ifndef dmgTriangleSoup_h
#define dmgTriangleSoup_h

#include "Mesh/TriangleMesh.h"

namespace dmg
{

/// Whether a surface is one to the eye alone, as files without shared points leave it: more than half of the sides of its
/// triangles have no triangle beyond, and more than half of its vertices lie where another one does.
/// Cost: linear; O(#V log #V) where triangles are alone.
bool IsSoup(const TriangleMesh& mesh);

}

#endif
