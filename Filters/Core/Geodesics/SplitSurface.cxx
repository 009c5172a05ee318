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

const std::vector<int>& SplitSurface::PartsOf(int face)
{
  std::vector<int>& parts = this->Parts[face];
  if (parts.empty())
  {
    parts.push_back(face);
  }
  return parts;
}

bool SplitSurface::IsCorner(int vertex, int face)
{
  const std::vector<int>& parts = this->PartsOf(face);
  return std::any_of(parts.begin(), parts.end(),
    [&](int part)
    { return std::count(this->Tails.begin() + 3 * part, this->Tails.begin() + 3 * part + 3, vertex) > 0; });
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
  const std::vector<int> parts = this->PartsOf(face);
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
  int around = -1;
  double inmost = -1e300;
  for (const int part : parts)
  {
    double inside = 1e300; // the least distance from a side, positive inside
    for (int h = 3 * part; h < 3 * part + 3; ++h)
    {
      const Complex tail = this->InPlane(face, this->Tails[h]) - point;
      const Complex head = this->InPlane(face, this->Head(h)) - point;
      if (SquaredDistanceToSegment(tail, head) <= snap * snap)
      {
        return this->SplitEdge(h, place);
      }
      inside = std::min(inside, Cross(tail, head) / std::abs(head - tail));
    }
    if (inside > inmost)
    {
      inmost = inside;
      around = part;
    }
  }
  return this->SplitFace(around, place);
}

int SplitSurface::AddFace(int part, int a, int b, int c)
{
  const int added = static_cast<int>(this->Faces.size());
  const int face = this->Faces[part];
  this->PartsOf(face);
  this->Parts[face].push_back(added);
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
  const int twin = this->Twins[halfedge];
  const auto splitSide = [&](int side)
  {
    const int head = this->Head(side), apex = this->Tails[Previous(side)];
    const int added = 3 * this->AddFace(TriangleMesh::FaceOf(side), middle, head, apex);
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

/// From edge to edge of the parts of one face; those that are crossed are split there.
bool SplitSurface::Cut(int from, int to, int face, const Line& line)
{
  const std::size_t steps = 3 * this->PartsOf(face).size() + 3;
  for (std::size_t step = 0; from != to && step < steps; ++step)
  {
    const int next = this->GoOn(from, to, face);
    if (next < 0)
    {
      return false;
    }
    for (const int part : this->PartsOf(face))
    {
      for (int h = 3 * part; h < 3 * part + 3; ++h)
      {
        const bool isAlong = this->Tails[h] == from && this->Head(h) == next;
        if (isAlong || (this->Tails[h] == next && this->Head(h) == from))
        {
          this->AddLine(h, isAlong ? line : line.Reversed());
        }
      }
    }
    from = next;
  }
  return from == to;
}

/// The next vertex on the straight line to another one, which may be new; -1 where rounding hides it.
int SplitSurface::GoOn(int from, int to, int face)
{
  const Complex start = this->InPlane(face, from), way = this->InPlane(face, to) - start;
  const double snap = Snap * this->SizeOf(face) * std::abs(way);
  const auto isOnLine = [&](int vertex)
  {
    const Complex place = this->InPlane(face, vertex) - start;
    return vertex == to || (std::abs(Cross(way, place)) <= snap && Dot(way, place) > 0.0);
  };
  int crossed = -1;
  for (const int part : this->PartsOf(face))
  {
    for (int h = 3 * part; h < 3 * part + 3; ++h)
    {
      if (this->Tails[h] != from)
      {
        continue;
      }
      const int right = this->Head(h), left = this->Tails[Previous(h)];
      if (isOnLine(right) || isOnLine(left))
      {
        return isOnLine(right) ? right : left;
      }
      if (Cross(way, this->InPlane(face, right) - start) < 0.0 && Cross(way, this->InPlane(face, left) - start) > 0.0)
      {
        crossed = Next(h);
      }
    }
  }
  if (crossed < 0)
  {
    return -1;
  }
  const int right = this->Tails[crossed], left = this->Head(crossed);
  const double below = -Cross(way, this->InPlane(face, right) - start);
  const double above = Cross(way, this->InPlane(face, left) - start);
  const double part = below / (below + above);
  return this->SplitEdge(crossed, (1.0 - part) * this->Positions[right] + part * this->Positions[left]);
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
