#include "Geodesics/SplitSurface.h"

#include "Drawing/UnfoldedSurface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

int Next(int halfedge)
{
  return TriangleMesh::Next(halfedge);
}

int Previous(int halfedge)
{
  return TriangleMesh::Previous(halfedge);
}

}

SplitSurface::SplitSurface(const FramedMesh& surface)
  : Surface(surface)
  , Twins(surface.Mesh.HalfedgeTwins())
  , NumbersOfLines(this->Twins.size(), -1)
  , SidesOfLines(this->Twins.size(), Unknown)
  , Faces(surface.Mesh.NumberOfFaces())
{
  const TriangleMesh& mesh = surface.Mesh;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    this->Positions.push_back(mesh.Position(vertex));
  }
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    this->Tails.push_back(mesh.Tail(h));
    this->Faces[TriangleMesh::FaceOf(h)] = TriangleMesh::FaceOf(h);
  }
}

SplitSurface::FaceInParts& SplitSurface::About(int face)
{
  const int first = 3 * face;
  return this->Split.try_emplace(face, FaceInParts{ { first, first + 1, first + 2 }, face }).first->second;
}

/// The halfedge from which the parts of a face around a vertex are visited; that of an added vertex may be in a neighbour of the face.
/// \pre it is a corner of the face, or was added.
int& SplitSurface::LeavingOf(int vertex, int face)
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  if (vertex >= mesh.NumberOfVertices())
  {
    return this->Leaving[vertex - mesh.NumberOfVertices()];
  }
  const int side = mesh.Tail(3 * face) == vertex ? 0 : mesh.Tail(3 * face + 1) == vertex ? 1 : 2;
  return this->About(face).Corners[side];
}

/// The first halfedge that leaves a vertex in parts of a face, counter-clockwise; -1 where the vertex is no corner of them.
int SplitSurface::FirstAt(int vertex, int face)
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  const bool isAdded = vertex >= mesh.NumberOfVertices();
  if (!isAdded && mesh.Tail(3 * face) != vertex && mesh.Tail(3 * face + 1) != vertex &&
    mesh.Tail(3 * face + 2) != vertex)
  {
    return -1;
  }
  const int start = this->LeavingOf(vertex, face);
  int first = this->FaceOf(start) == face ? start : -1;
  const auto previous = [this](int h) { return this->Twins[h] < 0 ? -1 : Next(this->Twins[h]); };
  for (int h = previous(start); h >= 0 && h != start && (isAdded || this->FaceOf(h) == face); h = previous(h))
  {
    if (this->FaceOf(h) == face)
    {
      first = h;
    }
    else if (first >= 0)
    {
      return first;
    }
  }
  return first;
}

/// The next halfedge that leaves a vertex in parts of a face, counter-clockwise; -1 after the last one.
int SplitSurface::NextAt(int halfedge, int first, int face) const
{
  const int next = this->Twins[Previous(halfedge)];
  return next < 0 || next == first || this->FaceOf(next) != face ? -1 : next;
}

Complex SplitSurface::InPlane(int face, const Vector3& position) const
{
  return this->Surface.Faces.ToComplex(face, position - this->Surface.Mesh.Position(this->Surface.Mesh.Tail(3 * face)));
}

double SplitSurface::SizeOf(int face) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  double longest = 0.0;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    longest = std::max(longest, (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm());
  }
  return longest;
}

int SplitSurface::AddPoint(int face, const Vector3& place)
{
  const Complex point = this->InPlane(face, place);
  const double snap = Snap * this->SizeOf(face);
  const int around = this->PartAt(face, point);
  const std::vector<int> parts = this->PartsNear(around, point, snap);
  for (const int part : parts)
  {
    for (int h = 3 * part; h < 3 * part + 3; ++h)
    {
      if (std::abs(this->InPlane(face, this->Tails[h]) - point) <= snap)
      {
        return this->Tails[h];
      }
    }
  }
  for (int h = 3 * around; h < 3 * around + 3; ++h)
  {
    const Complex tail = this->InPlane(face, this->Tails[h]) - point;
    if (SquaredDistanceToSegment(tail, this->InPlane(face, this->Head(h)) - point) <= snap * snap)
    {
      return this->SplitEdge(h, place);
    }
  }
  return this->SplitFace(around, place);
}

