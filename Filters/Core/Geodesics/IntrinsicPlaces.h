#ifndef dmgIntrinsicPlaces_h
#define dmgIntrinsicPlaces_h

#include "Geodesics/IntrinsicTriangulation.h"
#include "Support/Types.h"

namespace dmg
{

/// A place in a face of an intrinsic triangulation.
struct IntrinsicPlace
{
  int Halfedge;  ///< of the face
  Complex Point; ///< in the plane of the face, where the halfedge runs from 0 along the x axis
  double Turn;   ///< the direction of the halfedge against the way that leads to the place, in radians
};

/// The place to which a straight way leads from a vertex.
/// \param direction in radians, as IntrinsicTriangulation::Direction.
/// Cost: O(#F) for the vertex, and of the triangles on the way.
IntrinsicPlace FindPlace(const IntrinsicTriangulation& surface, int vertex, double direction, double length);

/// Makes a place a vertex.
/// \param direction of the way to the place, in the frame of the vertex, in radians.
/// \param isHeld receives whether it is on an edge that stays.
int AddVertex(const IntrinsicPlace& place, double direction, IntrinsicTriangulation& surface, bool& isHeld);

}

#endif
