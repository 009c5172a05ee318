#ifndef dmgArrowHeads_h
#define dmgArrowHeads_h

#include "Drawing/EvenlySpacedLines.h"
#include "Mesh/TangentFrames.h"

#include <array>
#include <vector>

namespace dmg
{

/// A flat triangle at the tip of a line, two of whose sides show which way the line runs.
struct ArrowHead
{
  std::array<Vector3, 3> Corners; ///< the tip, on the line, and the base, counter-clockwise around the normal
  int Line;
  int Point; ///< of the line, at the tip or the next one after it
};

/// Heads along lines of vectors, fields of 1 direction: one at the end of each line, and others before it at an even
/// distance of about \p spacing.
/// \param faces the frames of the faces that \p lines lie on.
/// \param size from the tip to the base, in the unit of the points; the base is 0.8 times as wide.
/// \pre spacing > 0. Cost: linear in the points of the lines.
std::vector<ArrowHead> ArrowHeadsOf(
  const LinesOnSurface& lines, const TangentFrames& faces, double spacing, double size);

}

#endif
