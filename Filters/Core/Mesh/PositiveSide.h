#ifndef dmgPositiveSide_h
#define dmgPositiveSide_h

#include "Mesh/TriangleMesh.h"

#include <string>
#include <vector>

namespace dmg
{

/// The side from which a surface is seen where counter-clockwise counts as positive: of vorticity, stream functions, angles and
/// rotations. It is a property of the shape, so that signs do not depend on the order of a file's rows or cells.
enum class PositiveSide
{
  Outside,        ///< of a closed component: from outside
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

  /// The kinds in words for users, such as "the outside"; a list of several kinds.
  std::string Text() const;
};

/// \param isGlobe open components that are no planes of constant z lie on a globe around the origin, whatever their shape. Without
///   it, a component counts as a part of a globe if its distances from the origin differ by at most 1 % of their size and of
///   what the component bulges out.
/// Cost: linear.
SidesOfSurface FindSides(const TriangleMesh& mesh, bool isGlobe = false);

/// Whether points have one z, up to rounding: their range in z is at most a millionth of their extent.
bool HaveConstantZ(const Points& points);

}

#endif
