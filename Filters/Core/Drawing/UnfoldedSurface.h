#ifndef dmgUnfoldedSurface_h
#define dmgUnfoldedSurface_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"
#include "Support/Unfilled.h"

#include <vector>

namespace dmg
{

/// Twice the signed area between two vectors: positive where b is to the left of a.
inline double Cross(Complex a, Complex b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

inline double Dot(Complex a, Complex b)
{
  return a.real() * b.real() + a.imag() * b.imag();
}

/// The squared distance of the origin from the segment between two points, which may coincide.
double SquaredDistanceToSegment(Complex a, Complex b);

/// A place on the surface: a point of a face, in its frame, from its first corner.
struct SurfacePoint
{
  int Face;
  Complex Point;
};

/// The faces of a surface as triangles of the plane, each in its own frame with its first corner at zero, and how
/// directions go on from one to the next: lines are drawn in the plane, and no face is ever left.
///
/// Frames are FaceFrames. Faces without area are segments, or nearly so; nothing here divides by an area.
class UnfoldedSurface
{
public:
  /// Borrows the mesh and its FaceFrames. Cost: O(#F).
  UnfoldedSurface(
    const TriangleMesh& mesh, const TangentFrames& frames, const ExecutionContext& context = SerialContext());

  const TriangleMesh& Mesh() const { return this->Surface; }
  const TangentFrames& Frames() const { return this->FaceFrames; }

  /// The tail of a halfedge, in the frame of its face.
  Complex Corner(int halfedge) const { return this->Corners[halfedge]; }
  Complex CornerOfHead(int halfedge) const { return this->Corners[TriangleMesh::Next(halfedge)]; }
  /// The unit direction of a halfedge, also of one without length (SideDirections).
  Complex Side(int halfedge) const { return this->Sides[halfedge]; }
  /// A direction of the face of a halfedge becomes Across times itself in the face of its twin, unfolded.
  /// \pre the halfedge has a twin.
  Complex Across(int halfedge) const;
  /// Between the sides at the tail of a halfedge, in [0, pi]; the three of a face sum to pi.
  double AngleAt(int halfedge) const;

  /// The point at a part of the way along a halfedge.
  Complex PointAlong(int halfedge, double part) const
  {
    const Complex tail = this->Corner(halfedge);
    return tail + part * (this->CornerOfHead(halfedge) - tail);
  }
  SurfacePoint Centre(int face) const;

  /// The place in space of a point of a face.
  Vector3 Position(int face, Complex point) const
  {
    return this->Surface.Position(this->Surface.Tail(3 * face)) +
      this->FaceFrames.ToVector(face, point - this->Corner(3 * face));
  }
  /// The place in space of a point on a side.
  Vector3 PositionAlong(int halfedge, double part) const;

  /// The side through which a ray leaves its face, and where.
  struct Exit
  {
    int Halfedge;
    double Part; ///< of the way along it, in [0, 1]
  };
  /// \param entry the side on which the point lies, from which the ray leads inwards; -1 for a point inside the face.
  Exit LeaveFace(const SurfacePoint& from, Complex direction, int entry) const;

  /// The intersection of a ray with a side of its face.
  Exit Meet(const SurfacePoint& from, Complex direction, int side) const;

  /// Goes straight on for a length, unfolding face after face.
  /// \param direction unit; is turned into the frame of the last face.
  /// \param crossings receives the places on sides that are crossed; may be null.
  /// \return false where it meets the boundary before, or has crossed 10,000 triangles, as around a vertex or a spike.
  bool GoStraight(
    SurfacePoint& from, Complex& direction, double length, std::vector<Vector3>* crossings = nullptr) const;

private:
  const TriangleMesh& Surface;
  const TangentFrames& FaceFrames;
  Unfilled<Complex> Corners; // per halfedge
  Unfilled<Complex> Sides;   // per halfedge
};

/// Visits the faces around a point in the order in which they are reached across edges, each laid out in the plane
/// of the first one. So what is near is near on the surface: the other side of a thin plate is as far away as the
/// way around its rim. Where the surface is curved the layout depends on the way; each face has the first one.
class SurfaceWalk
{
public:
  /// The place of a face in the plane of the walk: its point z lies at Turn z + Origin.
  struct Placement
  {
    int Face;
    Complex Turn; ///< unit
    Complex Origin;

    Complex Place(Complex point) const { return this->Turn * point + this->Origin; }
  };

  /// Borrows the surface. One walk at a time.
  explicit SurfaceWalk(const UnfoldedSurface& surface)
    : Surface(surface)
    , Rounds(surface.Mesh().NumberOfFaces(), 0)
  {
  }

  /// Calls visit(placement) for the face of a point and those that have a point within a distance of it; a walk ends
  /// where visit returns false. Cost: O(faces visited).
  /// \param distance may become smaller on the way.
  template <class Visit>
  void Around(const SurfacePoint& centre, const double& distance, const Visit& visit)
  {
    this->Begin(centre);
    for (std::size_t next = 0; next < this->Queue.size(); ++next)
    {
      const Placement placement = this->Queue[next];
      if (!visit(placement))
      {
        return;
      }
      this->AddNeighbours(placement, distance * distance);
    }
  }

private:
  void Begin(const SurfacePoint& centre);
  void AddNeighbours(const Placement& placement, double squaredDistance);
  /// \param tail, head the ends of the halfedge in the plane of the walk.
  void AddNeighbour(const Placement& placement, int halfedge, Complex tail, Complex head, double squaredDistance);

  const UnfoldedSurface& Surface;
  std::vector<int> Rounds; // per face: the last walk that came there
  int Round = 0;
  std::vector<Placement> Queue;
};

}

#endif
