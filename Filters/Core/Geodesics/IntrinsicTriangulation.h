#ifndef dmgIntrinsicTriangulation_h
#define dmgIntrinsicTriangulation_h

#include "Mesh/VertexConnection.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

/// The intrinsic Delaunay triangulation of a surface: same vertices, same geometry, other edges (Bobenko and Springborn
/// 2007; Fisher et al. 2007). An edge is a straight line over the surface, which may cross faces of the mesh. On it no edge
/// inside the surface has a negative cotangent weight, however thin the faces of the mesh are, so that the Laplacian of
/// functions is an M-matrix.
///
/// Halfedges are numbered as those of TriangleMesh. Two vertices may have several edges between them, and an edge may run
/// from a vertex to itself. Directions count in VertexFrames, by the cone angles of VertexConnection; the direction of a
/// flipped edge is that of its neighbour plus the corner between them (signposts, Sharp, Soliman and Crane 2019).
///
/// All edges become longer by one number, about 1e-8 of their mean length, if a face has an angle of 0 or pi: then all areas
/// are positive (Sharp and Crane 2020).
class IntrinsicTriangulation
{
public:
  /// \param connection of the surface.
  /// Cost: O(#F), and constant time for each flip; real meshes take fewer flips than edges.
  /// \throw Cancelled
  IntrinsicTriangulation(
    const FramedMesh& surface, const VertexConnection& connection, const ExecutionContext& context = SerialContext());
  /// \param held edges of the mesh that stay, one entry per halfedge; the triangulation is Delaunay but for them.
  IntrinsicTriangulation(const FramedMesh& surface, const VertexConnection& connection, std::vector<char> held,
    const ExecutionContext& context = SerialContext());

  int NumberOfVertices() const { return static_cast<int>(this->Stretches.size()); }
  int NumberOfHalfedges() const { return static_cast<int>(this->Tails.size()); }
  int NumberOfFaces() const { return this->NumberOfHalfedges() / 3; }

  int Tail(int halfedge) const { return this->Tails[halfedge]; }
  int Head(int halfedge) const { return this->Tails[TriangleMesh::Next(halfedge)]; }
  /// The halfedge on the other side, -1 on the boundary.
  int Twin(int halfedge) const { return this->Twins[halfedge]; }
  double Length(int halfedge) const { return this->Lengths[halfedge]; }
  /// Whether the edge was to stay.
  bool IsHeld(int halfedge) const { return !this->Held.empty() && this->Held[halfedge] != 0; }

  /// The polar angle of a halfedge at its tail, in radians.
  double Direction(int halfedge) const { return this->Directions[halfedge]; }
  /// The polar angle at its head of the direction in which the halfedge arrives.
  double Arrival(int halfedge) const;
  /// An angle between directions at a vertex, over that on the surface: 2 pi over the cone angle, 1 on the boundary.
  double Stretch(int vertex) const { return this->Stretches[vertex]; }
  /// The angle at the tail of a halfedge in its face, not stretched.
  double CornerAngle(int halfedge) const;
  /// Carries directions along a halfedge, from the frame of its tail into that of its head; in radians, not reduced.
  double Transport(int halfedge) const { return this->Arrival(halfedge) - this->Direction(halfedge); }

  double Area(int face) const;
  /// Half the sum of the cotangents opposite to the edge of a halfedge, which is 0 or more. On the boundary a negative one is
  /// raised to 0.
  double Weight(int halfedge) const;

  /// Whether the two faces of an edge make a convex quadrilateral, so that it has another diagonal, and it is not held.
  bool HasOtherDiagonal(int halfedge) const;
  /// Takes the other diagonal. The halfedges of both faces are renumbered.
  /// \pre HasOtherDiagonal.
  /// \return the four sides of the two faces: ca, ad, db and bc for the halfedge from a to b.
  std::array<int, 4> Flip(int halfedge);

  /// A vertex that was added, and the halfedges that have other numbers since.
  struct AddedVertex
  {
    int Vertex;
    std::array<std::array<int, 2>, 2> Renumbered; ///< from the first to the second number; -1 where there is none

    /// The number of a former halfedge.
    int Now(int halfedge) const;
  };
  /// Adds a vertex on an edge, at a part of the way along a halfedge, which ends there now. The shape stays; edges may be no longer Delaunay.
  /// \param turn the direction of the halfedge in the frame of the vertex, in radians.
  /// \pre the edge has two faces, or is on the boundary; 0 < part < 1.
  AddedVertex SplitEdge(int halfedge, double part, double turn = 0.0);
  /// Adds a vertex in a face. \param place in the plane of the face, where a halfedge runs from 0 along the x axis. \pre it is inside.
  AddedVertex SplitFace(int halfedge, Complex place, double turn = 0.0);
  /// The third corner of the face of a halfedge, in that plane.
  Complex Apex(int halfedge) const;

private:
  struct Side
  {
    int Tail;
    double Length;
    double Direction;
  };
  void Set(int halfedge, const Side& side);
  void Join(int halfedge, int twin);
  void AddFaces(int number);
  /// A side takes another number.
  void Move(int from, int to);
  /// Four sides take each other's numbers, or free ones.
  void Permute(const std::array<int, 4>& from, const std::array<int, 4>& to);
  /// The length of the other diagonal of the two faces of an edge.
  double OtherDiagonal(int halfedge) const;
  void SetLengths(const TriangleMesh& mesh);
  void SetDirections(const TriangleMesh& mesh, const VertexConnection& connection);
  void MakeDelaunay(const ExecutionContext& context);
  bool IsDelaunay(int halfedge) const;
  double Cotangent(int halfedge) const;

  std::vector<int> Tails;
  std::vector<int> Twins;
  std::vector<double> Lengths;
  std::vector<double> Directions;
  std::vector<double> Stretches; // of angles, per vertex
  std::vector<char> Held;        // per halfedge; empty where no edge is
};

/// Calls visit(h) for one halfedge of each edge.
template <class Visit>
void VisitEdges(const IntrinsicTriangulation& surface, const Visit& visit)
{
  for (int h = 0; h < surface.NumberOfHalfedges(); ++h)
  {
    if (surface.Twin(h) < h)
    {
      visit(h);
    }
  }
}

}

#endif
