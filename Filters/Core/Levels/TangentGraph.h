#ifndef dmgTangentGraph_h
#define dmgTangentGraph_h

#include "Mesh/TriangleMesh.h"
#include "Mesh/VertexConnection.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"
#include "Support/Unfilled.h"

#include <vector>

namespace dmg
{

/// Points of a surface with a tangent frame each, and the positions of the neighbours around every point: all that interpolation
/// on the surface needs. Complex numbers are vectors and rotations in the frames.
///
/// The links of point p are [Offsets[p], Offsets[p + 1]), counter-clockwise around p. Links are
/// mutual, and a point is no neighbour of itself.
struct TangentGraph
{
  std::vector<int> Offsets = { 0 };
  Unfilled<int> Neighbours;
  /// The way to the neighbour, in the frame of the point.
  Unfilled<Complex> Steps;
  /// Carries directions from the neighbour's frame into the point's; unit.
  Unfilled<Complex> Turns;
  /// Per point, the Gaussian curvature integrated over what it stands for: with its sign, in radians.
  Unfilled<double> Curvatures;

  int NumberOfPoints() const { return static_cast<int>(this->Offsets.size()) - 1; }
  int NumberOfLinks() const { return static_cast<int>(this->Neighbours.size()); }
};

/// The faces of a surface, in their FaceFrames, linked across edges. The point of a face is the
/// mean of the midpoints of its sides, each by its squared length, and steps are straight in the
/// plane of the two faces, unfolded: faces that share a long side, which the energies bind tightly,
/// are near each other. A face has its share of the angles that its corners lack of a full turn;
/// corners at the boundary lack none. \param order [i] is the face of point i; a permutation. Cost: O(#F).
TangentGraph FaceGraph(const TriangleMesh& mesh, const std::vector<int>& order, const ExecutionContext& context);

/// The vertices of a surface, in their VertexFrames, linked along edges: a step is as long as the edge, at its polar angle,
/// and turns are those of the connection. A vertex has a third of the curvature of the faces around it.
/// \param order [i] is the vertex of point i; a permutation. Cost: O(#F).
TangentGraph VertexGraph(const TriangleMesh& mesh, const VertexConnection& connection, const std::vector<int>& order,
  const ExecutionContext& context);

}

#endif
