#ifndef dmgPreparationReport_h
#define dmgPreparationReport_h

#include "Mesh/PositiveSide.h"

#include <string>
#include <vector>

namespace dmg
{

/// The changes that made a surface an oriented manifold, counted.
struct PreparationReport
{
  int PointsJoined = 0;   ///< to another one that coincides with it
  int CellsTurned = 0;    ///< against most of their component
  int CellsDoubled = 0;   ///< have the field of their twin
  int CellsCollapsed = 0; ///< a line or a point, have the mean of the field around
  int EdgesParted = 0;    ///< at which more than two sheets met
  int EdgesCut = 0;       ///< of seams along which a surface with one side only was cut
  int PointsParted = 0;   ///< at which fans of triangles met

  /// The sides from which the corners of the faces are counter-clockwise, those that occur.
  std::vector<PositiveSide> Sides;

  /// Whether something is other than it was given. Joined points close seams that nobody sees, and cells without area are
  /// not seen themselves, so these are no change.
  bool IsChanged() const;
  /// A list like "3 cells turned, 12 points joined"; empty where nothing was done.
  std::string Text() const;
};

}

#endif
