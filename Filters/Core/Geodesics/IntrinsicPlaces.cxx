#include "Geodesics/IntrinsicPlaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{
namespace
{

/// Places whose distance from an edge is less, relative to its length, are on it.
constexpr double OnEdge = 1e-9;

double Cross(Complex a, Complex b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

/// A halfedge at a vertex, and the angle of a direction against it, within the corner of its face.
struct Sector
{
  int Halfedge = -1;
  double Angle = 0.0;
};

Sector SectorOf(const IntrinsicTriangulation& surface, int vertex, double direction)
{
  constexpr double Rounding = 1e-9, Full = 2.0 * Pi;
  Sector sector;
  double least = std::numeric_limits<double>::infinity();
  for (int h = 0; h < surface.NumberOfHalfedges(); ++h)
  {
    if (surface.Tail(h) != vertex)
    {
      continue;
    }
    const double from = std::fmod(std::fmod(direction - surface.Direction(h) + Rounding, Full) + Full, Full);
    const double corner = surface.CornerAngle(h), stretch = surface.Stretch(vertex);
    if (from - stretch * corner < least)
    {
      least = from - stretch * corner;
      sector = { h, std::clamp((from - Rounding) / stretch, 0.0, corner) };
    }
  }
  return sector;
}

}

IntrinsicPlace FindPlace(const IntrinsicTriangulation& surface, int vertex, double direction, double length)
{
  constexpr int MostCrossed = 100'000;
  const Sector sector = SectorOf(surface, vertex, direction);
  const Complex target = std::polar(length, sector.Angle);
  int h = sector.Halfedge;
  Complex tail = 0.0, head = surface.Length(h);
  for (int crossed = 0; crossed < MostCrossed; ++crossed)
  {
    const Complex apex = tail + (head - tail) / std::abs(head - tail) * surface.Apex(h);
    const bool isBeyondHead = crossed == 0 || Cross(target, apex) > 0.0; // where the way leaves the face
    const Complex sideTail = isBeyondHead ? head : apex, sideHead = isBeyondHead ? apex : tail;
    const int twin = surface.Twin(isBeyondHead ? TriangleMesh::Next(h) : TriangleMesh::Previous(h));
    if (twin < 0 || Cross(sideHead - sideTail, target - sideTail) >= 0.0)
    {
      break;
    }
    h = twin;
    tail = sideHead;
    head = sideTail;
  }
  const Complex along = (head - tail) / std::abs(head - tail);
  return { h, (target - tail) * std::conj(along), std::arg(along) - sector.Angle };
}

int AddVertex(const IntrinsicPlace& place, double direction, IntrinsicTriangulation& surface, bool& isHeld)
{
  const int h = place.Halfedge;
  const int sides[] = { h, TriangleMesh::Next(h), TriangleMesh::Previous(h) };
  const Complex corners[] = { 0.0, surface.Length(h), surface.Apex(h) };
  const double turn = place.Turn + direction;
  for (int k = 0; k < 3; ++k)
  {
    const Complex side = corners[(k + 1) % 3] - corners[k];
    const Complex onSide = (place.Point - corners[k]) / side;
    const bool hasOwnTwin =
      surface.Twin(sides[k]) >= 0 && TriangleMesh::FaceOf(surface.Twin(sides[k])) == TriangleMesh::FaceOf(h);
    if (onSide.imag() <= OnEdge && !hasOwnTwin)
    {
      isHeld = surface.IsHeld(sides[k]);
      return surface.SplitEdge(sides[k], std::clamp(onSide.real(), OnEdge, 1.0 - OnEdge), turn + std::arg(side)).Vertex;
    }
  }
  isHeld = false;
  return surface.SplitFace(h, place.Point, turn).Vertex;
}

}
