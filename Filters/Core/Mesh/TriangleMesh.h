#ifndef dmgTriangleMesh_h
#define dmgTriangleMesh_h

#include "Mesh/MeshChecks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <algorithm>
#include <array>
#include <vector>

namespace dmg
{

/// An oriented manifold triangle surface with or without boundary; immutable.
///
/// Halfedge h = 3 f + k runs along the k-th side of face f, from corner k to corner (k + 1) % 3.
/// An edge is oriented from its smaller to its larger vertex index; edges are numbered in
/// ascending order of (smaller, larger).
///
/// Every vertex is used by a face; faces around a vertex form one fan (closed or with one gap).
/// Zero-area faces are allowed, a face whose three corners share one place is not.
class TriangleMesh
{
public:
  /// \param points #V x 3, finite.
  /// \param triangles #F x 3.
  /// \param names how error messages call the elements.
  /// \throw InvalidInput what CheckElements refuses, and how faces meet: an edge with more than two
  /// faces, two faces that run along their edge in the same direction, a vertex whose faces form
  /// more than one fan. The message names the element and the remedy.
  /// Cost: O(#F) for bounded valence.
  TriangleMesh(Points points, Triangles triangles, const ElementNames& names = {},
    const ExecutionContext& context = SerialContext());

  int NumberOfVertices() const { return static_cast<int>(this->V.rows()); }
  int NumberOfFaces() const { return static_cast<int>(this->F.rows()); }
  int NumberOfEdges() const { return static_cast<int>(this->EdgeHalfedges.size()); }

  const dmg::Points& VertexPositions() const { return this->V; }
  const dmg::Triangles& FaceCorners() const { return this->F; }
  Vector3 Position(int vertex) const { return this->V.row(vertex).transpose(); }

  static int Next(int halfedge) { return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1; }
  static int Previous(int halfedge) { return halfedge % 3 == 0 ? halfedge + 2 : halfedge - 1; }
  static int FaceOf(int halfedge) { return halfedge / 3; }
  int Tail(int halfedge) const { return this->F.data()[halfedge]; }
  int Head(int halfedge) const { return this->F.data()[Next(halfedge)]; }

  /// The halfedge on the other side, -1 on the boundary.
  int Twin(int halfedge) const { return this->Twins[halfedge]; }
  const std::vector<int>& HalfedgeTwins() const { return this->Twins; }

  /// A halfedge that leaves the vertex; on the boundary the one without a twin, so that
  /// h -> Twin(Previous(h)) visits the whole fan, counter-clockwise, from it.
  int OutgoingHalfedge(int vertex) const { return this->Outgoing[vertex]; }
  /// Calls visit(h) for the halfedges that leave the vertex with a face of the fan to their left, in that order.
  template <class Visit>
  void VisitFan(int vertex, const Visit& visit) const
  {
    const int first = this->OutgoingHalfedge(vertex);
    int h = first;
    do
    {
      visit(h);
      h = this->Twin(Previous(h));
    } while (h >= 0 && h != first);
  }
  /// visit(f) for the faces beyond the sides of a face, side by side.
  template <class Visit>
  void VisitNeighbours(int face, const Visit& visit) const
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      if (const int twin = this->Twin(h); twin >= 0)
      {
        visit(FaceOf(twin));
      }
    }
  }
  bool IsBoundaryVertex(int vertex) const { return this->Twins[this->Outgoing[vertex]] < 0; }

  /// {smaller, larger} vertex of an edge.
  std::array<int, 2> EdgeVertices(int edge) const
  {
    const auto [smaller, larger] =
      std::minmax({ this->Tail(this->HalfedgeOf(edge)), this->Head(this->HalfedgeOf(edge)) });
    return { smaller, larger };
  }
  int EdgeOf(int halfedge) const { return this->HalfedgeEdges[halfedge]; }
  /// +1 where the halfedge runs along its edge's orientation, else -1.
  int EdgeSign(int halfedge) const { return this->Tail(halfedge) < this->Head(halfedge) ? 1 : -1; }
  /// One halfedge of the edge: the one along its orientation where that exists, else the other.
  int HalfedgeOf(int edge) const { return this->EdgeHalfedges[edge]; }

  /// V - E + F.
  int EulerCharacteristic() const { return this->NumberOfVertices() - this->NumberOfEdges() + this->NumberOfFaces(); }

  /// Area-weighted normal, its length twice the area.
  Vector3 FaceAreaVector(int face) const;
  double FaceArea(int face) const { return 0.5 * this->FaceAreaVector(face).norm(); }
  Vector<double> FaceAreas(const ExecutionContext& context = SerialContext()) const;

private:
  /// Twins and edges.
  void JoinFaces(const ElementNames& names, const ExecutionContext& context);
  void StartFans(const ElementNames& names, const ExecutionContext& context);

  dmg::Points V;
  dmg::Triangles F;
  std::vector<int> Twins;         // per halfedge
  std::vector<int> Outgoing;      // per vertex
  std::vector<int> HalfedgeEdges; // per halfedge
  std::vector<int> EdgeHalfedges; // per edge
};

/// Connected component (by shared edges) of every face, numbered from 0 in order of first face.
std::vector<int> FaceComponents(const TriangleMesh& mesh);

}

#endif
