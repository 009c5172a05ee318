#ifndef dmgSegmentOnSurface_h
#define dmgSegmentOnSurface_h

#include "Places/NearestPlaces.h"

#include <array>
#include <optional>
#include <vector>

namespace dmg
{

/// A part of a segment in space whose points are nearest to one face.
struct SegmentPart
{
  enum Kinds
  {
    OnSurface,
    TooFar,    ///< farther than the maximum distance; Face is -1
    OnFarSide, ///< nearest to a face that is turned away from those at the ends of the segment
  };
  Kinds Kind;
  int Face;
  double Length;
  double Distance; ///< from the surface, the largest of its samples; infinite where nobody has looked
  /// Ends of the part in space. Not set for parts that are TooFar.
  Vector3 Start = Vector3::Zero(), End = Vector3::Zero();
};

/// The parts of a straight segment, from its start to its end.
///
/// Samples are no farther apart than the mean edge of the surface, or half of their distance from
/// it where that is more. Between two of them that are nearest to different faces the segment is
/// parted where it is as near to the one as to the other. Where a third face is nearer there, to which one
/// can walk from either, it is parted again. So a segment beside a plane has a part for each
/// triangle whose interior its projection crosses, however little, and for no other one.
///
/// A part that runs along an edge, or over a ridge, is nearest to both faces of the edge. Each of them has a part of half its length,
/// and its normal is the mean of theirs.
///
/// A thin wall has two sides, and a chord that cuts a corner may come out of the other one. The
/// normals of the faces that are nearest to both ends of the segment tell the side that is meant,
/// interpolated between them; a part on a face whose normal is against that one is OnFarSide.
///
/// A segment is first cut to the box around the surface, widened by the maximum distance: where it ends far away does not
/// matter.
///
/// Parts of less than a millionth of the surface's size, or a thousandth of the segment, are left
/// out: rounding makes them where a segment runs through a vertex or along an edge.
class SegmentOnSurface
{
public:
  /// \param maximumDistance in the unit of the points.
  SegmentOnSurface(const NearestPlaces& nearest, double maximumDistance);

  /// Several threads may ask at a time. Nothing for a segment without length.
  /// \pre both ends are finite.
  /// Cost: for each part, or mean edge, some nearest places.
  std::vector<SegmentPart> PartsOf(const Vector3& start, const Vector3& end) const;

private:
  struct Sample;
  struct Segment;
  struct Crossing;
  std::vector<SegmentPart> PartsOfNear(const Vector3& start, const Vector3& end) const;
  Sample At(const Segment& segment, double parameter, int near) const;
  Sample Between(const Segment& segment, const Sample& a, const Sample& b, double parameter) const;
  void TakeFaceOfOther(const Segment& segment, Sample& end, const Sample& other) const;
  int FaceOf(const Sample& sample) const; ///< -1 where it is too far
  void Split(const Segment& segment, Sample a, Sample b, int depth, std::vector<SegmentPart>& parts) const;
  std::optional<Crossing> CrossingBetween(const Segment& segment, const Sample& a, const Sample& b) const;
  void Append(std::vector<SegmentPart>& parts, const Sample& sample, double length) const;
  std::array<int, 2> FacesAt(int face, const Vector3& position, const Vector3& place) const;
  Vector3 NormalOf(const std::array<int, 2>& faces) const;
  std::vector<SegmentPart> OnSides(
    const Segment& segment, const Sample& first, const Sample& last, const std::vector<SegmentPart>& parts) const;

  const NearestPlaces& Nearest;
  double MaximumDistance;
  double Rounding; ///< of distances
};

}

#endif
