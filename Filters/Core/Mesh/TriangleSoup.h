#ifndef dmgTriangleSoup_h
#define dmgTriangleSoup_h

#include "Mesh/TriangleMesh.h"

namespace dmg
{

/// Whether a surface is a soup of triangles, as files without shared points give: more than half of the sides of its
/// triangles are boundary, and more than half of its vertices lie where another one does.
/// Cost: linear; O(#V log #V) where triangles are alone.
bool IsSoup(const TriangleMesh& mesh);

}

#endif
