#ifndef dmgLineTracer_h
#define dmgLineTracer_h

#include "Drawing/DirectionsOnFaces.h"
#include "Drawing/UnfoldedSurface.h"

#include <cmath>

namespace dmg
{

/// Follows a direction of a field over a surface, exactly: the field is constant on each face, so a line is straight
/// there, and across an edge it goes on along the direction that turns least (principal matching).
///
/// A line runs along an edge to which the directions on both sides lead, as far as the end of the edge (the solution of Filippov,
/// Differential Equations with Discontinuous Righthand Sides, 1988). From there it goes into the face or edge around the vertex whose
/// direction leads away from it, the straightest one.
///
/// A line ends at the boundary, at a face without direction, in a vertex that is singular or from which no direction
/// leads away, and where the directions on both sides of an edge oppose each other.
class LineTracer
{
public:
  /// The part of a line in one face.
  struct Piece
  {
    int Face;
    Complex Direction; ///< of the field, unit
    Complex From;
    Complex To;       ///< on the border of the face
    int Halfedge;     ///< on which To lies
    double Part;      ///< of the way along it
    bool IsAlongEdge; ///< the piece is a part of that halfedge, and To one of its ends

    double Length() const { return std::sqrt(std::norm(this->To - this->From)); }
  };

  /// Borrows both.
  LineTracer(const UnfoldedSurface& surface, const DirectionsOnFaces& field)
    : Surface(surface)
    , Field(field)
  {
  }

  /// Begins inside a face, along direction k, or against it.
  /// \pre the face has a direction.
  void Start(const SurfacePoint& from, int k, bool against);

  const Piece& Current() const { return this->Now; }
  /// Goes on to the next piece; \return false where the line ends.
  bool Advance();

private:
  /// The direction of a face that turns least from another one; against the field where the line runs so.
  Complex Matched(int face, Complex direction) const;
  /// The piece through the inside of a face.
  void GoThrough(const SurfacePoint& from, Complex direction, int entry);
  bool CrossEdge();
  bool GoAlongEdge(int twin, Complex beyond);
  bool LeaveVertex();
  bool LeaveVertexFrom(int start, Complex direction);

  const UnfoldedSurface& Surface;
  const DirectionsOnFaces& Field;
  double Sign = 1.0;
  Piece Now{};
};

}

#endif
