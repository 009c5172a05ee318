#ifndef dmgPositiveSide_h
#define dmgPositiveSide_h

#include "Mesh/TriangleMesh.h"

#include <string>
#include <vector>

namespace dmg
{

/// The side from which a surface is seen where counter-clockwise counts as positive: of vorticity, stream functions, angles and
/// rotations, and where normal parts and curvatures are positive. It is a property of the shape, so that signs do not depend on the order of
/// a file's rows or cells.
enum class PositiveSide
{
  Outside,        ///< of a closed component: from outside; of a cavity: from outside of the solid around it
  AwayFromOrigin, ///< of a part of a globe around the origin: from outside of the globe
  Up,             ///< of a component in a plane of constant z: from +z
  Convex,         ///< of another open component that bulges to one side, as a tube or a dome: from there
  OfCells,        ///< of any other: the side from which the corners of most of its cells are counter-clockwise
};

/// The one place that decides which side counts as positive.
struct SidesOfSurface
{
  std::vector<PositiveSide> Kinds; ///< those that occur, each once, in the order of the enumeration
  Vector<double> OfFaces;          ///< 1 where corners are counter-clockwise, seen from the positive side, else -1
  Vector<double> OfVertices;       ///< that of the faces around
};

/// Kinds in words for users, such as "the outside"; a list of several.
std::string TextOf(const std::vector<PositiveSide>& kinds);

/// \param isGlobe open components that are no planes of constant z lie on a globe around the origin, whatever their shape. Without
///   it, a component counts as a part of a globe if its distances from the origin differ by at most 1 % of their size and of
///   what the component bulges out.
///
/// A closed component is a cavity if it is turned the other way round than most of the volume, and its box lies in that of a component which is
/// not: it has the side of the solid then.
/// Cost: linear, besides a comparison of boxes for each pair of closed components that are turned against each other.
SidesOfSurface FindSides(const TriangleMesh& mesh, bool isGlobe = false);

/// Whether points have one z, up to rounding: their range in z is at most a millionth of their extent.
bool HaveConstantZ(const Points& points);

}

#endif