/// The distance of a point from a halfedge, positive to its left.
double SplitSurface::DistanceInside(int face, int halfedge, Complex point) const
{
  const Complex tail = this->InPlane(face, this->Tails[halfedge]) - point;
  const Complex head = this->InPlane(face, this->Head(halfedge)) - point;
  return Cross(tail, head) / std::abs(head - tail);
}

/// The part of a face in which a point lies, or at the side of which it lies, beside the face: straight on from the last one. Each vertex is to
/// the left or to the right of the way, so that rounding does not lead astray.
int SplitSurface::PartAt(int face, Complex point)
{
  FaceInParts& about = this->About(face);
  int part = about.Last;
  Complex start = 0.0;
  for (int h = 3 * part; h < 3 * part + 3; ++h)
  {
    start += this->InPlane(face, this->Tails[h]) / 3.0;
  }
  const Complex way = point - start;
  const auto isLeft = [&](int vertex) { return Cross(way, this->InPlane(face, vertex) - start) > 0.0; };
  for (int step = 0; step < about.Count; ++step)
  {
    int exit = -1;
    for (int h = 3 * part; h < 3 * part + 3; ++h)
    {
      const bool isCrossed = !isLeft(this->Tails[h]) && isLeft(this->Head(h));
      exit = isCrossed && this->DistanceInside(face, h, point) < 0.0 ? h : exit;
    }
    const int twin = exit < 0 ? -1 : this->Twins[exit];
    if (twin < 0 || this->FaceOf(twin) != face)
    {
      break;
    }
    part = TriangleMesh::FaceOf(twin);
  }
  about.Last = part;
  return part;
}

/// A part, and those of its face that are no farther than a distance from a point in it.
std::vector<int> SplitSurface::PartsNear(int part, Complex point, double distance) const
{
  std::vector<int> parts = { part };
  const int face = this->Faces[part];
  for (std::size_t next = 0; next < parts.size(); ++next)
  {
    for (int h = 3 * parts[next]; h < 3 * parts[next] + 3; ++h)
    {
      const int twin = this->Twins[h];
      const Complex tail = this->InPlane(face, this->Tails[h]) - point;
      if (twin >= 0 && this->FaceOf(twin) == face &&
        SquaredDistanceToSegment(tail, this->InPlane(face, this->Head(h)) - point) <= distance * distance &&
        std::find(parts.begin(), parts.end(), TriangleMesh::FaceOf(twin)) == parts.end())
      {
        parts.push_back(TriangleMesh::FaceOf(twin));
      }
    }
  }
  return parts;
}

int SplitSurface::AddFace(int part, int a, int b, int c)
{
  const int added = static_cast<int>(this->Faces.size());
  const int face = this->Faces[part];
  FaceInParts& about = this->About(face);
  about.Last = added;
  ++about.Count;
  this->Faces.push_back(face);
  this->Tails.insert(this->Tails.end(), { a, b, c });
  this->Twins.insert(this->Twins.end(), { -1, -1, -1 });
  this->NumbersOfLines.insert(this->NumbersOfLines.end(), { -1, -1, -1 });
  this->SidesOfLines.insert(this->SidesOfLines.end(), { Unknown, Unknown, Unknown });
  return added;
}

void SplitSurface::Join(int halfedge, int twin)
{
  this->Twins[halfedge] = twin;
  if (twin >= 0)
  {
    this->Twins[twin] = halfedge;
  }
}

/// A halfedge becomes what another one was.
void SplitSurface::MoveSide(int from, int to)
{
  this->Join(to, this->Twins[from]);
  this->NumbersOfLines[to] = std::exchange(this->NumbersOfLines[from], -1);
  this->SidesOfLines[to] = std::exchange(this->SidesOfLines[from], Unknown);
}

/// The part abc becomes abm, bcm and cam.
int SplitSurface::SplitFace(int part, const Vector3& place)
{
  const int middle = static_cast<int>(this->Positions.size());
  this->Positions.push_back(place);
  const int h = 3 * part, a = this->Tails[h], b = this->Tails[h + 1], c = this->Tails[h + 2];
  const int second = 3 * this->AddFace(part, b, c, middle), third = 3 * this->AddFace(part, c, a, middle);
  int& leaving = this->LeavingOf(c, this->Faces[part]);
  leaving = leaving == h + 2 ? third : leaving;
  this->Leaving.push_back(h + 2);
  this->MoveSide(h + 1, second);
  this->MoveSide(h + 2, third);
  this->Tails[h + 2] = middle;
  this->Join(h + 1, second + 2);
  this->Join(second + 1, third + 2);
  this->Join(third + 1, h + 2);
  return middle;
}

