#ifndef dmgAnglesOfField_h
#define dmgAnglesOfField_h

#include "Drawing/DirectionsOnFaces.h"
#include "Mesh/PositiveSide.h"
#include "Mesh/TangentFrames.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// The angle from a reference vector, projected to the plane of the face, to the nearest direction of the field:
/// counter-clockwise seen from the positive side, in [-pi / N, pi / N]. NaN where there is no direction, or where the reference is
/// zero or perpendicular to the face. Changing the sign of the reference does not change angles where N is even.
/// \param references in space, one for each face.
/// Cost: O(#F).
Vector<double> AnglesOfField(const TangentFrames& faceFrames, const DirectionsOnFaces& field, const Points& references,
  const SidesOfSurface& sides, const ExecutionContext& context = SerialContext());

}

#endif
