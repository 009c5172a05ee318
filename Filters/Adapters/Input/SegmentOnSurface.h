#ifndef dmgSegmentOnSurface_h
#define dmgSegmentOnSurface_h

#include "Adapters/Surface/MeshFromPolyData.h"

#include "vtkNew.h"

#include <array>
#include <limits>
#include <vector>

class vtkGenericCell;
class vtkStaticCellLocator;

namespace dmg
{

/// The place of a surface that is nearest to a point in space.
struct NearestPlace
{
  int Face = -1; ///< -1 where the square of the distance is too large for a number
  Vector3 Position = Vector3::Zero();
  double Distance = std::numeric_limits<double>::infinity();
};

/// Finds the nearest places of a surface. Not for several threads at a time.
class NearestPlaces
{
public:
  /// \param framed is referred to and has to live as long as this object.
  /// Cost: linear; the first place that is looked for builds a search structure.
  explicit NearestPlaces(const FramedSurface& framed);
  ~NearestPlaces();

  /// \pre position is finite. Cost: logarithmic near the surface; elsewhere it grows with the
  /// number of faces in a ball around the point.
  NearestPlace operator()(const Vector3& position) const;

  /// The place where walking over the surface, from a face, comes no nearer. Cost: a few triangles
  /// for each step.
  NearestPlace From(int face, const Vector3& position) const;

  const FramedSurface Framed;
  const double Size; ///< diagonal of the bounding box
  const double MeanEdge;

private:
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell; // what the locator writes to
};

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
  double Distance; ///< from the surface, the largest of its samples
};

/// The parts of a straight segment, from its start to its end.
///
/// Samples are no farther apart than the mean edge of the surface, or half of their distance from
/// it where that is more. Between two of them that are nearest to different faces the segment is
/// halved, over places to which one can walk from either, until the faces share an edge, and the
/// way between the nearest places crosses it. So a segment beside a plane has a part for each
/// triangle whose interior its projection crosses, however little, and for no other one.
///
/// A part that runs along an edge, or over a ridge, is nearest to both faces of the edge. Each of them has a part of half its length,
/// and its normal is the mean of theirs.
///
/// A thin wall has two sides, and a chord that cuts a corner may come out of the other one. The
/// normals of the faces that are nearest to both ends of the segment tell the side that is meant,
/// interpolated between them; a part on a face whose normal is against that one is OnFarSide.
///
/// Parts of less than a millionth of the surface's size, or a thousandth of the segment, are left
/// out: rounding makes them where a segment runs through a vertex or along an edge.
class SegmentOnSurface
{
public:
  /// \param maximumDistance in the unit of the points.
  SegmentOnSurface(const NearestPlaces& nearest, double maximumDistance);

  /// Nothing for a segment without length. \pre both ends are finite.
  /// Cost: for each part, or mean edge, some nearest places.
  std::vector<SegmentPart> PartsOf(const Vector3& start, const Vector3& end) const;

private:
  struct Sample;
  struct Segment;
  Sample At(const Segment& segment, double parameter) const;
  Sample Between(const Segment& segment, const Sample& a, const Sample& b, double parameter) const;
  int FaceOf(const Sample& sample) const; ///< -1 where it is too far
  void Split(
    const Segment& segment, const Sample& a, const Sample& b, int depth, std::vector<SegmentPart>& parts) const;
  double Crossing(const Segment& segment, const Sample& a, const Sample& b) const;
  void Append(std::vector<SegmentPart>& parts, const Sample& sample, double length) const;
  std::array<int, 2> FacesAt(int face, const Vector3& position) const;
  Vector3 NormalOf(const std::array<int, 2>& faces) const;
  std::vector<SegmentPart> OnSides(
    const Segment& segment, const Sample& first, const Sample& last, const std::vector<SegmentPart>& parts) const;

  const NearestPlaces& Nearest;
  double MaximumDistance;
};

}

#endif
