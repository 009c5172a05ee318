#include "Drawing/LineSpacing.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// The length of a side, over the distance between lines, from which a face is large.
constexpr double LargeFace = 8.0;

}

LineSpacing::LineSpacing(const UnfoldedSurface& surface, const DirectionsOnFaces& field, double distance)
  : Surface(surface)
  , Field(field)
  , Walk(surface)
  , StripWidth(distance)
  , Last(surface.Mesh().NumberOfFaces(), -1)
  , Covered(surface.Mesh().NumberOfFaces(), 0)
{
}

bool LineSpacing::IsLarge(int face) const
{
  const double square = LargeFace * LargeFace * this->StripWidth * this->StripWidth;
  const int h = 3 * face;
  const Complex origin = this->Surface.Corner(h);
  return std::norm(this->Surface.Corner(h + 1) - origin) > square ||
    std::norm(this->Surface.Corner(h + 2) - origin) > square;
}

std::uint64_t LineSpacing::StripOf(int face, int family, double offset) const
{
  // Strips of one face whose numbers differ by 2^24 share a list, which costs nothing but time.
  const auto strip = static_cast<std::int64_t>(std::floor(offset / this->StripWidth));
  const auto list = static_cast<std::uint64_t>(face) * DirectionsOnFaces::LargestN + static_cast<unsigned>(family);
  return list << 24 | (static_cast<std::uint64_t>(strip) & 0xffffffu);
}

int& LineSpacing::LastOf(const Segment& segment)
{
  if (segment.IsAlongEdge || !this->IsLarge(segment.Face))
  {
    return this->Last[segment.Face];
  }
  const int family = this->Field.NearestFamily(segment.Face, segment.Direction);
  const double offset = Cross(this->Field.Direction(segment.Face, family), segment.From);
  return this->Strips.emplace(this->StripOf(segment.Face, family, offset), -1).first->second;
}

void LineSpacing::Add(Segment segment)
{
  int& last = this->LastOf(segment);
  segment.Next = last;
  last = static_cast<int>(this->All.size());
  this->All.push_back(segment);
}

void LineSpacing::Shrink(std::size_t size)
{
  while (this->All.size() > size)
  {
    this->LastOf(this->All.back()) = this->All.back().Next;
    this->All.pop_back();
  }
}

template <class Visit>
bool LineSpacing::VisitList(
  int last, const SurfaceWalk::Placement& placement, Complex direction, double distance, const Visit& visit) const
{
  // Two families are as near as it gets where the direction lies between them; rounding must not lose it for both.
  const double cosine = this->Field.CosineOfFamily() - 1e-9;
  for (int i = last; i >= 0; i = this->All[i].Next)
  {
    const Segment& segment = this->All[i];
    if (std::abs(Dot(direction, placement.Turn * segment.Direction)) < cosine)
    {
      continue;
    }
    const double squaredGap = SquaredDistanceToSegment(placement.Place(segment.From), placement.Place(segment.To));
    if (squaredGap < distance * distance && !visit(segment, std::sqrt(squaredGap)))
    {
      return false;
    }
  }
  return true;
}

template <class Visit>
bool LineSpacing::VisitStrips(
  const SurfaceWalk::Placement& placement, Complex direction, double distance, const Visit& visit) const
{
  const Complex centre = -std::conj(placement.Turn) * placement.Origin; // of the walk
  for (int family = 0; family < this->Field.NumberOfFamilies(); ++family)
  {
    const double offset = Cross(this->Field.Direction(placement.Face, family), centre);
    // Half a strip of reserve for offsets that rounding moves across a border.
    const double end = offset + distance + 1.5 * this->StripWidth;
    for (double at = offset - distance - 0.5 * this->StripWidth; at < end; at += this->StripWidth)
    {
      const auto found = this->Strips.find(this->StripOf(placement.Face, family, at));
      if (found != this->Strips.end() && !this->VisitList(found->second, placement, direction, distance, visit))
      {
        return false;
      }
    }
  }
  return true;
}

template <class Visit>
void LineSpacing::VisitNear(const SurfacePoint& at, Complex direction, const double& distance, const Visit& visit)
{
  this->Walk.Around(at, distance,
    [&](const SurfaceWalk::Placement& placement)
    {
      const int last = this->Last[placement.Face];
      return this->VisitList(last, placement, direction, distance, visit) &&
        (this->Strips.empty() || !this->IsLarge(placement.Face) ||
          this->VisitStrips(placement, direction, distance, visit));
    });
}

LineSpacing::Neighbour LineSpacing::Nearest(
  const SurfacePoint& at, Complex direction, double distance, const Exclusion& exclusion)
{
  Neighbour nearest;
  double within = distance; // farther segments than the nearest so far are not looked for
  this->VisitNear(at, direction, within,
    [&](const Segment& segment, double gap)
    {
      const bool isExcluded = segment.Line == exclusion.Line &&
        std::min(std::abs(segment.ArcFrom - exclusion.Arc), std::abs(segment.ArcTo - exclusion.Arc)) < exclusion.Length;
      if (!isExcluded && gap < nearest.Distance)
      {
        nearest = { gap, segment.Line, segment.ArcFrom };
        within = gap;
      }
      return true;
    });
  return nearest;
}

bool LineSpacing::IsFree(const SurfacePoint& at, Complex direction, double distance)
{
  bool isFree = true;
  this->VisitNear(at, direction, distance,
    [&isFree](const Segment&, double)
    {
      isFree = false;
      return false;
    });
  return isFree;
}

void LineSpacing::Cover(const SurfacePoint& at, Complex direction, double distance)
{
  this->Walk.Around(at, distance,
    [&](const SurfaceWalk::Placement& placement)
    {
      const SurfacePoint centre = this->Surface.Centre(placement.Face);
      if (std::norm(placement.Place(centre.Point)) < distance * distance)
      {
        this->CoverFamily(
          placement.Face, this->Field.NearestFamily(placement.Face, std::conj(placement.Turn) * direction));
      }
      return true;
    });
}

void LineSpacing::CoverFamily(int face, int family)
{
  this->NumberCovered += !this->IsCovered(face, family);
  this->Covered[face] |= static_cast<unsigned char>(1 << family);
}

double LineSpacing::CoveredPart() const
{
  return static_cast<double>(this->NumberCovered) /
    (static_cast<double>(this->Covered.size()) * this->Field.NumberOfFamilies());
}

}
