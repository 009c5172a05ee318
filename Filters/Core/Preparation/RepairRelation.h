#ifndef dmgRepairRelation_h
#define dmgRepairRelation_h

#include "Preparation/Orientation.h"
#include "Preparation/PolygonSurface.h"
#include "Preparation/RepairedSurface.h"
#include "Preparation/SheetPairs.h"
#include "Preparation/SurfaceParts.h"
#include "Preparation/VerticesOfFans.h"
#include "Support/DisjointSets.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The changes that repair some triangles.
struct RepairSteps
{
  DisjointSets JoinedPoints;     ///< points
  Triangles Corners;             ///< of all triangles, after points were joined
  std::vector<int> Places;       ///< by point: equal for points at one place
  std::vector<int> Twins;        ///< by triangle: the one that has its place, or itself
  std::vector<int> Participants; ///< the triangles that take part
  Triangles CornersOfParticipants;
  SheetPairs Pairs; ///< of participants
  dmg::Orientation Orientation;
  FanVertices Fans;
};

/// Whether a triangle has a corner twice.
inline bool IsCollapsed(const Triangles& corners, int t)
{
  const auto& c = corners.row(t);
  return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
}

/// The surface that is left, how it stands to the cells and points that were given, and what was changed.
RepairedSurface RelateRepaired(const CellTriangles& given, const UsedPoints& used, const RepairSteps& steps);

}

#endif
