#include "Constraints/SegmentOnSurface.h"

#include "Constraints/CutSegment.h"

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

/// The cosine below which two normals are opposed; perpendicular ones are not.
constexpr double LeastAgainst = -1e-3;

/// The distance from an edge, relative to its length, below which a place is on it.
constexpr double OnEdge = 1e-6; // more than the rounding errors of coordinates in single precision

constexpr int MaximumDepth = 50; // beyond which parameters in double precision are too coarse

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

struct SegmentOnSurface::Crossing
{
  double Fraction; ///< of the way from one sample to the other
  double Distance; ///< from both faces
};

SegmentOnSurface::SegmentOnSurface(const NearestPlaces& nearest, double maximumDistance)
  : Nearest(nearest)
  , MaximumDistance(maximumDistance)
  , Rounding(1e-15 * (nearest.Sizes.Lower.norm() + nearest.Sizes.Upper.norm()))
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
  const NearestPlace fromB = this->Nearest.From(b.Place.Face, position, fromA.Face);
  return { parameter, fromB.Distance < fromA.Distance ? fromB : fromA };
}

/// An end that is as near to the face of the other end, since it stands at a vertex or over an edge, takes that face.
void SegmentOnSurface::TakeFaceOfOther(const Segment& segment, Sample& end, const Sample& other) const
{
  const int face = this->FaceOf(other);
  if (face < 0 || this->FaceOf(end) < 0 || face == end.Place.Face)
  {
    return;
  }
  const Vector3 position = segment.Start + end.Parameter * segment.Direction;
  const NearestPlace place = ClosestOnFace(this->Nearest.Surface.Mesh, face, position);
  if (place.Distance <= end.Place.Distance + this->Rounding)
  {
    end.Place = place;
  }
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
  const CutSegment cut = CutToSurface(start, end, this->Nearest.Sizes, this->MaximumDistance);
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

/// The parts of a segment that is near to the surface all along.
std::vector<SegmentPart> SegmentOnSurface::PartsOfNear(const Vector3& start, const Vector3& end) const
{
  std::vector<SegmentPart> parts;
  const double length = (end - start).norm();
  if (!(length > 0.0))
  {
    return parts;
  }
  const Segment segment{ start, end - start, length,
    std::min(SmallestOfSurface * this->Nearest.Sizes.Diagonal(), SmallestOfSegment * length) };
  const Sample first = this->At(segment, 0.0, -1), last = this->At(segment, 1.0, first.Place.Face);
  this->Split(segment, first, last, 0, parts);
  return this->OnSides(segment, first, last, parts);
}

void SegmentOnSurface::Split(
  const Segment& segment, Sample a, Sample b, int depth, std::vector<SegmentPart>& parts) const
{
  const double length = (b.Parameter - a.Parameter) * segment.Length;
  const auto append = [&](double fraction)
  {
    this->Append(parts, a, fraction * length);
    this->Append(parts, b, (1.0 - fraction) * length);
  };
  const bool isLast = depth >= MaximumDepth;
  const bool isStep =
    isLast || length <= std::max(this->Nearest.Sizes.MeanEdge, 0.5 * std::min(a.Place.Distance, b.Place.Distance));
  std::optional<Crossing> crossing;
  if (isStep)
  {
    this->TakeFaceOfOther(segment, a, b);
    this->TakeFaceOfOther(segment, b, a);
    if (this->FaceOf(a) == this->FaceOf(b) || length <= segment.Smallest || isLast)
    {
      append(0.5);
      return;
    }
    crossing = this->CrossingBetween(segment, a, b);
  }
  const double fraction = crossing ? crossing->Fraction : 0.5;
  const double parameter = a.Parameter + fraction * (b.Parameter - a.Parameter);
  const Sample middle = isStep ? this->Between(segment, a, b, parameter) : this->At(segment, parameter, a.Place.Face);
  if (crossing && middle.Place.Distance + this->Rounding >= crossing->Distance)
  {
    append(fraction); // no third face is nearer there
    return;
  }
  this->Split(segment, a, middle, depth + 1, parts);
  this->Split(segment, middle, b, depth + 1, parts);
}

/// The place of a segment that is as near to the face of one sample as to that of another one; nothing if one of them is too far.
///
/// Over a plane, the root of the difference of the squared distances is the distance from the edge between both, which is
/// linear. Its zero is found by the false position method, with the weights of Illinois (Dowell and Jarratt 1971).
std::optional<SegmentOnSurface::Crossing> SegmentOnSurface::CrossingBetween(
  const Segment& segment, const Sample& a, const Sample& b) const
{
  const int from = this->FaceOf(a), to = this->FaceOf(b);
  if (from < 0 || to < 0)
  {
    return std::nullopt;
  }
  Crossing crossing{ 0.0, 0.0 };
  const auto valueAt = [&](double fraction)
  {
    const double parameter = a.Parameter + fraction * (b.Parameter - a.Parameter);
    const Vector3 position = segment.Start + parameter * segment.Direction;
    const double fromA = ClosestOnFace(this->Nearest.Surface.Mesh, from, position).Distance;
    const double fromB = ClosestOnFace(this->Nearest.Surface.Mesh, to, position).Distance;
    crossing = { fraction, std::min(fromA, fromB) };
    const double difference = fromB - fromA;
    return std::abs(difference) <= this->Rounding
      ? 0.0
      : std::copysign(std::sqrt(std::abs(difference) * (fromA + fromB)), difference);
  };
  double lower = 0.0, upper = 1.0, atLower = valueAt(lower), atUpper = valueAt(upper);
  for (int side = 0; upper - lower > OnEdge;)
  {
    const double fraction = lower + atLower / (atLower - atUpper) * (upper - lower);
    const double value = valueAt(std::clamp(fraction, lower + 0.1 * OnEdge, upper - 0.1 * OnEdge));
    if (value == 0.0)
    {
      break;
    }
    (value > 0.0 ? lower : upper) = crossing.Fraction;
    (value > 0.0 ? atLower : atUpper) = value;
    const int newSide = value > 0.0 ? 1 : -1;
    (value > 0.0 ? atUpper : atLower) *= side == newSide ? 0.5 : 1.0;
    side = newSide;
  }
  return crossing;
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
/// \param place the nearest one, to which one walks from the face.
std::array<int, 2> SegmentOnSurface::FacesAt(int face, const Vector3& position, const Vector3& place) const
{
  if (face < 0)
  {
    return { -1, -1 };
  }
  const TriangleMesh& mesh = this->Nearest.Surface.Mesh;
  const auto distanceOf = [&](int other) { return (ClosestOnFace(mesh, other, position).Position - place).norm(); };
  const double distance = distanceOf(face);
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    const int beyond = mesh.Twin(h) < 0 ? -1 : TriangleMesh::FaceOf(mesh.Twin(h));
    const double length = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm();
    if (beyond >= 0 && distance <= OnEdge * length && distanceOf(beyond) <= OnEdge * length)
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
    const Sample inside = this->Between(segment, end, end, parameter);
    const Vector3 position = segment.Start + parameter * segment.Direction;
    return this->NormalOf(this->FacesAt(this->FaceOf(inside), position, inside.Place.Position));
  };
  const Vector3 atStart = normalAt(first, NearEnd), atEnd = normalAt(last, 1.0 - NearEnd);
  std::vector<SegmentPart> onSides;
  double before = 0.0;
  for (SegmentPart part : parts)
  {
    const double middle = (before + 0.5 * part.Length) / segment.Length;
    part.Start = segment.Start + before / segment.Length * segment.Direction;
    before += part.Length;
    part.End = segment.Start + before / segment.Length * segment.Direction;
    if (part.Length <= 2.0 * segment.Smallest)
    {
      continue;
    }
    const Vector3 position = segment.Start + middle * segment.Direction;
    const Vector3 place = part.Face < 0 ? position : this->Nearest.From(part.Face, position).Position;
    const auto faces = this->FacesAt(part.Face, position, place);
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
