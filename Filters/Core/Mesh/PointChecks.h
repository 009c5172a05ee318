#ifndef dmgPointChecks_h
#define dmgPointChecks_h

#include "Mesh/MeshChecks.h"
#include "Support/Types.h"

namespace dmg
{

/// The part of CheckElements that looks at points alone.
/// \throw InvalidInput a coordinate is not finite or beyond 1e40, or the surface is no larger than 1e-40.
/// Cost: linear.
void CheckPoints(const Points& points, const ElementNames& names);

}

#endif
