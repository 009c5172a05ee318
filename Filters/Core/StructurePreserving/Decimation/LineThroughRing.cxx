#include "StructurePreserving/Decimation/LineThroughRing.h"

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

double Cross(Complex a, Complex b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

double Dot(Complex a, Complex b)
{
  return a.real() * b.real() + a.imag() * b.imag();
}

/// The t in [0, 1] at which the line from \p from to \p to meets t \p spoke. Where the line has no
/// length or runs along the spoke, as boundary edges do that pass a corner, the nearest place.
double CrossingOfSpoke(Complex spoke, Complex from, Complex to)
{
  constexpr double tiny = 1e-8;
  const Complex line = to - from;
  const double slope = Cross(spoke, line);
  const double length = std::sqrt(std::norm(spoke));
  const bool isTransversal = std::abs(slope) > tiny * length * std::max(std::sqrt(std::norm(line)), tiny * length);
  const double t = isTransversal ? Cross(from, line) / slope : Dot(0.5 * (from + to), spoke) / (length * length);
  return std::clamp(t, 0.0, 1.0);
}

}

LineThroughRing::LineThroughRing(
  const OneRing& ring, const std::vector<Complex>& plane, const PlaceInRing& from, const PlaceInRing& to)
  : Ring(ring)
  , Plane(plane)
  , From(from.Place - plane[ring.HubIndex()])
  , To(to.Place - plane[ring.HubIndex()])
  , First(from.AtHub ? to.FirstSector : from.FirstSector)
{
  if (from.AtHub || to.AtHub || to.Touches(from.FirstSector))
  {
    return;
  }
  if (to.Touches(from.LastSector))
  {
    this->First = from.LastSector;
    return;
  }
  this->TurnAroundHub(from, to);
}

/// Chooses the side on which the line passes the hub, and the spokes that it crosses there.
void LineThroughRing::TurnAroundHub(const PlaceInRing& from, const PlaceInRing& to)
{
  const auto turns = [sectors = this->Ring.NumberOfSectors()](int a, int b)
  { return b >= a ? b - a : b - a + sectors; };
  const int left = turns(from.LastSector, to.FirstSector);  // counter-clockwise
  const int right = turns(to.LastSector, from.FirstSector); // clockwise
  const double turn = Cross(this->From, this->To);
  if (!this->Ring.IsClosed())
  {
    this->IsCounterClockwise = to.FirstSector > from.LastSector;
  }
  else if (turn * turn <= 1e-24 * (std::norm(this->From) * std::norm(this->To)))
  {
    this->IsCounterClockwise = left <= right; // the line passes the hub: the sign is rounding
  }
  else
  {
    this->IsCounterClockwise = turn > 0.0;
  }
  this->Crossings = this->IsCounterClockwise ? left : right;
  this->First = this->IsCounterClockwise ? from.LastSector : from.FirstSector;
}

LineThroughRing::Crossing LineThroughRing::LeaveSector(int sector) const
{
  const int sectors = this->Ring.NumberOfSectors();
  const int spoke = this->IsCounterClockwise ? this->Ring.NextOnLoop(sector) : sector;
  const double t = CrossingOfSpoke(this->Plane[spoke] - this->Plane[this->Ring.HubIndex()], this->From, this->To);
  const OneRing::Sector& left = this->Ring.Sectors[sector];
  if (this->IsCounterClockwise)
  {
    const int next = sector + 1 == sectors ? 0 : sector + 1;
    return { next, left.ReturningSpoke(), this->Ring.Sectors[next].LeavingSpoke(), 1.0 - t };
  }
  const int next = sector == 0 ? sectors - 1 : sector - 1;
  return { next, left.LeavingSpoke(), this->Ring.Sectors[next].ReturningSpoke(), t };
}

}
