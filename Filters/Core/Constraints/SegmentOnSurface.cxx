#include "Constraints/SegmentOnSurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

/// Parts shorter than this, relative to the surface and to the segment, are due to rounding.
constexpr double SmallestOfSurface = 1e-6;
constexpr double SmallestOfSegment = 1e-3;

/// A segment often starts on an edge, whose two faces are both nearest. So its ends are looked at
/// this far inside.
constexpr double NearEnd = 1e-3;

/// Normals that are perpendicular to each other are not against each other.
constexpr double LeastAgainst = -1e-3;

/// Relative to the edge.
constexpr double AtEdge = 1e-3;
constexpr double OnEdge = 1e-6; // more than the rounding errors of coordinates in single precision

constexpr int MaximumDepth = 50; // beyond which parameters in double precision are too coarse

/// The place of a segment where it crosses a side of a box.
Vector3 At(const Vector3& start, const Vector3& end, double parameter, int axis, double side)
{
  Vector3 place = (1.0 - parameter) * start + parameter * end;
  place[axis] = side;
  return place;
}

/// A segment without what lies outside of a box.
struct CutSegment
{
  Vector3 Start, End;
  double First = 0.0, Last = 1.0; ///< fractions of the whole
  bool IsAny = true;              ///< whether something is left
};

/// (Liang and Barsky 1984) Parameters of places near the start are accurate, however far the end is.
CutSegment CutFromStart(const Vector3& start, const Vector3& end, const Vector3& lower, const Vector3& upper)
{
  CutSegment cut{ start, end };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double along = end[axis] - start[axis];
    if (along == 0.0)
    {
      cut.IsAny &= start[axis] >= lower[axis] && start[axis] <= upper[axis];
      continue;
    }
    const double entrySide = along < 0.0 ? upper[axis] : lower[axis];
    const double exitSide = along < 0.0 ? lower[axis] : upper[axis];
    if (const double entry = (entrySide - start[axis]) / along; entry > cut.First)
    {
      cut.First = entry;
      cut.Start = At(start, end, entry, axis, entrySide);
    }
    if (const double exit = (exitSide - start[axis]) / along; exit < cut.Last)
    {
      cut.Last = exit;
      cut.End = At(start, end, exit, axis, exitSide);
    }
  }
  cut.IsAny &= cut.First < cut.Last;
  return cut;
}

CutSegment CutToBox(const Vector3& start, const Vector3& end, const Vector3& lower, const Vector3& upper)
{
  const Vector3 centre = 0.5 * lower + 0.5 * upper;
  if (!((end - centre).stableNorm() < (start - centre).stableNorm()))
  {
    return CutFromStart(start, end, lower, upper);
  }
  const CutSegment cut = CutFromStart(end, start, lower, upper);
  return { cut.End, cut.Start, 1.0 - cut.Last, 1.0 - cut.First, cut.IsAny };
}

}

//------------------------------------------------------------------------------
struct SegmentOnSurface::Segment
{
  Vector3 Start, Direction;
  double Length;
  double Smallest; ///< length that counts
};

struct SegmentOnSurface::Sample
{
  double Parameter; ///< in [0, 1]
  NearestPlace Place;
};

SegmentOnSurface::SegmentOnSurface(const NearestPlaces& nearest, double maximumDistance)
  : Nearest(nearest)
  , MaximumDistance(maximumDistance)
{
}

SegmentOnSurface::Sample SegmentOnSurface::At(const Segment& segment, double parameter, int near) const
{
  return { parameter, this->Nearest(segment.Start + parameter * segment.Direction, near) };
}

SegmentOnSurface::Sample SegmentOnSurface::Between(
  const Segment& segment, const Sample& a, const Sample& b, double parameter) const
{
  if (a.Place.Face < 0 || b.Place.Face < 0)
  {
    return this->At(segment, parameter, -1);
  }
  const Vector3 position = segment.Start + parameter * segment.Direction;
  const NearestPlace fromA = this->Nearest.From(a.Place.Face, position);
  const NearestPlace fromB = this->Nearest.From(b.Place.Face, position);
  return { parameter, fromB.Distance < fromA.Distance ? fromB : fromA };
}

