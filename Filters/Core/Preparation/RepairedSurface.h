#ifndef dmgRepairedSurface_h
#define dmgRepairedSurface_h

#include "Preparation/PreparationReport.h"
#include "Preparation/SurfaceParts.h"
#include "Support/Types.h"

namespace dmg
{

/// An oriented manifold, before its elements are checked.
struct RepairedSurface
{
  Points Positions;
  Triangles Corners;
  SurfaceParts Parts;
  PreparationReport Report;
};

}

#endif
