#include "Drawing/LineTracer.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{

namespace
{

/// A direction whose sine against an edge is below this is along it.
constexpr double Parallel = 1e-12;

/// A line that slides along an edge slower than this ends: directions on both sides oppose each other.
constexpr double Slowest = 1e-6;

/// A way from a vertex, through a face or along an edge.
struct WayOut
{
  int Halfedge;      ///< leaves the vertex: the edge, or the first side of the face
  Complex Direction; ///< of the field, in the face of the halfedge
  bool IsAlongEdge;
  double Angle; ///< around the vertex, from where the line came
};

/// The way that turns least; null where all lead back.
const WayOut* Straightest(const std::vector<WayOut>& ways, double straight)
{
  const WayOut* straightest = nullptr;
  double least = 0.9 * straight;
  for (const WayOut& way : ways)
  {
    const double turn = std::abs(way.Angle - straight);
    if (turn < least)
    {
      least = turn;
      straightest = &way;
    }
  }
  return straightest;
}

}

void LineTracer::Start(const SurfacePoint& from, int k, bool against)
{
  this->Sign = against ? -1.0 : 1.0;
  this->GoThrough(from, this->Sign * this->Field.Direction(from.Face, k), -1);
}

Complex LineTracer::Matched(int face, Complex direction) const
{
  const int k = this->Field.Nearest(face, this->Sign * direction);
  return this->Sign * this->Field.Direction(face, k);
}

void LineTracer::GoThrough(const SurfacePoint& from, Complex direction, int entry)
{
  const UnfoldedSurface::Exit exit = this->Surface.LeaveFace(from, direction, entry);
  this->Now = { from.Face, direction, from.Point, this->Surface.PointAlong(exit.Halfedge, exit.Part), exit.Halfedge,
    exit.Part, false };
}

bool LineTracer::Advance()
{
  return this->Now.IsAlongEdge ? this->LeaveVertex() : this->CrossEdge();
}

bool LineTracer::CrossEdge()
{
  const int h = this->Now.Halfedge;
  const int twin = this->Surface.Mesh().Twin(h);
  if (twin < 0 || !this->Field.HasDirection(TriangleMesh::FaceOf(twin)))
  {
    return false;
  }
  const int face = TriangleMesh::FaceOf(twin);
  const Complex beyond = this->Matched(face, this->Surface.Across(h) * this->Now.Direction);
  if (Cross(this->Surface.Side(twin), beyond) > Parallel)
  {
    this->GoThrough({ face, this->Surface.PointAlong(twin, 1.0 - this->Now.Part) }, beyond, twin);
    return true;
  }
  return this->GoAlongEdge(twin, beyond);
}

bool LineTracer::GoAlongEdge(int twin, Complex beyond)
{
  // The mean of both directions that leads along the edge, in terms of the halfedge.
  const int h = this->Now.Halfedge;
  const Complex here = std::conj(this->Surface.Side(h)) * this->Now.Direction;
  const Complex there = -std::conj(this->Surface.Side(twin)) * beyond;
  const double outwards = std::max(-here.imag(), 0.0);
  const double back = std::max(there.imag(), 0.0);
  const double sum = outwards + back;
  const double along = sum > 0.0 ? (back * here.real() + outwards * there.real()) / sum : here.real();
  if (std::abs(along) < Slowest)
  {
    return false;
  }
  const double end = along > 0.0 ? 1.0 : 0.0;
  this->Now.From = this->Now.To;
  this->Now.To = this->Surface.PointAlong(h, end);
  this->Now.Part = end;
  this->Now.IsAlongEdge = true;
  return true;
}

bool LineTracer::LeaveVertex()
{
  // The fan around the vertex is gone through counter-clockwise from the edge along which the line came.
  const TriangleMesh& mesh = this->Surface.Mesh();
  const int h = this->Now.Halfedge;
  const int twin = mesh.Twin(h);
  const bool isAtHead = this->Now.Part > 0.5;
  const int vertex = isAtHead ? mesh.Head(h) : mesh.Tail(h);
  if (mesh.IsBoundaryVertex(vertex) || twin < 0)
  {
    return false;
  }
  if (!isAtHead)
  {
    return this->LeaveVertexFrom(h, this->Now.Direction);
  }
  const Complex beyond = this->Matched(TriangleMesh::FaceOf(twin), this->Surface.Across(h) * this->Now.Direction);
  return this->LeaveVertexFrom(twin, beyond);
}

bool LineTracer::LeaveVertexFrom(int start, Complex direction)
{
  const TriangleMesh& mesh = this->Surface.Mesh();
  std::vector<WayOut> ways;
  const Complex first = direction;
  double angle = 0.0;
  double before = 0.0; // by how much the direction of the last face leads beyond its end
  int h = start;
  do
  {
    const double width = this->Surface.AngleAt(h);
    const double lead = std::arg(direction * std::conj(this->Surface.Side(h)));
    if (lead >= -Parallel && lead <= width + Parallel)
    {
      ways.push_back({ h, direction, false, angle + lead });
    }
    else if (before > 0.0 && before < 0.5 * Pi && lead < 0.0 && lead > -0.5 * Pi)
    {
      ways.push_back({ h, direction, true, angle });
    }
    before = lead - width;
    angle += width;
    const int side = TriangleMesh::Previous(h);
    h = mesh.Twin(side);
    if (!this->Field.HasDirection(TriangleMesh::FaceOf(h)))
    {
      return false;
    }
    direction = this->Matched(TriangleMesh::FaceOf(h), this->Surface.Across(side) * direction);
  } while (h != start);

  const bool isSingular = Dot(first, direction) < 1.0 - 1e-6;
  const WayOut* const way = Straightest(ways, 0.5 * angle);
  if (isSingular || !way)
  {
    return false;
  }
  const int face = TriangleMesh::FaceOf(way->Halfedge);
  const Complex corner = this->Surface.Corner(way->Halfedge);
  const UnfoldedSurface::Exit exit = way->IsAlongEdge
    ? UnfoldedSurface::Exit{ way->Halfedge, 1.0 }
    : this->Surface.Meet({ face, corner }, way->Direction, TriangleMesh::Next(way->Halfedge));
  this->Now = { face, way->Direction, corner, this->Surface.PointAlong(exit.Halfedge, exit.Part), exit.Halfedge,
    exit.Part, way->IsAlongEdge };
  return true;
}

}