int SegmentOnSurface::FaceOf(const Sample& sample) const
{
  return sample.Place.Distance <= this->MaximumDistance ? sample.Place.Face : -1;
}

std::vector<SegmentPart> SegmentOnSurface::PartsOf(const Vector3& start, const Vector3& end) const
{
  const double length = (end - start).stableNorm();
  if (!(length > 0.0))
  {
    return {};
  }
  const Vector3 margin = Vector3::Constant(this->MaximumDistance);
  const CutSegment cut = CutToBox(start, end, this->Nearest.Lower - margin, this->Nearest.Upper + margin);
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  const auto tooFar = [&](double fraction) {
    return SegmentPart{ SegmentPart::TooFar, -1, fraction * length, Infinity };
  };
  if (!cut.IsAny || !std::isfinite(length))
  {
    return { tooFar(1.0) };
  }
  std::vector<SegmentPart> parts = this->PartsOfNear(cut.Start, cut.End);
  if (cut.First > 0.0)
  {
    parts.insert(parts.begin(), tooFar(cut.First));
  }
  if (cut.Last < 1.0)
  {
    parts.push_back(tooFar(1.0 - cut.Last));
  }
  return parts;
}

/// The parts of a segment that is nowhere far.
std::vector<SegmentPart> SegmentOnSurface::PartsOfNear(const Vector3& start, const Vector3& end) const
{
  std::vector<SegmentPart> parts;
  const double length = (end - start).norm();
  if (!(length > 0.0))
  {
    return parts;
  }
  const Segment segment{ start, end - start, length,
    std::min(SmallestOfSurface * this->Nearest.Size, SmallestOfSegment * length) };
  const Sample first = this->At(segment, 0.0, -1), last = this->At(segment, 1.0, first.Place.Face);
  this->Split(segment, first, last, 0, parts);
  return this->OnSides(segment, first, last, parts);
}

void SegmentOnSurface::Split(
  const Segment& segment, const Sample& a, const Sample& b, int depth, std::vector<SegmentPart>& parts) const
{
  const double length = (b.Parameter - a.Parameter) * segment.Length;
  const double nearer = std::min(a.Place.Distance, b.Place.Distance);
  const bool isStep = length <= std::max(this->Nearest.MeanEdge, 0.5 * nearer) || depth >= MaximumDepth;
  if (isStep)
  {
    const bool isWhole = this->FaceOf(a) == this->FaceOf(b) || length <= segment.Smallest || depth >= MaximumDepth;
    const double crossing = isWhole ? 0.5 : this->Crossing(segment, a, b);
    if (crossing >= 0.0)
    {
      this->Append(parts, a, crossing * length);
      this->Append(parts, b, (1.0 - crossing) * length);
      return;
    }
  }
  const double parameter = 0.5 * (a.Parameter + b.Parameter);
  const Sample middle = isStep ? this->Between(segment, a, b, parameter) : this->At(segment, parameter, a.Place.Face);
  this->Split(segment, a, middle, depth + 1, parts);
  this->Split(segment, middle, b, depth + 1, parts);
}

/// The crossing of an edge by the path between two places on its two faces, as a fraction of the
/// way, in the plane into which both unfold; -1 where it does not, or there is no such edge, or the
/// place that is nearest there is another one, since the surface bends.
double SegmentOnSurface::Crossing(const Segment& segment, const Sample& a, const Sample& b) const
{
  const TriangleMesh& mesh = this->Nearest.Surface.Mesh;
  const int from = this->FaceOf(a), to = this->FaceOf(b);
  for (int h = 3 * from; from >= 0 && to >= 0 && h < 3 * from + 3; ++h)
  {
    const int twin = mesh.Twin(h);
    if (twin < 0 || TriangleMesh::FaceOf(twin) != to)
    {
      continue;
    }
    const Vector3 tail = mesh.Position(mesh.Tail(h));
    const Vector3 side = mesh.Position(mesh.Head(h)) - tail;
    const double length = side.norm();
    const Vector3 along = side / length;
    const Vector3 placeA = a.Place.Position - tail, placeB = b.Place.Position - tail;
    const double xOfA = along.dot(placeA), xOfB = along.dot(placeB);
    const double yOfA = (placeA - xOfA * along).norm(), yOfB = (placeB - xOfB * along).norm();
    // Both on the edge: either face will do.
    const double crossing = yOfA + yOfB > 0.0 ? yOfA / (yOfA + yOfB) : 0.5;
    const double x = xOfA + crossing * (xOfB - xOfA);
    if (length > 0.0 && x >= 0.0 && x <= length)
    {
      const double parameter = a.Parameter + crossing * (b.Parameter - a.Parameter);
      const Vector3 there = this->Between(segment, a, b, parameter).Place.Position - tail;
      if ((there - x * along).norm() <= AtEdge * length)
      {
        return crossing;
      }
    }
  }
  return -1.0;
}

