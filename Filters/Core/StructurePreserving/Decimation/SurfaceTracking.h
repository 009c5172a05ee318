#ifndef dmgSurfaceTracking_h
#define dmgSurfaceTracking_h

#include "Mesh/TriangleMesh.h"
#include "Places/SurfacePlace.h"
#include "StructurePreserving/Decimation/LineThroughRing.h"
#include "StructurePreserving/Decimation/OneRing.h"

#include <array>
#include <memory>
#include <mutex>
#include <vector>

namespace dmg
{

/// The places of the vertices and edges of a fine mesh on the mesh that edge collapses make of it.
///
/// Each collapse moves what lies in its one-ring along the joint flattening: vertices as points,
/// edges as polylines that cross the edges of the coarse mesh. Within a ring a polyline is pulled
/// straight; a ring is a disc, so its homotopy class does not change. Because the same end points
/// serve vertices and edges, and a crossing is one place on both of its faces, gradients, curls
/// and closed forms are kept to rounding, whatever the flattening does (thesis, section 4.2).
///
/// Vertices, faces and halfedges of the coarse mesh are named by their slots in a CollapsibleMesh.
class SurfaceTracking
{
public:
  explicit SurfaceTracking(const TriangleMesh& fine);

  /// A piece of a path through a one-ring, from the node where it enters the ring or begins to the
  /// node where it leaves or ends.
  struct Chain
  {
    int First;
    int Last;
  };
  /// Work space for one thread, and the nodes that it may give to paths.
  struct Worker
  {
    std::vector<Chain> Chains;
    std::vector<int> Points;
    std::vector<int> Nodes;
    std::vector<int> FreeNodes;
    int NextFreshNode = 0;
    int EndOfFreshNodes = 0;
  };
  /// A worker that no other thread has, until it is given back.
  std::unique_ptr<Worker> TakeWorker();
  void GiveBack(std::unique_ptr<Worker> worker);

  /// Moves everything in the ring. \param plane a one-to-one joint flattening of the ring.
  /// Rings without a common face may be moved at the same time; before CollapsibleMesh::Collapse.
  void Move(const OneRing& ring, const std::vector<Complex>& plane, Worker& worker);

  /// True where a fine vertex is still a vertex, with the same number, of the coarse mesh.
  bool IsCorner(int fineVertex) const { return this->PointFaces[fineVertex] < 0; }
  /// The place of a fine vertex on the coarse mesh. \pre !IsCorner
  SurfacePlace PlaceOf(int fineVertex) const
  {
    return { this->PointFaces[fineVertex], Eigen::Map<const Vector3>(this->PointWeights[fineVertex].data()) };
  }

  /// The fine edge that runs along a coarse halfedge, or -1. Such an edge is still an edge of the coarse mesh and has no path.
  int FineEdgeAlong(int halfedge) const { return this->FineEdges[halfedge]; }

  /// Calls visit(face, from, to) for the pieces of the path of a fine edge, in its orientation,
  /// with barycentric coordinates of both ends. An end at a vertex of the coarse mesh has
  /// coordinates exactly 0 and 1.
  /// \param tail tail(halfedge) is the vertex of the coarse mesh where a halfedge begins.
  /// \pre the edge runs along no coarse halfedge (FineEdgeAlong).
  template <class Tail, class Visit>
  void VisitPath(int fineEdge, const Tail& tail, Visit visit) const
  {
    for (int node = StartNode(fineEdge); node != EndNode(fineEdge); node = this->Node(node).Next)
    {
      this->VisitPiece(node, tail, visit);
    }
  }

  /// Calls visit(face, from, to) for the pieces of paths in a coarse face, until it returns false.
  template <class Tail, class Visit>
  void VisitPiecesIn(int face, const Tail& tail, Visit visit) const
  {
    int node = this->FirstPieceInFace[face];
    while (node >= 0 && this->VisitPiece(node, tail, visit))
    {
      node = this->Node(node).NextInFace;
    }
  }
  /// The fine edges whose paths have pieces in a coarse face, once per piece.
  std::vector<int> FineEdgesThrough(int face) const
  {
    std::vector<int> edges;
    for (int node = this->FirstPieceInFace[face]; node >= 0; node = this->Node(node).NextInFace)
    {
      int end = node;
      while (!this->IsPathEnd(end))
      {
        end = this->Node(end).Next;
      }
      edges.push_back(end / 2);
    }
    return edges;
  }

private:
  /// A path is a chain of nodes: its start, crossings of coarse edges, its end. The piece from a
  /// node to the next lies in the face of the node's LeavingHalfedge.
  struct PathNode
  {
    int Next;             ///< -1 at the end of a path, and at the start of one that does not exist
    int ArrivingHalfedge; ///< crossed halfedge, in the face that the path leaves
    int LeavingHalfedge;  ///< its twin, in the face that the path enters; at a start any of it
    int NextInFace;       ///< next piece in the same face
    double Fraction;      ///< of the crossing along ArrivingHalfedge
  };
  static constexpr int NodesPerPage = 4096;

