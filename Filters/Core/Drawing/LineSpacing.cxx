#include "Drawing/LineSpacing.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

LineSpacing::LineSpacing(const UnfoldedSurface& surface, const DirectionsOnFaces& field)
  : Surface(surface)
  , Field(field)
  , Walk(surface)
  , Last(surface.Mesh().NumberOfFaces(), -1)
  , Covered(surface.Mesh().NumberOfFaces(), 0)
{
}

void LineSpacing::Add(Segment segment)
{
  segment.Next = this->Last[segment.Face];
  this->Last[segment.Face] = static_cast<int>(this->All.size());
  this->All.push_back(segment);
}

void LineSpacing::Shrink(std::size_t size)
{
  while (this->All.size() > size)
  {
    this->Last[this->All.back().Face] = this->All.back().Next;
    this->All.pop_back();
  }
}

template <class Visit>
void LineSpacing::VisitNear(
  const SurfacePoint& at, Complex direction, double distance, const Visit& visit)
{
  // Two families are as near as it gets where the direction lies between them; rounding must not lose it for both.
  const double cosine = this->Field.CosineOfFamily() - 1e-9;
  this->Walk.Around(at, distance,
    [&](const SurfaceWalk::Placement& placement)
    {
      for (int i = this->Last[placement.Face]; i >= 0; i = this->All[i].Next)
      {
        const Segment& segment = this->All[i];
        if (std::abs(Dot(direction, placement.Turn * segment.Direction)) < cosine)
        {
          continue;
        }
        const double squaredGap =
          SquaredDistanceToSegment(placement.Place(segment.From), placement.Place(segment.To));
        if (squaredGap < distance * distance && !visit(segment, std::sqrt(squaredGap)))
        {
          return false;
        }
      }
      return true;
    });
}

LineSpacing::Neighbour LineSpacing::Nearest(
  const SurfacePoint& at, Complex direction, double distance, const Own& own)
{
  Neighbour nearest;
  this->VisitNear(at, direction, distance,
    [&](const Segment& segment, double gap)
    {
      const bool isExcluded = segment.Line == own.Line &&
        std::min(std::abs(segment.ArcFrom - own.Arc), std::abs(segment.ArcTo - own.Arc)) <
          own.Excluded;
      if (!isExcluded && gap < nearest.Distance)
      {
        nearest = { gap, segment.Line, segment.ArcFrom };
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
        this->CoverFamily(placement.Face,
          this->Field.NearestFamily(placement.Face, std::conj(placement.Turn) * direction));
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