/// Adds a part, or lengthens the last one if that is of the same face.
void SegmentOnSurface::Append(std::vector<SegmentPart>& parts, const Sample& sample, double length) const
{
  const int face = this->FaceOf(sample);
  if (parts.empty() || parts.back().Face != face)
  {
    parts.push_back({ face < 0 ? SegmentPart::TooFar : SegmentPart::OnSurface, face, 0.0, 0.0 });
  }
  parts.back().Length += length;
  parts.back().Distance = std::max(parts.back().Distance, sample.Place.Distance);
}

/// A face, and the one that is as near to a point since its nearest place is on the edge between them; else -1.
std::array<int, 2> SegmentOnSurface::FacesAt(int face, const Vector3& position) const
{
  if (face < 0)
  {
    return { -1, -1 };
  }
  const TriangleMesh& mesh = this->Nearest.Surface.Mesh;
  const Vector3 place = this->Nearest.From(face, position).Position;
  const auto isNearest = [&](int other, double length)
  { return (ClosestOnFace(mesh, other, position).Position - place).norm() <= OnEdge * length; };
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    const int beyond = mesh.Twin(h) < 0 ? -1 : TriangleMesh::FaceOf(mesh.Twin(h));
    const double length = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm();
    if (beyond >= 0 && isNearest(beyond, length) && isNearest(face, length))
    {
      return { face, beyond };
    }
  }
  return { face, -1 };
}

Vector3 SegmentOnSurface::NormalOf(const std::array<int, 2>& faces) const
{
  Vector3 sum = Vector3::Zero();
  for (const int face : faces)
  {
    sum += face < 0 ? Vector3(0.0, 0.0, 0.0) : this->Nearest.Surface.Faces.Normal(face);
  }
  return sum.normalized();
}

/// Leaves out small parts, shares those along an edge among its two faces, and marks those on the far side of a wall.
std::vector<SegmentPart> SegmentOnSurface::OnSides(
  const Segment& segment, const Sample& first, const Sample& last, const std::vector<SegmentPart>& parts) const
{
  const auto normalAt = [&](const Sample& end, double parameter)
  {
    const int face = this->FaceOf(this->Between(segment, end, end, parameter));
    return this->NormalOf(this->FacesAt(face, segment.Start + parameter * segment.Direction));
  };
  const Vector3 atStart = normalAt(first, NearEnd), atEnd = normalAt(last, 1.0 - NearEnd);
  std::vector<SegmentPart> onSides;
  double before = 0.0;
  for (SegmentPart part : parts)
  {
    const double middle = (before + 0.5 * part.Length) / segment.Length;
    before += part.Length;
    if (part.Length <= 2.0 * segment.Smallest)
    {
      continue;
    }
    const auto faces = this->FacesAt(part.Face, segment.Start + middle * segment.Direction);
    const Vector3 meant = (1.0 - middle) * atStart + middle * atEnd;
    if (part.Face >= 0 && this->NormalOf(faces).dot(meant) < LeastAgainst)
    {
      part.Kind = SegmentPart::OnFarSide;
    }
    if (faces[1] >= 0)
    {
      part.Length *= 0.5;
      onSides.push_back(part);
      part.Face = faces[1];
    }
    onSides.push_back(part);
  }
  return onSides;
}

}
