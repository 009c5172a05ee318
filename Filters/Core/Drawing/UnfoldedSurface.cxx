#include "Drawing/UnfoldedSurface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;
// The limit of faces that one straight path crosses. Around a vertex or a spike it would go on without end.
constexpr int MostCrossed = 10'000;

}

double SquaredDistanceToSegment(Complex a, Complex b)
{
  const Complex way = b - a;
  const double length = std::norm(way);
  const double part = length > 0.0 ? std::clamp(-Dot(a, way) / length, 0.0, 1.0) : 0.0;
  return std::norm(a + part * way);
}

UnfoldedSurface::UnfoldedSurface(const TriangleMesh& mesh, const TangentFrames& frames, const ExecutionContext& context)
  : Surface(mesh)
  , FaceFrames(frames)
  , Corners(3 * mesh.NumberOfFaces())
  , Sides(SideDirections(mesh, frames, context))
{
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const int h = 3 * face;
        const Vector3 origin = mesh.Position(mesh.Tail(h));
        this->Corners[h] = 0.0;
        for (int k = 1; k < 3; ++k)
        {
          this->Corners[h + k] = frames.ToComplex(face, mesh.Position(mesh.Tail(h + k)) - origin);
        }
      }
    });
}

Complex UnfoldedSurface::Across(int halfedge) const
{
  return -this->Sides[this->Surface.Twin(halfedge)] * std::conj(this->Sides[halfedge]);
}

double UnfoldedSurface::AngleAt(int halfedge) const
{
  const double angle = std::arg(-this->Sides[TriangleMesh::Previous(halfedge)] * std::conj(this->Sides[halfedge]));
  // The angle is between 0 and pi; rounding may make -pi of a straight one.
  return angle < -0.5 * Pi ? angle + 2.0 * Pi : std::max(angle, 0.0);
}

SurfacePoint UnfoldedSurface::Centre(int face) const
{
  return { face, (this->Corners[3 * face] + this->Corners[3 * face + 1] + this->Corners[3 * face + 2]) / 3.0 };
}

Vector3 UnfoldedSurface::PositionAlong(int halfedge, double part) const
{
  return (1.0 - part) * this->Surface.Position(this->Surface.Tail(halfedge)) +
    part * this->Surface.Position(this->Surface.Head(halfedge));
}

UnfoldedSurface::Exit UnfoldedSurface::LeaveFace(const SurfacePoint& from, Complex direction, int entry) const
{
  // The ray leaves through the side whose tail is on its right and whose head is on its left.
  const auto height = [&](int h) { return Cross(direction, this->Corner(h) - from.Point); };
  int exit = 3 * from.Face;
  if (entry >= 0)
  {
    const int apex = TriangleMesh::Previous(entry);
    exit = height(apex) > 0.0 ? TriangleMesh::Next(entry) : apex;
  }
  else
  {
    // A point inside has such a side. Rounding may hide it in a face without area; then the widest side is taken.
    double widest = -1.0;
    for (int h = 3 * from.Face; h < 3 * from.Face + 3; ++h)
    {
      const double width = height(TriangleMesh::Next(h)) - height(h);
      const bool isAhead = height(h) <= 0.0 && height(TriangleMesh::Next(h)) > 0.0;
      if (width + (isAhead ? 1e300 : 0.0) > widest)
      {
        widest = width + (isAhead ? 1e300 : 0.0);
        exit = h;
      }
    }
  }
  return this->Meet(from, direction, exit);
}

UnfoldedSurface::Exit UnfoldedSurface::Meet(const SurfacePoint& from, Complex direction, int side) const
{
  const double right = Cross(direction, this->Corner(side) - from.Point);
  const double width = Cross(direction, this->CornerOfHead(side) - from.Point) - right;
  const double part = width > 0.0 ? -right / width : 0.5;
  return { side, std::clamp(part, 0.0, 1.0) };
}

bool UnfoldedSurface::GoStraight(
  SurfacePoint& from, Complex& direction, double length, std::vector<Vector3>* crossings) const
{
  int entry = -1;
  for (int crossed = 0; crossed < MostCrossed; ++crossed)
  {
    const Exit exit = this->LeaveFace(from, direction, entry);
    const double way = std::abs(this->PointAlong(exit.Halfedge, exit.Part) - from.Point);
    if (way >= length)
    {
      from.Point += length * direction;
      return true;
    }
    length -= way;
    if (crossings)
    {
      crossings->push_back(this->PositionAlong(exit.Halfedge, exit.Part));
    }
    entry = this->Surface.Twin(exit.Halfedge);
    if (entry < 0)
    {
      return false;
    }
    direction *= this->Across(exit.Halfedge);
    from = { TriangleMesh::FaceOf(entry), this->PointAlong(entry, 1.0 - exit.Part) };
  }
  return false;
}

void SurfaceWalk::Begin(const SurfacePoint& centre)
{
  ++this->Round;
  this->Queue.clear();
  this->Queue.push_back({ centre.Face, 1.0, -centre.Point });
  this->Rounds[centre.Face] = this->Round;
}

void SurfaceWalk::AddNeighbours(const Placement& placement, double squaredDistance)
{
  const int first = 3 * placement.Face;
  const Complex a = placement.Origin; // the first corner is at zero
  const Complex b = placement.Place(this->Surface.Corner(first + 1));
  const Complex c = placement.Place(this->Surface.Corner(first + 2));
  this->AddNeighbour(placement, first, a, b, squaredDistance);
  this->AddNeighbour(placement, first + 1, b, c, squaredDistance);
  this->AddNeighbour(placement, first + 2, c, a, squaredDistance);
}

void SurfaceWalk::AddNeighbour(
  const Placement& placement, int halfedge, Complex tail, Complex head, double squaredDistance)
{
  const int twin = this->Surface.Mesh().Twin(halfedge);
  if (twin < 0)
  {
    return;
  }
  const int face = TriangleMesh::FaceOf(twin);
  if (this->Rounds[face] == this->Round ||
    !(std::norm(head) < squaredDistance || SquaredDistanceToSegment(tail, head) < squaredDistance))
  {
    return;
  }
  this->Rounds[face] = this->Round;
  const Complex turn = placement.Turn * std::conj(this->Surface.Across(halfedge));
  this->Queue.push_back({ face, turn, head - turn * this->Surface.Corner(twin) });
}

}
