#include "Drawing/ArrowHeads.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

constexpr double HalfWidth = 0.4; // of the base, over the size

/// \param point whose segment comes from the point before it.
ArrowHead HeadAt(const LinesOnSurface& lines, const TangentFrames& faces, int line, int before, int point,
  double fraction, double size)
{
  const Vector3 segment = lines.Positions[point] - lines.Positions[before];
  const Vector3 tip = lines.Positions[before] + fraction * segment;
  const Vector3 along = size * segment.stableNormalized();
  const Vector3 aside = HalfWidth * faces.Normal(lines.Faces[point]).cross(along);
  return { { tip, tip - along + aside, tip - along - aside }, line, point };
}

}

std::vector<ArrowHead> ArrowHeadsOf(
  const LinesOnSurface& lines, const TangentFrames& faces, double spacing, double size)
{
  std::vector<ArrowHead> heads;
  for (int line = 0; line < lines.NumberOfLines(); ++line)
  {
    const double number = std::max(1.0, std::round(lines.Lengths[line] / spacing));
    const double distance = lines.Lengths[line] / number;
    const int first = lines.Offsets[line], end = lines.Offsets[line + 1];
    double length = 0.0;
    double next = distance;
    int before = -1;
    for (int point = first + 1; point < end; ++point)
    {
      const double segment = (lines.Positions[point] - lines.Positions[point - 1]).norm();
      for (; segment > 0.0 && next <= length + segment; next += distance)
      {
        heads.push_back(HeadAt(lines, faces, line, point - 1, point, (next - length) / segment, size));
      }
      length += segment;
      before = segment > 0.0 ? point - 1 : before;
    }
    if (!lines.IsClosed[line] && before >= 0 && next < length + 0.5 * distance) // rounding kept the last one off
    {
      heads.push_back(HeadAt(lines, faces, line, before, before + 1, 1.0, size));
    }
  }
  return heads;
}

}
