#ifndef dmgCoincidingPoints_h
#define dmgCoincidingPoints_h

#include "Support/DisjointSets.h"
#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

/// Points coincide that are nearer to each other than this part of the edges there, and than RoundingOf.
constexpr double PartOfEdge = 0.01;

/// The distance that the precision of the coordinates does not tell from none. Coordinates that are all of single precision: 16 * 2^-23 of the
/// largest one. Others, as those of a national grid: the same part of the extent of all points, as the surface would have in single precision
/// around the origin.
double RoundingOf(const Points& positions);

/// A point on a boundary, and the size of the triangles there.
struct BoundaryPoint
{
  int Point;   ///< row of the positions
  double Size; ///< least of the longest edges of the triangles that have it on a boundary side
};

/// Unites pairs of points that are no farther from each other than a distance. A chain of pairs that is longer than that is kept: it is a
/// row of a boundary-layer mesh, whose layers may be thinner than coordinates resolve.
/// \return whether there were any.
bool UniteNear(
  const Points& positions, const std::vector<std::array<int, 2>>& pairs, double distance, DisjointSets& sets);

/// Unites the points of boundaries that coincide: those that are equal, and those that are nearer to each other than
/// RoundingOf all positions and than PartOfEdge of both sizes, as UniteNear does.
/// \param points ascending, each once.
/// \param sets of the rows of \p positions.
/// \return whether there were any.
/// Cost: O(n log n) in their number.
bool JoinBoundary(const Points& positions, const std::vector<BoundaryPoint>& points, DisjointSets& sets);

/// The first row of each place: equal rows have the same number. Cost: O(n log n).
std::vector<int> FirstOfEqual(const Points& positions);

/// For each point the first of those that coincide with it, as JoinBoundary would unite the corners of all triangles; other points are alone.
/// Cost: O(n log n).
std::vector<int> FirstOfCoinciding(const Points& positions, const Triangles& corners);

/// Gathers the points of boundary sides.
class BoundaryPoints
{
public:
  /// Adds the side from a to b of a triangle whose third corner is c.
  void Add(const Points& positions, int a, int b, int c);
  std::vector<BoundaryPoint> Take();

private:
  std::vector<BoundaryPoint> All;
};

}

#endif