  static int StartNode(int fineEdge) { return 2 * fineEdge; }
  static int EndNode(int fineEdge) { return 2 * fineEdge + 1; }
  bool IsPathEnd(int node) const { return node < 2 * this->Fine.NumberOfEdges(); }

  int FineVertexAt(int pathEnd) const { return this->Fine.EdgeVertices(pathEnd / 2)[pathEnd % 2]; }

  PathNode& Node(int node) { return this->Pages[node / NodesPerPage][node % NodesPerPage]; }
  const PathNode& Node(int node) const { return this->Pages[node / NodesPerPage][node % NodesPerPage]; }
  int AllocatePage();
  int AllocateNode(Worker& worker);

  static std::array<double, 3> OnHalfedge(int halfedge, double fraction)
  {
    std::array<double, 3> weights{ 0.0, 0.0, 0.0 };
    weights[halfedge % 3] = 1.0 - fraction;
    weights[(halfedge + 1) % 3] = fraction;
    return weights;
  }

  template <class Tail>
  std::array<double, 3> EndWeights(int fineVertex, int face, const Tail& tail) const
  {
    if (!this->IsCorner(fineVertex))
    {
      return this->PointWeights[fineVertex];
    }
    std::array<double, 3> weights;
    for (int k = 0; k < 3; ++k)
    {
      weights[k] = tail(3 * face + k) == fineVertex ? 1.0 : 0.0;
    }
    return weights;
  }

  /// The piece from a node to the next.
  template <class Tail, class Visit>
  auto VisitPiece(int node, const Tail& tail, Visit& visit) const
  {
    const PathNode& from = this->Node(node);
    const PathNode& to = this->Node(from.Next);
    const int face = from.LeavingHalfedge / 3;
    const std::array<double, 3> start = this->IsPathEnd(node) ? this->EndWeights(this->FineVertexAt(node), face, tail)
                                                              : OnHalfedge(from.LeavingHalfedge, 1.0 - from.Fraction);
    const std::array<double, 3> end = this->IsPathEnd(from.Next)
      ? this->EndWeights(this->FineVertexAt(from.Next), face, tail)
      : OnHalfedge(to.ArrivingHalfedge, to.Fraction);
    return visit(face, start, end);
  }

  void NumberSectors(const OneRing& ring);
  void CollectPieces(const OneRing& ring, Worker& worker);
  void CollectEdgesThatLeaveTheMesh(const OneRing& ring, Worker& worker);
  void MovePoints(const OneRing& ring, const std::vector<Complex>& plane, Worker& worker);
  void MovePoint(int fineVertex, Complex place, const OneRing& ring, const std::vector<Complex>& plane);
  void KeepBorder(const OneRing& ring, Worker& worker);
  void DrawChain(const Chain& chain, const OneRing& ring, const std::vector<Complex>& plane, Worker& worker);
  void BeginPiece(int node, int leavingHalfedge);
  PlaceInRing Locate(
    int node, int halfedge, double fraction, const OneRing& ring, const std::vector<Complex>& plane) const;
  PlaceInRing LocateFineVertex(int fineVertex, const OneRing& ring, const std::vector<Complex>& plane) const;
  PlaceInRing LocateCrossing(
    int halfedge, double fraction, const OneRing& ring, const std::vector<Complex>& plane) const;

  const TriangleMesh& Fine;

  std::vector<int> PointFaces;                     // per fine vertex; -1: a corner
  std::vector<std::array<double, 3>> PointWeights; // per fine vertex
  std::vector<int> NextPointInFace;                // per fine vertex
  std::vector<int> FirstPointInFace;               // per face slot

  std::vector<int> FineEdges;        // per halfedge slot
  std::vector<int> FirstPieceInFace; // per face slot
  /// Per face slot, in the ring at hand: its sector, or -1 - d for dead face d.
  std::vector<int> SectorOfFace;

  std::vector<std::unique_ptr<PathNode[]>> Pages; // of fixed number: threads read while others add
  int NumberOfPages = 0;
  std::mutex Mutex; // guards the two below and NumberOfPages
  std::vector<std::unique_ptr<Worker>> IdleWorkers;
};

}

#endif
