#ifndef dmgCutSegment_h
#define dmgCutSegment_h

#include "Mesh/SurfaceSizes.h"
#include "Support/Types.h"

namespace dmg
{

/// A segment without what lies outside of a box.
struct CutSegment
{
  Vector3 Start, End;
  double First = 0.0, Last = 1.0; ///< fractions of the whole
  bool IsAny = true;              ///< whether something is left
};

/// Cuts a segment to the box around a surface, widened by a distance. Places near the surface are accurate, however far the ends are.
CutSegment CutToSurface(const Vector3& start, const Vector3& end, const SurfaceSizes& sizes, double distance);

}

#endif
