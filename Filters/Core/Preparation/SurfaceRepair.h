#ifndef dmgSurfaceRepair_h
#define dmgSurfaceRepair_h

#include "Preparation/PolygonSurface.h"
#include "Preparation/RepairedSurface.h"
#include "Preparation/SurfaceParts.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The steps of PrepareSurface, from joined points to parted fans.
/// \param given without unused points.
/// \throw InvalidInput no triangle is left, or a coordinate is not finite.
RepairedSurface Repair(
  const CellTriangles& given, const UsedPoints& used, bool joinPoints, const ExecutionContext& context);

/// \throw InvalidInput always: no triangle has an area.
[[noreturn]] void RefuseSurfaceWithoutArea();

}

#endif
