#include "Geodesics/WavefrontPaths.h"

#include "Drawing/UnfoldedSurface.h"
#include "Geodesics/HalfedgeFans.h"
#include "Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dmg
{
namespace
{

/// The shortest of the edges between two neighbours.
EdgePath::Step EdgeBetween(int tail, int head, const IntrinsicTriangulation& surface, const HalfedgeFans& fans)
{
  EdgePath::Step edge{ -1, -1 };
  double shortest = std::numeric_limits<double>::infinity();
  const auto compare = [&](int h, bool isAlong)
  {
    if (surface.Length(h) < shortest)
    {
      shortest = surface.Length(h);
      edge = isAlong ? EdgePath::Step{ h, surface.Twin(h) } : EdgePath::Step{ surface.Twin(h), h };
    }
  };
  fans.VisitFan(tail,
    [&](int h)
    {
      if (surface.Head(h) == head)
      {
        compare(h, true);
      }
      const int back = TriangleMesh::Previous(h);
      if (surface.Tail(back) == head)
      {
        compare(back, false);
      }
    });
  return edge;
}

/// Traces edges of a flipped triangulation over the faces of its surface.
class EdgeTracer
{
public:
  EdgeTracer(const IntrinsicTriangulation& flipped, const FramedMesh& surface, const VertexConnection& connection,
    const std::vector<VertexOfPath>& added)
    : Flipped(flipped)
    , Added(added)
    , Mesh(surface.Mesh)
    , Connection(connection)
    , Unfolded(surface.Mesh, surface.Faces)
  {
  }

  Vector3 PositionOf(int vertex) const
  {
    const int added = vertex - this->Mesh.NumberOfVertices();
    return added < 0 ? this->Mesh.Position(vertex) : this->Added[added].Position;
  }

  Vector3 StartOf(const EdgePath::Step& step) const
  {
    return this->PositionOf(step.Along >= 0 ? this->Flipped.Tail(step.Along) : this->Flipped.Head(step.Against));
  }

  /// Appends the places where an edge crosses those of the surface, and its end.
  void Trace(const EdgePath::Step& step, std::vector<Vector3>& points) const
  {
    const bool isAlong = step.Along >= 0 && (step.Against < 0 || this->IsSeenFrom(this->Flipped.Tail(step.Along)));
    std::vector<Vector3> crossings = this->Crossings(isAlong ? step.Along : step.Against);
    if (!isAlong)
    {
      std::reverse(crossings.begin(), crossings.end());
    }
    points.insert(points.end(), crossings.begin(), crossings.end());
    points.push_back(this->PositionOf(isAlong ? this->Flipped.Head(step.Along) : this->Flipped.Tail(step.Against)));
  }

private:
  /// Whether directions at a vertex are those of the surface.
  bool IsSeenFrom(int vertex) const
  {
    const int added = vertex - this->Mesh.NumberOfVertices();
    return added < 0 || this->Added[added].At.Face >= 0;
  }

  /// From a vertex that was added.
  std::vector<Vector3> CrossingsFrom(int vertex, int halfedge) const
  {
    constexpr double Rounding = 1e-7;
    std::vector<Vector3> crossings;
    SurfacePoint at = this->Added[vertex - this->Mesh.NumberOfVertices()].At;
    if (at.Face >= 0) // else along an edge of the surface
    {
      Complex direction = std::polar(1.0, this->Flipped.Direction(halfedge));
      this->Unfolded.GoStraight(at, direction, (1.0 - Rounding) * this->Flipped.Length(halfedge), &crossings);
    }
    return crossings;
  }

  std::vector<Vector3> Crossings(int halfedge) const
  {
    constexpr double Rounding = 1e-7;
    const int tail = this->Flipped.Tail(halfedge), head = this->Flipped.Head(halfedge);
    if (tail >= this->Mesh.NumberOfVertices())
    {
      return this->CrossingsFrom(tail, halfedge);
    }
    int start = -1;
    double turn = 0.0, leastBeyond = std::numeric_limits<double>::infinity();
    bool isEdge = false;
    this->Mesh.VisitFan(tail,
      [&](int h)
      {
        const double full = 2.0 * Pi;
        const double from = std::fmod(
          std::fmod(this->Flipped.Direction(halfedge) - this->Connection.PolarAngle(h) + Rounding, full) + full, full);
        const double beyond = from - this->Connection.CornerAngle(h);
        if (beyond < leastBeyond)
        {
          leastBeyond = beyond;
          start = h;
          turn = std::clamp(from - Rounding, 0.0, this->Connection.CornerAngle(h));
        }
        isEdge |= this->Mesh.Head(h) == head && from <= 2.0 * Rounding;
        isEdge |= this->Mesh.Tail(TriangleMesh::Previous(h)) == head && std::abs(beyond - Rounding) <= Rounding;
      });
    std::vector<Vector3> crossings;
    if (!isEdge)
    {
      SurfacePoint at{ TriangleMesh::FaceOf(start), this->Unfolded.Corner(start) };
      Complex direction = this->Unfolded.Side(start) * std::polar(1.0, turn / this->Flipped.Stretch(tail));
      const double length = (1.0 - Rounding) * this->Flipped.Length(halfedge); // no side beyond the head is crossed
      this->Unfolded.GoStraight(at, direction, length, &crossings);
    }
    return crossings;
  }

  const IntrinsicTriangulation& Flipped;
  const std::vector<VertexOfPath>& Added;
  const TriangleMesh& Mesh;
  const VertexConnection& Connection;
  const UnfoldedSurface Unfolded;
};

}

EdgePath EdgesBeside(const std::vector<ShortestPath>& paths, int target, const IntrinsicTriangulation& surface)
{
  const HalfedgeFans fans(surface);
  EdgePath path;
  int vertex = target;
  for (std::size_t step = 0; !paths[vertex].IsAtSource(); ++step)
  {
    const int parent = paths[vertex].Parents[0];
    if (step > paths.size())
    {
      throw UnexpectedFailure("the path to vertex " + std::to_string(target) + " leads in a circle");
    }
    path.Steps.push_back(EdgeBetween(parent, vertex, surface, fans));
    vertex = parent;
  }
  std::reverse(path.Steps.begin(), path.Steps.end());
  return path;
}

std::vector<Vector3> TracePath(const EdgePath& path, int target, const IntrinsicTriangulation& flipped,
  const FramedMesh& surface, const VertexConnection& connection, const std::vector<VertexOfPath>& added)
{
  const EdgeTracer tracer(flipped, surface, connection, added);
  if (path.Steps.empty())
  {
    return { tracer.PositionOf(target) };
  }
  std::vector<Vector3> points = { tracer.StartOf(path.Steps.front()) };
  for (const EdgePath::Step& step : path.Steps)
  {
    tracer.Trace(step, points);
  }
  return points;
}

}
