#include "StructurePreserving/Overlay/RingOverlay.h"

#include <algorithm>

namespace dmg
{

namespace
{

bool IsInside(const std::array<Rational, 3>& weights)
{
  return std::none_of(weights.begin(), weights.end(), [](const Rational& w) { return CGAL::sign(w) < 0; });
}

}

RingOverlay::RingOverlay(const CollapseRecord& collapse)
  : Ring(collapse.Ring)
{
  const int vertices = this->Ring.NumberOfVertices();
  const auto exact = [&](int vertex)
  {
    const Complex place = collapse.Plane[vertex];
    return PlaneVector(Rational(place.real()), Rational(place.imag()));
  };
  const PlaneVector hub = exact(this->Ring.HubIndex());
  for (int vertex = 0; vertex < vertices; ++vertex)
  {
    this->FromHub.push_back(exact(vertex) - hub);
  }
  for (int k = 0; k < this->Ring.LoopSize(); ++k)
  {
    for (int vertex = 0; vertex < vertices; ++vertex)
    {
      this->Areas.push_back(CGAL::determinant(this->FromHub[k], this->FromHub[vertex]));
    }
  }
  for (int vertex : { this->Ring.RemovedIndex(), this->Ring.TargetIndex() })
  {
    const int sector = this->SectorWith(vertex, vertex);
    if (sector < 0 || !IsInside(this->WeightsIn(sector, vertex)))
    {
      this->FromHub[vertex] = PlaneVector(0, 0);
      for (int k = 0; k < this->Ring.LoopSize(); ++k)
      {
        this->Areas[k * vertices + vertex] = 0;
      }
    }
  }
}

RingOverlay::Place RingOverlay::PlaceOf(int vertex) const
{
  const int sector = this->SectorWith(vertex, vertex);
  return { sector, this->WeightsIn(sector, vertex) };
}

std::vector<RingOverlay::Piece> RingOverlay::PiecesOf(int from, int to) const
{
  std::vector<Piece> pieces;
  if (this->PassesHub(from, to) || !this->Cut(from, to, pieces))
  {
    pieces.clear();
    this->Cut(from, this->Ring.HubIndex(), pieces);
    this->Cut(this->Ring.HubIndex(), to, pieces);
  }
  return pieces;
}

bool RingOverlay::PassesHub(int from, int to) const
{
  const PlaneVector& a = this->FromHub[from];
  const PlaneVector& b = this->FromHub[to];
  return CGAL::sign(a * b) < 0 && CGAL::sign(CGAL::determinant(a, b)) == 0;
}

// The sector between whose spokes both vertices lie; if they lie on one spoke, the sector on its
// left, seen from the first towards the second; -1 where there is none.
int RingOverlay::SectorWith(int from, int to) const
{
  const PlaneVector direction = this->FromHub[to] - this->FromHub[from];
  int otherSide = -1;
  for (int k = 0; k < this->Ring.NumberOfSectors(); ++k)
  {
    const int next = this->Ring.NextOnLoop(k);
    const auto fromSpoke = { CGAL::sign(this->Area(k, from)), CGAL::sign(this->Area(k, to)) };
    const auto fromNext = { CGAL::sign(this->Area(next, from)), CGAL::sign(this->Area(next, to)) };
    if (std::min(fromSpoke) < 0 || std::max(fromNext) > 0)
    {
      continue;
    }
    const bool isOnTheRight = (std::max(fromSpoke) == 0 && CGAL::sign(this->FromHub[k] * direction) < 0) ||
      (std::min(fromNext) == 0 && CGAL::sign(this->FromHub[next] * direction) > 0);
    if (!isOnTheRight)
    {
      return k;
    }
    otherSide = k;
  }
  return otherSide;
}

// The sector that follows or precedes a spoke, counter-clockwise. Beyond the ends of an open fan
// there is none, and the number is no sector's.
int RingOverlay::SectorBeside(int spoke, bool following) const
{
  const int preceding = spoke == 0 ? this->Ring.LoopSize() - 1 : spoke - 1;
  return following ? spoke : preceding;
}

std::array<Rational, 3> RingOverlay::WeightsIn(int sector, int vertex) const
{
  const int next = this->Ring.NextOnLoop(sector);
  const Rational& whole = this->Area(sector, next);
  const Rational first = -this->Area(next, vertex) / whole;
  const Rational second = this->Area(sector, vertex) / whole;
  return { 1 - first - second, first, second };
}

std::array<Rational, 3> RingOverlay::WeightsIn(int sector, const Crossing& crossing) const
{
  const Rational& u = crossing.AlongSpoke;
  return crossing.Spoke == sector ? std::array<Rational, 3>{ 1 - u, u, 0 } : std::array<Rational, 3>{ 1 - u, 0, u };
}

// The crossings come in the order of the edge.
std::vector<RingOverlay::Crossing> RingOverlay::CrossingsOf(int from, int to) const
{
  std::vector<Crossing> crossings;
  for (int k = 0; k < this->Ring.LoopSize(); ++k)
  {
    const Rational& start = this->Area(k, from);
    const Rational& end = this->Area(k, to);
    if (CGAL::sign(start) * CGAL::sign(end) >= 0)
    {
      continue;
    }
    const Rational across = end - start;
    const Rational alongSpoke = CGAL::determinant(this->FromHub[from], this->FromHub[to]) / across;
    if (CGAL::sign(alongSpoke) > 0)
    {
      crossings.push_back({ k, CGAL::sign(across) > 0, -start / across, alongSpoke });
    }
  }
  std::sort(
    crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.AlongEdge < b.AlongEdge; });
  return crossings;
}

// Appends the pieces of an edge that does not pass the hub; false where it leaves the polygon.
bool RingOverlay::Cut(int from, int to, std::vector<Piece>& pieces) const
{
  const auto isSector = [&](int k) { return k >= 0 && k < this->Ring.NumberOfSectors(); };
  const std::vector<Crossing> crossings = this->CrossingsOf(from, to);
  int sector = crossings.empty() ? this->SectorWith(from, to)
                                 : this->SectorBeside(crossings.front().Spoke, !crossings.front().CounterClockwise);
  if (!isSector(sector))
  {
    return false;
  }
  std::array<Rational, 3> start = this->WeightsIn(sector, from);
  for (const Crossing& crossing : crossings)
  {
    pieces.push_back({ sector, start, this->WeightsIn(sector, crossing) });
    sector = this->SectorBeside(crossing.Spoke, crossing.CounterClockwise);
    if (!isSector(sector))
    {
      return false;
    }
    start = this->WeightsIn(sector, crossing);
  }
  pieces.push_back({ sector, start, this->WeightsIn(sector, to) });
  return std::all_of(
    pieces.begin(), pieces.end(), [](const Piece& piece) { return IsInside(piece.From) && IsInside(piece.To); });
}

}
