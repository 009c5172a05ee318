// Lines through the parts of a face.

#include "Geodesics/SplitSurface.h"

#include "Drawing/UnfoldedSurface.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Parts of a face along a straight line between two vertices, which crosses their inner edges.
struct SplitSurface::Strip
{
  std::vector<int> Parts;
  std::vector<int> Right, Left;           ///< vertices beside the line, from its start
  std::vector<int> RightSides, LeftSides; ///< halfedges between these, and from and to its ends
};

/// From vertex to vertex of the parts of one face, and from one edge of a line to the next, which is split there.
bool SplitSurface::Cut(int from, int to, int face, const Line& line)
{
  const Complex way = this->InPlane(face, to) - this->InPlane(face, from);
  while (from != to)
  {
    const Step next = this->GoOn(from, to, face);
    if (next.Vertex < 0 ||
      (next.Vertex != to && Dot(way, this->InPlane(face, next.Vertex) - this->InPlane(face, from)) <= 0.0))
    {
      return false; // rounding hides the way
    }
    this->AddLine(next.Halfedge, this->Tails[next.Halfedge] == from ? line : line.Reversed());
    from = next.Vertex;
  }
  return true;
}

/// A step on the straight line to another vertex, up to a vertex that may be new; none where rounding hides it.
SplitSurface::Step SplitSurface::GoOn(int from, int to, int face)
{
  const Complex start = this->InPlane(face, from), way = this->InPlane(face, to) - start;
  const double snap = Snap * this->SizeOf(face) * std::abs(way);
  const auto isOnLine = [&](int vertex)
  {
    const Complex place = this->InPlane(face, vertex) - start;
    return vertex == to || (std::abs(Cross(way, place)) <= snap && Dot(way, place) > 0.0);
  };
  const auto heightOf = [&](int vertex) { return Cross(way, this->InPlane(face, vertex) - start); };
  int first = -1;
  const int atStart = this->FirstAt(from, face);
  for (int h = atStart; h >= 0; h = this->NextAt(h, atStart, face))
  {
    const int right = this->Head(h), left = this->Tails[Previous(h)];
    if (isOnLine(right) || isOnLine(left))
    {
      return isOnLine(right) ? Step{ right, h } : Step{ left, Previous(h) };
    }
    first = heightOf(right) < 0.0 && heightOf(left) > 0.0 ? h : first;
  }
  if (first < 0)
  {
    return { -1, -1 };
  }
  Strip strip{ { TriangleMesh::FaceOf(first) }, { this->Head(first) }, { this->Tails[Previous(first)] }, { first },
    { Previous(first) } };
  for (int crossed = Next(first); static_cast<int>(strip.Parts.size()) <= this->About(face).Count;)
  {
    const int right = this->Tails[crossed], left = this->Head(crossed), twin = this->Twins[crossed];
    if (this->NumbersOfLines[crossed] >= 0 || twin < 0 || this->FaceOf(twin) != face)
    {
      const double below = -heightOf(right), above = heightOf(left), part = below / (below + above);
      const Vector3 place = (1.0 - part) * this->Positions[right] + part * this->Positions[left];
      return this->GoOn(from, this->SplitEdge(crossed, place), face);
    }
    const int apex = this->Tails[Previous(twin)];
    strip.Parts.push_back(TriangleMesh::FaceOf(twin));
    if (isOnLine(apex))
    {
      strip.RightSides.push_back(Next(twin));
      strip.LeftSides.push_back(Previous(twin));
      return { apex, this->MakeEdge(strip, from, apex) };
    }
    const bool isLeft = heightOf(apex) > 0.0;
    (isLeft ? strip.Left : strip.Right).push_back(apex);
    (isLeft ? strip.LeftSides : strip.RightSides).push_back(isLeft ? Previous(twin) : Next(twin));
    crossed = isLeft ? Next(twin) : Previous(twin);
  }
  return { -1, -1 };
}

