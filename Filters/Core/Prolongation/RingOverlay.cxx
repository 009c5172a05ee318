#include "Prolongation/RingOverlay.h"

#include <algorithm>

namespace dmg
{

namespace
{

bool IsInside(const std::array<Rational, 3>& weights)
{
  return CGAL::sign(weights[0]) >= 0 && CGAL::sign(weights[1]) >= 0 && CGAL::sign(weights[2]) >= 0;
}

}

RingOverlay::RingOverlay(const CollapseRecord& collapse)
  : Ring(collapse.Ring)
{
  const auto exact = [&](int vertex) {
    const Complex place = collapse.Plane[vertex];
    return PlaneVector(Rational(place.real()), Rational(place.imag()));
  };
  const PlaneVector hub = exact(this->Ring.HubIndex());
  for (int vertex = 0; vertex < this->Ring.NumberOfVertices(); ++vertex)
  {
    this->FromHub.push_back(exact(vertex) - hub);
  }
  for (int vertex : { this->Ring.RemovedIndex(), this->Ring.KeptIndex() })
  {
    const int sector = this->SectorAt(this->FromHub[vertex], PlaneVector(0, 0));
    if (sector < 0 || !IsInside(this->WeightsIn(sector, this->FromHub[vertex])))
    {
      this->FromHub[vertex] = PlaneVector(0, 0);
    }
  }
}

RingOverlay::Place RingOverlay::PlaceOf(int vertex) const
{
  const int sector = this->SectorAt(this->FromHub[vertex], PlaneVector(0, 0));
  return { sector, this->WeightsIn(sector, this->FromHub[vertex]) };
}

std::vector<RingOverlay::Piece> RingOverlay::PiecesOf(int from, int to) const
{
  std::vector<Piece> pieces;
  if (!this->Cut(this->FromHub[from], this->FromHub[to], pieces))
  {
    pieces.clear();
    this->Cut(this->FromHub[from], PlaneVector(0, 0), pieces);
    this->Cut(PlaneVector(0, 0), this->FromHub[to], pieces);
  }
  return pieces;
}

// The sector between whose spokes a point lies; of two, on a spoke, the one on the left of a direction
// along it; -1 where there is none.
int RingOverlay::SectorAt(const PlaneVector& point, const PlaneVector& direction) const
{
  int otherSide = -1;
  for (int k = 0; k < this->Ring.NumberOfSectors(); ++k)
  {
    const auto fromSpoke = CGAL::sign(CGAL::determinant(this->Spoke(k), point));
    const auto toNextSpoke = CGAL::sign(CGAL::determinant(point, this->NextSpoke(k)));
    if (fromSpoke < 0 || toNextSpoke < 0)
    {
      continue;
    }
    const bool isOnTheRight = (fromSpoke == 0 && CGAL::sign(this->Spoke(k) * direction) < 0) ||
      (toNextSpoke == 0 && CGAL::sign(this->NextSpoke(k) * direction) > 0);
    if (!isOnTheRight)
    {
      return k;
    }
    otherSide = k;
  }
  return otherSide;
}

std::array<Rational, 3> RingOverlay::WeightsIn(int sector, const PlaneVector& point) const
{
  const PlaneVector& a = this->Spoke(sector);
  const PlaneVector& b = this->NextSpoke(sector);
  const Rational area = CGAL::determinant(a, b);
  const Rational ofA = CGAL::determinant(point, b) / area;
  const Rational ofB = CGAL::determinant(a, point) / area;
  return { 1 - ofA - ofB, ofA, ofB };
}

// Parameters along a segment, 0 and 1 and those between at which it crosses spokes; ascending.
std::vector<Rational> RingOverlay::CutsOf(const PlaneVector& from, const PlaneVector& to) const
{
  std::vector<Rational> cuts = { 0, 1 };
  for (int k = 0; k < this->Ring.LoopSize(); ++k)
  {
    const Rational start = CGAL::determinant(this->Spoke(k), from);
    const Rational end = CGAL::determinant(this->Spoke(k), to);
    if (CGAL::sign(start) * CGAL::sign(end) < 0)
    {
      const Rational cut = start / (start - end);
      const PlaneVector crossing = from + cut * (to - from);
      if (CGAL::sign(this->Spoke(k) * crossing) >= 0)
      {
        cuts.push_back(cut);
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end()); // at the hub all spokes meet
  return cuts;
}

// Appends the pieces of a segment; false where it leaves the polygon.
bool RingOverlay::Cut(
  const PlaneVector& from, const PlaneVector& to, std::vector<Piece>& pieces) const
{
  const PlaneVector line = to - from;
  const std::vector<Rational> cuts = this->CutsOf(from, to);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    const PlaneVector middle = from + (cuts[i] + cuts[i + 1]) / 2 * line;
    const int sector = this->SectorAt(middle, line);
    if (sector < 0)
    {
      return false;
    }
    pieces.push_back({ sector, this->WeightsIn(sector, from + cuts[i] * line),
      this->WeightsIn(sector, from + cuts[i + 1] * line) });
    if (!IsInside(pieces.back().From) || !IsInside(pieces.back().To))
    {
      return false;
    }
  }
  return true;
}

}
