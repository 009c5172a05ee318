#include "Geodesics/LineStarts.h"

#include "Support/Types.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

using Step = EdgePath::Step;

/// A held edge from the tail of a step, and its angle to the step.
struct HeldEdge
{
  Step Edge;
  double Angle;
};

int AnyHalfedge(const Step& step)
{
  return step.Along >= 0 ? step.Along : step.Against;
}

/// The next held edge on one side of a step.
std::optional<HeldEdge> HeldEdgeBeside(const Step& step, bool isRight, const IntrinsicTriangulation& surface)
{
  double angle = 0.0;
  for (int h = isRight ? step.Against : step.Along; h >= 0 && angle < 2.0 * Pi;)
  {
    const int corner = isRight ? TriangleMesh::Next(h) : h; // at the tail
    const int side = isRight ? TriangleMesh::Next(h) : TriangleMesh::Previous(h);
    angle += surface.CornerAngle(corner);
    const int twin = surface.Twin(side);
    if (surface.IsHeld(side))
    {
      return HeldEdge{ isRight ? Step{ side, twin } : Step{ twin, side }, angle };
    }
    h = twin;
  }
  return {};
}

/// The way along a line to the place that is nearest to the end of a step.
struct WayOfStart
{
  bool IsRight = false; ///< the side of the step
  int Edges = 0;        ///< their number, the last one in part
  double Part = 0.0;
  double Distance; ///< as unfolded
};

/// Unfolds the line on one side of a step, with the step from 0 along the x axis.
void FindNearest(const Step& first, bool isRight, const IntrinsicTriangulation& surface, WayOfStart& nearest)
{
  constexpr int MostEdges = 16;
  constexpr double Least = 1e-6; // parts that are less are none
  const double length = surface.Length(AnyHalfedge(first)), turn = isRight ? -1.0 : 1.0;
  std::optional<HeldEdge> held = HeldEdgeBeside(first, isRight, surface);
  if (!held || held->Angle >= Pi)
  {
    return;
  }
  Complex place = 0.0, direction = std::polar(1.0, turn * held->Angle);
  for (int edge = 1; held && edge <= MostEdges && std::abs(place) < length; ++edge)
  {
    const double whole = surface.Length(AnyHalfedge(held->Edge));
    const double part = std::clamp(((length - place) * std::conj(direction)).real() / whole, 0.0, 1.0);
    const double distance = std::abs(place + part * whole * direction - length);
    if (distance < nearest.Distance && part > Least)
    {
      nearest = { isRight, edge, part, distance };
    }
    place += whole * direction;
    const Step back = held->Edge.Reversed();
    held = HeldEdgeBeside(back, isRight, surface);
    if (held && held->Edge.Along == back.Along && held->Edge.Against == back.Against)
    {
      return; // the line ends
    }
    direction *= held ? -std::polar(1.0, turn * held->Angle) : 1.0;
  }
}

class StartMover
{
public:
  StartMover(EdgePath& path, IntrinsicTriangulation& surface, std::vector<VertexOnEdge>& added)
    : Path(path)
    , Surface(surface)
    , Added(added)
  {
  }

  void Run(const ExecutionContext& context)
  {
    constexpr int MostMoves = 1000;
    constexpr double Enough = 1e-12; // of the length
    for (int move = 0; move < MostMoves && !this->Path.Steps.empty(); ++move)
    {
      const Step first = this->Path.Steps.front();
      if (this->Surface.IsHeld(AnyHalfedge(first)))
      {
        this->Path.Steps.erase(this->Path.Steps.begin()); // along the line itself
        continue;
      }
      const double length = this->Surface.Length(AnyHalfedge(first));
      WayOfStart way;
      way.Distance = (1.0 - Enough) * length;
      FindNearest(first, false, this->Surface, way);
      FindNearest(first, true, this->Surface, way);
      if (way.Edges == 0 || !this->Take(way, context))
      {
        return;
      }
    }
  }

private:
  /// \return whether the path is shorter then; else nothing changes.
  bool Take(const WayOfStart& way, const ExecutionContext& context)
  {
    const EdgePath formerPath = this->Path;
    const std::size_t formerlyAdded = this->Added.size();
    const double former = formerPath.Length(this->Surface);
    const bool isNext = way.Edges == 1; // the path becomes shorter there
    std::optional<IntrinsicTriangulation> formerSurface;
    if (!isNext)
    {
      formerSurface = this->Surface;
    }
    bool isOnLine = true;
    for (int edge = 1; isOnLine && edge <= way.Edges; ++edge)
    {
      const std::optional<HeldEdge> next = HeldEdgeBeside(this->Path.Steps.front(), way.IsRight, this->Surface);
      isOnLine = next.has_value();
      if (next)
      {
        const Step step = this->PartOf(next->Edge, edge < way.Edges ? 1.0 : way.Part);
        this->Path.Steps.insert(this->Path.Steps.begin(), step.Reversed());
        MakeShortest(this->Path, this->Surface, context);
        isOnLine = !this->Path.Steps.empty();
      }
    }
    if (isNext || (isOnLine && this->Path.Length(this->Surface) < former))
    {
      return true;
    }
    this->Path = formerPath;
    this->Surface = *std::move(formerSurface);
    this->Added.resize(formerlyAdded);
    return false;
  }

  /// A part of an edge, from its tail.
  Step PartOf(const Step& edge, double part)
  {
    constexpr double Whole = 1.0 - 1e-6;
    const int h = AnyHalfedge(edge), twin = this->Surface.Twin(h);
    if (part >= Whole || (twin >= 0 && TriangleMesh::FaceOf(twin) == TriangleMesh::FaceOf(h)))
    {
      return edge;
    }
    const bool isAlong = edge.Along >= 0;
    const double partOfHalfedge = isAlong ? part : 1.0 - part;
    const int rest = this->Surface.NumberOfHalfedges(); // beyond the vertex
    this->Added.push_back({ this->Surface.Tail(h), this->Surface.Head(h), partOfHalfedge });
    const IntrinsicTriangulation::AddedVertex added = this->Surface.SplitEdge(h, partOfHalfedge);
    for (Step& step : this->Path.Steps)
    {
      step = { added.Now(step.Along), added.Now(step.Against) };
    }
    return isAlong ? Step{ h, this->Surface.Twin(h) } : Step{ this->Surface.Twin(rest), rest };
  }

  EdgePath& Path;
  IntrinsicTriangulation& Surface;
  std::vector<VertexOnEdge>& Added;
};

}

std::vector<VertexOnEdge> MoveStart(EdgePath& path, IntrinsicTriangulation& surface, const ExecutionContext& context)
{
  std::vector<VertexOnEdge> added;
  StartMover(path, surface, added).Run(context);
  return added;
}

}