/// Fills the two polygons beside a line with triangles, so that it becomes an edge (Anglada 1997). They take the places of the strip's parts.
class SplitSurface::PolygonFilling
{
public:
  PolygonFilling(SplitSurface& split, const Strip& strip)
    : Split(split)
    , Face(split.Faces[strip.Parts[0]])
    , Free(strip.Parts)
  {
    for (const std::vector<int>* const sides : { &strip.RightSides, &strip.LeftSides })
    {
      for (const int h : *sides)
      {
        this->Outer[h] = { split.Twins[h], split.NumbersOfLines[h], split.SidesOfLines[h], h };
      }
    }
  }

  /// \param chain the corners from b to a, counter-clockwise; \param sides the former halfedges between them, and from b and to a.
  /// \return the halfedge from a to b.
  int Fill(
    int a, int b, const std::vector<int>& chain, const std::vector<int>& sides, std::size_t first, std::size_t end)
  {
    const std::size_t k = this->Best(a, b, chain, first, end);
    const int h = 3 * this->Free.back();
    this->Free.pop_back();
    const int corners[] = { a, b, chain[k] };
    for (int i = 0; i < 3; ++i)
    {
      this->Split.Tails[h + i] = corners[i];
      this->Split.NumbersOfLines[h + i] = -1;
      this->Split.SidesOfLines[h + i] = Unknown;
      this->Split.LeavingOf(corners[i], this->Face) = h + i;
    }
    const auto fillSide = [&](int side, std::size_t outer, int tail, int head, std::size_t from, std::size_t to)
    {
      if (from == to)
      {
        this->Outer[sides[outer]].Place = side;
      }
      else
      {
        this->Split.Join(side, this->Fill(head, tail, chain, sides, from, to));
      }
    };
    fillSide(h + 1, first, b, chain[k], first, k);
    fillSide(h + 2, end, chain[k], a, k + 1, end);
    return h;
  }

  void JoinOutside()
  {
    for (const auto& [former, side] : this->Outer)
    {
      const auto twin = this->Outer.find(side.Twin);
      this->Split.Join(side.Place, twin == this->Outer.end() ? side.Twin : twin->second.Place);
      this->Split.NumbersOfLines[side.Place] = side.Number;
      this->Split.SidesOfLines[side.Place] = side.Sides;
    }
  }

private:
  /// The corner that sees a side under the largest angle, as Delaunay triangulations have it.
  std::size_t Best(int a, int b, const std::vector<int>& chain, std::size_t first, std::size_t end) const
  {
    const Complex tail = this->Split.InPlane(this->Face, a), head = this->Split.InPlane(this->Face, b);
    std::size_t best = first;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = first; k < end; ++k)
    {
      const Complex place = this->Split.InPlane(this->Face, chain[k]);
      const double twiceArea = Cross(tail - place, head - place);
      const double cotangent = Dot(tail - place, head - place) / twiceArea;
      if (twiceArea > 0.0 && cotangent < least)
      {
        least = cotangent;
        best = k;
      }
    }
    return best;
  }

  struct Side
  {
    int Twin;
    int Number;
    char Sides;
    int Place;
  };
  SplitSurface& Split;
  const int Face;
  std::vector<int> Free;               // parts
  std::unordered_map<int, Side> Outer; // by former halfedges
};

/// \return the halfedge.
int SplitSurface::MakeEdge(Strip& strip, int from, int to)
{
  std::reverse(strip.Left.begin(), strip.Left.end());
  std::reverse(strip.LeftSides.begin(), strip.LeftSides.end());
  PolygonFilling filling(*this, strip);
  const int right = filling.Fill(to, from, strip.Right, strip.RightSides, 0, strip.Right.size());
  const int left = filling.Fill(from, to, strip.Left, strip.LeftSides, 0, strip.Left.size());
  this->Join(left, right);
  filling.JoinOutside();
  return left;
}

}
