#ifndef dmgDistanceSources_h
#define dmgDistanceSources_h

#include "Support/Types.h"

#include <limits>
#include <vector>

namespace dmg
{

/// The places where distance is 0. Each vertex, point and line is a source of its own; the region, the boundary and the sharp edges are one
/// each. Sources are numbered in the order of these members.
struct DistanceSources
{
  std::vector<int> Vertices = {};
  std::vector<Vector3> Points = {}; ///< in space; brought to the nearest place of the surface
  std::vector<std::vector<Vector3>>
    Lines = {};                  ///< polylines in space, likewise; closed where the last point is the first one
  std::vector<char> Region = {}; ///< per face, not 0 for those of the region; or empty
  bool Boundary = false;         ///< of the surface
  double FeatureAngle = 0.0; ///< in degrees; edges whose faces have a larger angle between them are sharp. 0 is off.

  friend bool operator==(const DistanceSources& a, const DistanceSources& b)
  {
    return a.Vertices == b.Vertices && a.Points == b.Points && a.Lines == b.Lines && a.Region == b.Region &&
      a.Boundary == b.Boundary && a.FeatureAngle == b.FeatureAngle;
  }
};

struct DistanceOptions
{
  /// Distances beyond it are not computed, which saves time.
  double MaximumDistance = std::numeric_limits<double>::infinity();
  /// Whether distances are negative inside: in the region, and to the left of lines, seen from the positive side of the surface
  /// (PositiveSide.h). Needs lines or a region that part the surface, and no points.
  bool Signed = false;
  /// Points and lines that are farther from the surface are left out; relative to the diagonal of its bounding box.
  double MaximumSourceDistance = 0.1;
  /// Whether all sources may be too far, or none of the surface, so that no distance is known. Else that is an error.
  bool MayMiss = false;

  friend bool operator==(const DistanceOptions& a, const DistanceOptions& b)
  {
    return a.MaximumDistance == b.MaximumDistance && a.Signed == b.Signed &&
      a.MaximumSourceDistance == b.MaximumSourceDistance && a.MayMiss == b.MayMiss;
  }
};

}

#endif
