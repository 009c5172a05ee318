#include "Constraints/CutSegment.h"

namespace dmg
{

namespace
{

/// The place of a segment where it crosses a side of a box.
Vector3 At(const Vector3& start, const Vector3& end, double parameter, int axis, double side)
{
  Vector3 place = (1.0 - parameter) * start + parameter * end;
  place[axis] = side;
  return place;
}

/// (Liang and Barsky 1984) Parameters of places near the start are accurate, however far the end is.
CutSegment CutFromStart(const Vector3& start, const Vector3& end, const Vector3& lower, const Vector3& upper)
{
  CutSegment cut{ start, end };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double along = end[axis] - start[axis];
    if (along == 0.0)
    {
      cut.IsAny &= start[axis] >= lower[axis] && start[axis] <= upper[axis];
      continue;
    }
    const double entrySide = along < 0.0 ? upper[axis] : lower[axis];
    const double exitSide = along < 0.0 ? lower[axis] : upper[axis];
    if (const double entry = (entrySide - start[axis]) / along; entry > cut.First)
    {
      cut.First = entry;
      cut.Start = At(start, end, entry, axis, entrySide);
    }
    if (const double exit = (exitSide - start[axis]) / along; exit < cut.Last)
    {
      cut.Last = exit;
      cut.End = At(start, end, exit, axis, exitSide);
    }
  }
  cut.IsAny &= cut.First < cut.Last;
  return cut;
}

CutSegment CutToBox(const Vector3& start, const Vector3& end, const Vector3& lower, const Vector3& upper)
{
  const Vector3 centre = 0.5 * lower + 0.5 * upper;
  if (!((end - centre).stableNorm() < (start - centre).stableNorm()))
  {
    return CutFromStart(start, end, lower, upper);
  }
  const CutSegment cut = CutFromStart(end, start, lower, upper);
  return { cut.End, cut.Start, 1.0 - cut.Last, 1.0 - cut.First, cut.IsAny };
}

}

CutSegment CutToSurface(const Vector3& start, const Vector3& end, const SurfaceSizes& sizes, double distance)
{
  const Vector3 margin = Vector3::Constant(distance);
  return CutToBox(start, end, sizes.Lower - margin, sizes.Upper + margin);
}

}
