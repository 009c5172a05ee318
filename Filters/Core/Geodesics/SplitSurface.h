#ifndef dmgSplitSurface_h
#define dmgSplitSurface_h

#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace dmg
{

/// A surface whose faces are split such that places on it become vertices and straight lines become edges. The shape stays: parts of a face
/// lie in its plane. Triangles become thin, which does the intrinsic Delaunay triangulation no harm.
///
/// Vertices of the surface keep their numbers; those of places follow.
class SplitSurface
{
public:
  /// Places that are nearer to a vertex or an edge move there, relative to the longest side of the face. Very short edges would cost digits of
  /// directions, and places that are given in single precision lie beside their vertex.
  static constexpr double Snap = 1e-5;

  /// Borrows the surface. Cost: O(#F).
  explicit SplitSurface(const FramedMesh& surface);

  /// \param place on the face.
  /// \return the vertex there.
  /// Cost: of the way there, from part to part of the face, from where it was split last.
  int AddPoint(int face, const Vector3& place);

  /// The side of a line that is inside.
  enum class InsideOfLine
  {
    Left,
    Right,
    Neither,
  };
  /// A line, by a number of its own (>= 0).
  struct Line
  {
    int Number;
    InsideOfLine Inside = InsideOfLine::Neither;

    Line Reversed() const;
  };
  /// The side of a line that is to the left of a halfedge.
  enum Sides : char
  {
    Unknown,
    Inside,
    Outside,
    Both, ///< lines contradict each other
  };

  /// Makes edges of the straight line between two vertices of the same face or of neighbours.
  /// \param face, nextFace where the vertices were added.
  /// \return false where the faces have no point in common.
  /// Cost: linear in the number of parts that the line crosses, and in the number of edges at its ends.
  bool AddLine(int from, int face, int to, int nextFace, const Line& line);
  /// Makes a halfedge of the surface a line.
  /// \pre no face is split yet.
  void AddLine(int halfedge, const Line& line);

  /// The number of the line that a halfedge is part of, and -1 for others.
  const std::vector<int>& Lines() const { return this->NumbersOfLines; }
  /// The side of its line that is to the left of a halfedge.
  Sides SideOf(int halfedge) const { return static_cast<Sides>(this->SidesOfLines[halfedge]); }
  /// The face of the surface that a part belongs to.
  int OriginOf(int part) const { return this->Faces[part]; }
  bool IsSplit() const { return static_cast<int>(this->Positions.size()) > this->Surface.Mesh.NumberOfVertices(); }

  /// The surface with the parts as faces; halfedges are numbered as here.
  FramedMesh Make(const ExecutionContext& context = SerialContext()) const;

private:
  /// A face with parts.
  struct FaceInParts
  {
    std::array<int, 3> Corners; ///< a halfedge from each corner, in one of its parts
    int Last;                   ///< the part that was made or found last
    int Count = 1;              ///< of parts
  };
  /// A step along an edge.
  struct Step
  {
    int Vertex;   ///< its end, -1 where there is none
    int Halfedge; ///< of the edge, in either direction
  };

  FaceInParts& About(int face);
  int& LeavingOf(int vertex, int face);
  int FirstAt(int vertex, int face);
  int NextAt(int halfedge, int first, int face) const;
  bool IsCorner(int vertex, int face) { return this->FirstAt(vertex, face) >= 0; }
  int FaceOf(int halfedge) const { return this->Faces[TriangleMesh::FaceOf(halfedge)]; }
  Complex InPlane(int face, const Vector3& position) const;
  Complex InPlane(int face, int vertex) const { return this->InPlane(face, this->Positions[vertex]); }
  double SizeOf(int face) const;
  int Head(int halfedge) const { return this->Tails[TriangleMesh::Next(halfedge)]; }
  int PartAt(int face, Complex point);
  std::vector<int> PartsNear(int part, Complex point, double distance) const;
  double DistanceInside(int face, int halfedge, Complex point) const;
  int AddFace(int part, int a, int b, int c);
  void Join(int halfedge, int twin);
  void MoveSide(int from, int to);
  int SplitFace(int part, const Vector3& place);
  int SplitEdge(int halfedge, const Vector3& place);
  bool Cut(int from, int to, int face, const Line& line);
  Step GoOn(int from, int to, int face);
  struct Strip;
  class PolygonFilling;
  int MakeEdge(Strip& strip, int from, int to);

  const FramedMesh& Surface;
  std::vector<Vector3> Positions;
  std::vector<int> Tails;                     // per halfedge
  std::vector<int> Twins;                     // per halfedge
  std::vector<int> NumbersOfLines;            // per halfedge
  std::vector<char> SidesOfLines;             // per halfedge
  std::vector<int> Faces;                     // of the surface, per part
  std::vector<int> Leaving;                   // a halfedge from each vertex that was added
  std::unordered_map<int, FaceInParts> Split; // faces that are split
};

}

#endif
