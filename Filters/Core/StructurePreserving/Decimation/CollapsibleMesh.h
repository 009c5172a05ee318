#ifndef dmgCollapsibleMesh_h
#define dmgCollapsibleMesh_h

#include "Mesh/TriangleMesh.h"
#include "StructurePreserving/Decimation/OneRing.h"
#include "StructurePreserving/Decimation/Quadric.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// A triangle mesh that shrinks by edge collapses. Vertices, faces and halfedges keep their numbers
/// while it does; Compact() renumbers what is left.
///
/// Two threads may gather rings (GatherOneRing) and collapse at the same time if no face touches both edges
/// (CollapsePolicy.h selects such edges).
class CollapsibleMesh
{
public:
  explicit CollapsibleMesh(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

  int NumberOfVertexSlots() const { return static_cast<int>(this->Positions.size()); }
  int NumberOfFaceSlots() const { return static_cast<int>(this->Corners.size()) / 3; }
  int NumberOfHalfedgeSlots() const { return static_cast<int>(this->Corners.size()); }
  int NumberOfLiveFaces() const { return this->LiveFaces; }

  bool IsLive(int face) const { return this->Corners[3 * face] >= 0; }
  int Tail(int halfedge) const { return this->Corners[halfedge]; }
  int Head(int halfedge) const { return this->Corners[TriangleMesh::Next(halfedge)]; }
  int Twin(int halfedge) const { return this->Twins[halfedge]; }
  /// A halfedge that leaves the vertex, as in TriangleMesh.
  int OutgoingHalfedge(int vertex) const { return this->Outgoing[vertex]; }
  bool IsBoundaryVertex(int vertex) const { return this->Twins[this->Outgoing[vertex]] < 0; }
  const Vector3& Position(int vertex) const { return this->Positions[vertex]; }

  /// Error of the collapse: quadric error at the new place, plus a little of the fourth power of
  /// the edge's length, which decides on flat parts. Infinite where the kind of collapse is not
  /// allowed: an inner edge between two boundary vertices.
  /// Thesis, section 5.1; the length term keeps coarse triangles round.
  double CollapseCost(int halfedge) const;

  /// The work that a collapse leaves until no other thread collapses: vertices of the loop, which other
  /// rings share, may still name a dead face as theirs.
  struct Afterwork
  {
    /// {vertex, halfedge}
    std::array<std::array<int, 2>, 2> Replacement{ { { -1, -1 }, { -1, -1 } } };
    int DeadFaces = 0;
  };

  /// Replaces the faces of the ring. FinishCollapse must follow before the next gathering.
  Afterwork Collapse(const OneRing& ring);
  void FinishCollapse(const Afterwork& afterwork);

  /// The live part as a mesh of its own, with order kept.
  struct Compacted
  {
    TriangleMesh Mesh;
    std::vector<int> VertexNumber; ///< per vertex slot: new number or -1
    std::vector<int> FaceNumber;   ///< per face slot: new number or -1
  };
  Compacted Compact() const;

  /// Takes over what a finer mesh learned about the original surface.
  void InheritQuadrics(const CollapsibleMesh& finer, const std::vector<int>& vertexNumber);

  /// Calls visit(halfedge) for the halfedges that leave a vertex, counter-clockwise.
  template <class Visit>
  void VisitOutgoing(int vertex, Visit visit) const
  {
    const int first = this->Outgoing[vertex];
    int h = first;
    do
    {
      visit(h);
      h = this->Twins[TriangleMesh::Previous(h)];
    } while (h >= 0 && h != first);
  }

  /// Calls visit(other) for the vertices that share an edge with a vertex.
  template <class Visit>
  void VisitNeighbours(int vertex, Visit visit) const
  {
    const int first = this->Outgoing[vertex];
    int h = first;
    do
    {
      visit(this->Head(h));
      const int returning = TriangleMesh::Previous(h);
      h = this->Twins[returning];
      if (h < 0)
      {
        visit(this->Tail(returning));
      }
    } while (h >= 0 && h != first);
  }

private:
  void AddPlanes(const TriangleMesh& mesh, int halfedge, Quadric& quadric) const;

  std::vector<Vector3> Positions;
  std::vector<Quadric> Quadrics; // about Origin
  std::vector<int> Corners;      // per halfedge: its tail; -1 in dead faces
  std::vector<int> Twins;        // per halfedge
  std::vector<int> Outgoing;     // per vertex, as in TriangleMesh
  Vector3 Origin;
  int LiveFaces = 0;
};

}

#endif
