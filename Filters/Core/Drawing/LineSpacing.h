#ifndef dmgLineSpacing_h
#define dmgLineSpacing_h

#include "Drawing/DirectionsOnFaces.h"
#include "Drawing/UnfoldedSurface.h"

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace dmg
{

/// The lines drawn so far, and how near they are: straight segments, listed by the face on which they lie and looked
/// for by walking over the surface.
///
/// Only lines that run nearly the same way count, those of one family (DirectionsOnFaces): the others may cross.
class LineSpacing
{
public:
  struct Segment
  {
    int Face;
    Complex From;
    Complex To;
    Complex Direction; ///< of the field, unit
    int Line;
    double ArcFrom; ///< signed length of the line from its seed
    double ArcTo;
    bool IsAlongEdge; ///< rather than along the direction
    int Next;         ///< the one that came to the same list before, or -1; set by Add
  };

  /// The part of the asking line that leads here: it does not count, although it is near.
  struct Exclusion
  {
    int Line = -1;
    double Arc = 0.0;
    double Length = 0.0; ///< along the line, both ways
  };

  struct Neighbour
  {
    double Distance = std::numeric_limits<double>::infinity();
    int Line = -1;
    double Arc = 0.0; ///< of its segment, where that is nearest to the seed
  };

  /// Borrows both.
  /// \param distance at which lines are looked for; on faces that are much larger, segments are sorted by it.
  LineSpacing(const UnfoldedSurface& surface, const DirectionsOnFaces& field, double distance);

  const std::vector<Segment>& Segments() const { return this->All; }
  void Add(Segment segment);
  /// Takes back all but the first segments.
  void Shrink(std::size_t size);

  /// The nearest segment of the family of a direction within a distance. Cost: the faces within it.
  Neighbour Nearest(const SurfacePoint& at, Complex direction, double distance, const Exclusion& exclusion);
  Neighbour Nearest(const SurfacePoint& at, Complex direction, double distance)
  {
    return this->Nearest(at, direction, distance, Exclusion());
  }
  /// Whether there is such a segment.
  bool IsFree(const SurfacePoint& at, Complex direction, double distance);

  /// Notes for all faces whose centre is within a distance that a line of this direction's family is near.
  void Cover(const SurfacePoint& at, Complex direction, double distance);
  void CoverFamily(int face, int family);
  bool IsCovered(int face, int family) const { return (this->Covered[face] >> family) & 1; }
  /// The share of the families of faces that are covered.
  double CoveredPart() const;

private:
  bool IsLarge(int face) const;
  std::uint64_t StripOf(int face, int family, double offset) const;
  /// The head of the list that a segment is in. There is a list per face, and one per strip of a large face.
  int& LastOf(const Segment& segment);
  /// Visits the segments of one list; \return whether visit wants more.
  template <class Visit>
  bool VisitList(
    int last, const SurfaceWalk::Placement& placement, Complex direction, double distance, const Visit& visit) const;
  template <class Visit>
  bool VisitStrips(
    const SurfaceWalk::Placement& placement, Complex direction, double distance, const Visit& visit) const;
  template <class Visit>
  void VisitNear(const SurfacePoint& at, Complex direction, const double& distance, const Visit& visit);

  const UnfoldedSurface& Surface;
  const DirectionsOnFaces& Field;
  SurfaceWalk Walk;
  const double StripWidth;
  std::vector<Segment> All;
  /// Lines of one family are parallel on a face: strips along them, each with its newest segment.
  std::unordered_map<std::uint64_t, int> Strips;
  std::vector<int> Last;              // per face: its newest segment, or -1
  std::vector<unsigned char> Covered; // per face: a bit per family
  long long NumberCovered = 0;
};

}

#endif