/// The parts abc and bad of the edge ab become amc, mbc, bmd and mad.
int SplitSurface::SplitEdge(int halfedge, const Vector3& place)
{
  const int middle = static_cast<int>(this->Positions.size());
  this->Positions.push_back(place);
  this->Leaving.push_back(Next(halfedge));
  const int twin = this->Twins[halfedge];
  const auto splitSide = [&](int side)
  {
    const int head = this->Head(side), apex = this->Tails[Previous(side)];
    const int added = 3 * this->AddFace(TriangleMesh::FaceOf(side), middle, head, apex);
    int& leaving = this->LeavingOf(head, this->FaceOf(side));
    leaving = leaving == Next(side) ? added + 1 : leaving;
    this->MoveSide(Next(side), added + 1);
    this->Tails[Next(side)] = middle;
    this->Join(Next(side), added + 2);
    this->NumbersOfLines[added] = this->NumbersOfLines[side];
    this->SidesOfLines[added] = this->SidesOfLines[side];
    return added;
  };
  const int beyond = splitSide(halfedge);
  if (twin >= 0)
  {
    const int back = splitSide(twin);
    this->Join(halfedge, back);
    this->Join(twin, beyond);
  }
  return middle;
}

SplitSurface::Line SplitSurface::Line::Reversed() const
{
  switch (this->Inside)
  {
    case InsideOfLine::Left:
      return { this->Number, InsideOfLine::Right };
    case InsideOfLine::Right:
      return { this->Number, InsideOfLine::Left };
    default:
      return *this;
  }
}

void SplitSurface::AddLine(int halfedge, const Line& line)
{
  const auto hold = [this](int h, const Line& seen)
  {
    this->NumbersOfLines[h] = this->NumbersOfLines[h] < 0 ? seen.Number : this->NumbersOfLines[h];
    this->SidesOfLines[h] |= seen.Inside == InsideOfLine::Left ? Inside
      : seen.Inside == InsideOfLine::Right                     ? Outside
                                                               : Unknown;
  };
  hold(halfedge, line);
  if (this->Twins[halfedge] >= 0)
  {
    hold(this->Twins[halfedge], line.Reversed());
  }
}

bool SplitSurface::AddLine(int from, int face, int to, int nextFace, const Line& line)
{
  for (const int common : { face, nextFace })
  {
    if (this->IsCorner(from, common) && this->IsCorner(to, common))
    {
      return this->Cut(from, to, common, line);
    }
  }
  const TriangleMesh& mesh = this->Surface.Mesh;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    if (mesh.Twin(h) >= 0 && TriangleMesh::FaceOf(mesh.Twin(h)) == nextFace)
    {
      const Vector3 tail = mesh.Position(mesh.Tail(h)), along = mesh.Position(mesh.Head(h)) - tail;
      if (along.squaredNorm() == 0.0)
      {
        continue;
      }
      const auto place = [&](int vertex)
      {
        const Vector3 way = this->Positions[vertex] - tail;
        const double part = way.dot(along) / along.squaredNorm();
        return std::make_pair(part, (way - part * along).norm());
      };
      const auto [partOfFrom, farFrom] = place(from);
      const auto [partOfTo, farTo] = place(to);
      const double far = farFrom + farTo;
      const double unfolded =
        far > 0.0 ? (partOfFrom * farTo + partOfTo * farFrom) / far : 0.5 * (partOfFrom + partOfTo);
      const double part = std::clamp(unfolded, 0.0, 1.0);
      const int middle = this->AddPoint(face, tail + part * along);
      return this->Cut(from, middle, face, line) && this->Cut(middle, to, nextFace, line);
    }
  }
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    if (this->IsCorner(mesh.Tail(h), nextFace))
    {
      return this->Cut(from, mesh.Tail(h), face, line) && this->Cut(mesh.Tail(h), to, nextFace, line);
    }
  }
  return false;
}

FramedMesh SplitSurface::Make(const ExecutionContext& context) const
{
  Points points(this->Positions.size(), 3);
  for (std::size_t vertex = 0; vertex < this->Positions.size(); ++vertex)
  {
    points.row(vertex) = this->Positions[vertex].transpose();
  }
  const Triangles corners = Eigen::Map<const Triangles>(this->Tails.data(), this->Faces.size(), 3);
  return FramedMesh(TriangleMesh(std::move(points), corners, {}, context), context);
}

}
