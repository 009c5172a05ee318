#ifndef dmgIsolineArrangement_h
#define dmgIsolineArrangement_h

#include "Mesh/TriangleMesh.h"
#include "Places/SurfacePlace.h"
#include "Quads/Crosses/CutSurface.h"
#include "Quads/Map/SeamlessMap.h"

#include <array>
#include <utility>
#include <vector>

namespace dmg
{

/// The isolines of a seamless map at half-integers, and how those of u meet those of v. On the surface they are closed curves, or end on
/// the boundary, also where the map turns faces over. So a crossing becomes a quad, whatever the map does (the dual of the usual
/// extraction, which looks for grid points and fails in folds).
///
/// *Nodes* are the crossings, then the ends of isolines on the boundary. A *dart* 4 n + s leaves node n in slot s; slots follow each
/// other counter-clockwise on the surface. A crossing has four: 0 and 2 along its isoline of u, 1 and 3 along that of v. An end has
/// three: 0 along the boundary, with the surface on the left, 1 into the surface, 2 back along the boundary.
///
/// All is decided by the order of numbers in fixed point. In a face, the ends of its pieces of isolines stand on a ring, its sides; two
/// pieces cross if and only if their ends alternate there.
struct IsolineArrangement
{
  std::vector<SurfacePlace> Nodes;
  int NumberOfCrossings = 0;
  std::vector<std::array<int, 4>>
    Opposite; ///< by node and slot: the dart at the other end of the arc; -1 in slot 3 of an end

  /// A place at which an isoline crosses an edge.
  struct EdgePoint
  {
    FixedPoint Numerator; ///< over the denominator, the part of the way along HalfedgeOf(edge)
    FixedPoint Denominator;
    FixedPoint Level;
    int Family;         ///< 0 for u, 1 for v; both in the map of the face of that halfedge
    int Dart = -1;      ///< whose arc runs through here; -1 where the isoline crosses no other one
    bool Leaves = true; ///< whether the arc leaves the face of that halfedge, rather than coming into it
  };
  std::vector<EdgePoint> Points;
  std::vector<int> Offsets; ///< by edge: its points begin here, in their order along HalfedgeOf(edge)

  std::vector<std::vector<int>> Loops; ///< of the boundary: their nodes in order, with the surface on the left
  std::vector<int> LoopHalfedges;      ///< of the boundary loops: one each

  bool IsEnd(int node) const { return node >= this->NumberOfCrossings; }
  int NumberOfSlots(int node) const { return this->IsEnd(node) ? 3 : 4; }
  bool IsCrossed(int edge) const { return this->Offsets[edge + 1] > this->Offsets[edge]; }
  /// The first darts of all nodes are multiples of 4.
  int NumberOfDarts() const { return 4 * static_cast<int>(this->Nodes.size()); }
  /// The next dart around its node, clockwise.
  int Clockwise(int dart) const
  {
    const int node = dart / 4, slots = this->NumberOfSlots(node);
    return 4 * node + (dart % 4 + slots - 1) % slots;
  }
};

/// The barycentric coordinates in a face of a point of its map; of the nearest one in the face, or so, where it is outside.
Vector3 WeightsInFace(const MapOfCorners& map, int face, const std::array<FixedPoint, 2>& point);

/// Cost: linear in the faces and crossings, and the square of the isolines in a face.
IsolineArrangement ArrangeIsolines(
  const TriangleMesh& mesh, const CutSurface& cut, const MapOfCorners& map, const ExecutionContext& context);

}

#endif
