// Vertices that are added to an intrinsic triangulation.

#include "Geodesics/IntrinsicTriangulation.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

int IntrinsicTriangulation::AddedVertex::Now(int halfedge) const
{
  for (const auto& [from, to] : this->Renumbered)
  {
    if (halfedge >= 0 && halfedge == from)
    {
      return to;
    }
  }
  return halfedge;
}

Complex IntrinsicTriangulation::Apex(int halfedge) const
{
  const double length = this->Length(halfedge);
  const double toTail = this->Length(TriangleMesh::Previous(halfedge)),
               toHead = this->Length(TriangleMesh::Next(halfedge));
  const double x = 0.5 * (length + (toTail - toHead) * (toTail + toHead) / length);
  return { x, std::sqrt(std::max((toTail - x) * (toTail + x), 0.0)) };
}

void IntrinsicTriangulation::AddFaces(int number)
{
  const std::size_t size = this->Tails.size() + 3 * static_cast<std::size_t>(number);
  this->Tails.resize(size, -1);
  this->Twins.resize(size, -1);
  this->Lengths.resize(size, 0.0);
  this->Directions.resize(size, 0.0);
  if (!this->Held.empty())
  {
    this->Held.resize(size, 0);
  }
}

void IntrinsicTriangulation::Set(int halfedge, const Side& side)
{
  this->Tails[halfedge] = side.Tail;
  this->Lengths[halfedge] = side.Length;
  this->Directions[halfedge] = side.Direction;
}

void IntrinsicTriangulation::Join(int halfedge, int twin)
{
  this->Twins[halfedge] = twin;
  if (twin >= 0)
  {
    this->Twins[twin] = halfedge;
  }
}

void IntrinsicTriangulation::Move(int from, int to)
{
  this->Set(to, { this->Tails[from], this->Lengths[from], this->Directions[from] });
  this->Join(to, this->Twins[from]); // also where the twin has been moved before
  if (!this->Held.empty())
  {
    this->Held[to] = this->Held[from];
    this->Held[from] = 0;
  }
}

/// The faces abc and bad of the edge ab become amc, mbc, bmd and mad.
IntrinsicTriangulation::AddedVertex IntrinsicTriangulation::SplitEdge(int halfedge, double part, double turn)
{
  const int middle = this->NumberOfVertices(), twin = this->Twin(halfedge);
  const int first = this->NumberOfHalfedges();
  this->AddFaces(twin >= 0 ? 2 : 1);
  this->Stretches.push_back(1.0);
  const double length = this->Length(halfedge);
  AddedVertex added{ middle, { { { -1, -1 }, { -1, -1 } } } };
  // The side runs from 0 along the x axis in the plane of its face; the frame is turned by a half turn on the other side.
  const auto splitSide = [&](int side, double before, int rest, double turned)
  {
    const int next = TriangleMesh::Next(side), back = TriangleMesh::Previous(side), apex = this->Tail(back);
    const Complex tip = this->Apex(side), place = before;
    const double toTip = std::abs(tip - place);
    const double atApex = std::arg((place - tip) / -tip);
    this->Move(next, rest + 1);
    this->Set(rest, { middle, length - before, turned });
    this->Set(rest + 2, { apex, toTip, this->Direction(back) + this->Stretch(apex) * atApex });
    this->Set(next, { middle, toTip, turned + std::arg(tip - place) });
    this->Lengths[side] = before;
    this->Join(next, rest + 2);
    if (!this->Held.empty())
    {
      this->Held[rest] = this->Held[side];
    }
    added.Renumbered[rest == first ? 0 : 1] = { next, rest + 1 };
  };
  splitSide(halfedge, part * length, first, turn);
  if (twin >= 0)
  {
    splitSide(twin, length - part * length, first + 3, turn + Pi);
    this->Join(halfedge, first + 3);
    this->Join(twin, first);
  }
  return added;
}

/// The face abc becomes abm, bcm and cam.
IntrinsicTriangulation::AddedVertex IntrinsicTriangulation::SplitFace(int halfedge, Complex place, double turn)
{
  const int middle = this->NumberOfVertices(), first = this->NumberOfHalfedges();
  const int sides[] = { halfedge, TriangleMesh::Next(halfedge), TriangleMesh::Previous(halfedge) };
  const int now[] = { halfedge, first, first + 3 };
  const Complex corners[] = { 0.0, this->Length(halfedge), this->Apex(halfedge) };
  this->AddFaces(2);
  this->Stretches.push_back(1.0);
  std::array<Side, 3> inwards{}, outwards{};
  for (int k = 0; k < 3; ++k)
  {
    const Complex ray = place - corners[k];
    const int corner = this->Tail(sides[k]);
    const double atCorner = std::arg(ray / (corners[(k + 1) % 3] - corners[k]));
    inwards[k] = { corner, std::abs(ray), this->Direction(sides[k]) + this->Stretch(corner) * atCorner };
    outwards[k] = { middle, std::abs(ray), turn + std::arg(-ray) };
  }
  this->Move(sides[1], now[1]);
  this->Move(sides[2], now[2]);
  for (int k = 0; k < 3; ++k)
  {
    this->Set(TriangleMesh::Next(now[k]), inwards[(k + 1) % 3]);
    this->Set(TriangleMesh::Previous(now[k]), outwards[k]);
  }
  for (int k = 0; k < 3; ++k)
  {
    this->Join(TriangleMesh::Next(now[k]), TriangleMesh::Previous(now[(k + 1) % 3]));
  }
  return { middle, { { { sides[1], now[1] }, { sides[2], now[2] } } } };
}

}
