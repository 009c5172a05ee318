#include "Geodesics/ShortestPaths.h"

#include "Geodesics/HalfedgeFans.h"
#include "Geodesics/UnfoldedFace.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace dmg
{
namespace
{

/// Relative differences of lengths below are rounding errors.
constexpr double Rounding = 1e-12;

/// Two wavefronts of one source meet at a side, around a hole, a handle or a peak, where their directions at its ends run towards each
/// other: the difference of their cosines.
constexpr double SmallestMeeting = 0.7;
/// Along some sides distances rise otherwise than directions say, by more than this over the length, and the second derivative of their
/// square changes by more than this over the squared length. They belong to wavefronts of which none has both ends. Of the square by
/// directions and that of a point by the two distances alone, the one that gives the longer path counts.
constexpr double LargestJump = 0.2;
constexpr double LargestChange = 0.05;

/// A path along edges that turns by less at a vertex, in radians, does not bend there, but passes beside it.
constexpr double StraightAngle = 1e-4;

/// The number of times that the wavefront may leave a vertex. Without a limit the search might not end: across thin triangles, a path need
/// not be longer than those to the corners that it comes from.
constexpr int MostVisits = 8;

/// Shorter, or as long and straight for longer.
bool IsBetter(const ShortestPath& path, const ShortestPath& other)
{
  const double difference = Rounding * path.Length;
  return path.Length < other.Length - difference ||
    (path.Length <= other.Length + difference && path.Bend < other.Bend - difference);
}

double AngleBetween(double a, double b)
{
  return std::remainder(a - b, 2.0 * Pi);
}

/// Dijkstra's algorithm, with paths across faces beside those along edges.
class Wavefront
{
public:
  explicit Wavefront(const IntrinsicTriangulation& surface)
    : Surface(surface)
    , Around(surface)
    , Paths(surface.NumberOfVertices())
    , Visits(surface.NumberOfVertices(), 0)
    , HasPassed(surface.NumberOfVertices(), 0)
  {
  }

  /// Goes on from paths that were found, to one more vertex.
  ShortestPath GoOnTo(int vertex, std::vector<ShortestPath> paths)
  {
    this->Paths = std::move(paths);
    this->Paths.resize(this->Surface.NumberOfVertices());
    for (std::size_t other = 0; other < this->Paths.size(); ++other)
    {
      this->HasPassed[other] = this->Paths[other].IsAny() ? 1 : 0;
    }
    this->Renew({ vertex });
    return this->Paths[vertex];
  }

  void Start(const PathStart& start)
  {
    ShortestPath path;
    path.Length = 0.0;
    path.Source = start.Source;
    this->Reach(start.Vertex, path);
  }

  void Run(double maximumDistance, const ExecutionContext& context)
  {
    constexpr int Steps = 16384;
    int passed = 0;
    for (int step = 0; !this->Reached.empty() && this->Reached.top().first <= maximumDistance; ++step)
    {
      const auto [length, vertex] = this->Reached.top();
      this->Reached.pop();
      if (step % Steps == 0)
      {
        context.Checkpoint(passed / static_cast<double>(this->Paths.size()));
      }
      if (length == this->Paths[vertex].Length && !this->HasPassed[vertex])
      {
        passed += this->Visits[vertex] == 0 ? 1 : 0;
        this->HasPassed[vertex] = 1;
        ++this->Visits[vertex];
        this->Around.VisitFan(vertex, [this](int h) { this->Leave(h); });
      }
    }
  }

  std::vector<ShortestPath> Result() && { return std::move(this->Paths); }

private:
  /// A vertex whose path becomes shorter is visited again, and all that came from its former path is found anew.
  void Reach(int vertex, const ShortestPath& path)
  {
    ShortestPath& best = this->Paths[vertex];
    if (this->Visits[vertex] >= MostVisits || !IsBetter(path, best) || this->IsParentOf(vertex, path.Parents[0]) ||
      this->IsParentOf(vertex, path.Parents[1]))
    {
      return;
    }
    best = path;
    this->Reached.emplace(path.Length, vertex);
    if (this->HasPassed[vertex])
    {
      this->HasPassed[vertex] = 0;
      this->Renew(this->TakeBackFrom(vertex));
    }
  }

  bool IsParentOf(int vertex, int child) const
  {
    return child >= 0 && (this->Paths[child].Parents[0] == vertex || this->Paths[child].Parents[1] == vertex);
  }

  /// Forgets all paths that lead past a vertex. \return their ends.
  std::vector<int> TakeBackFrom(int vertex)
  {
    std::vector<int> ends;
    std::vector<int> stack = { vertex };
    const auto takeBack = [&](int end, int parent)
    {
      if (this->IsParentOf(parent, end) && this->Visits[end] < MostVisits)
      {
        this->Paths[end] = {};
        this->HasPassed[end] = 0;
        ends.push_back(end);
        stack.push_back(end);
      }
    };
    while (!stack.empty())
    {
      const int parent = stack.back();
      stack.pop_back();
      this->Around.VisitFan(parent,
        [&](int h)
        {
          takeBack(this->Surface.Head(h), parent);
          takeBack(this->Surface.Tail(TriangleMesh::Previous(h)), parent);
        });
    }
    return ends;
  }

  /// Finds paths to vertices from where the wavefront has passed.
  void Renew(const std::vector<int>& vertices)
  {
    for (const int vertex : vertices)
    {
      this->Around.VisitFan(vertex,
        [&](int h)
        {
          const int back = TriangleMesh::Previous(h);
          if (this->HasPassed[this->Surface.Head(h)])
          {
            this->Against(h);
          }
          if (this->HasPassed[this->Surface.Tail(back)])
          {
            this->Along(back);
          }
          this->Across(TriangleMesh::Next(h));
        });
    }
  }

  /// Goes on from the tail of a halfedge, over its face.
  void Leave(int h)
  {
    const int back = TriangleMesh::Previous(h);
    this->Along(h);
    this->Against(back);
    this->Across(h);
    this->Across(back);
  }

  void Along(int h)
  {
    this->GoOn(this->Surface.Tail(h), this->Surface.Head(h), this->Surface.Direction(h), this->Surface.Arrival(h),
      this->Surface.Length(h));
  }

  /// From the head of a halfedge to its tail.
  void Against(int h)
  {
    this->GoOn(this->Surface.Head(h), this->Surface.Tail(h), this->Surface.Arrival(h) + Pi,
      this->Surface.Direction(h) + Pi, this->Surface.Length(h));
  }

  void GoOn(int from, int to, double direction, double arrival, double length)
  {
    const ShortestPath& path = this->Paths[from];
    const double outset = path.IsAtSource() ? direction : path.Outset;
    const double turn = AngleBetween(direction, path.Arrival) / this->Surface.Stretch(from);
    const double turned = AngleBetween(path.Turn + arrival, direction);
    if (path.IsAtSource() || std::abs(turn) > StraightAngle)
    {
      this->Reach(to, { path.Length + length, arrival, outset, path.Length, path.Source, { from, from }, turned });
      return;
    }
    const Complex ray = length + std::polar(path.Length - path.Bend, -turn);
    this->Reach(to,
      { path.Bend + std::abs(ray), arrival + this->Surface.Stretch(to) * std::arg(ray), outset, path.Bend, path.Source,
        { from, from }, turned });
  }

  void Across(int side)
  {
    const int tail = this->Surface.Tail(side), head = this->Surface.Head(side);
    if (!this->HasPassed[tail] || !this->HasPassed[head])
    {
      return;
    }
    const ShortestPath& a = this->Paths[tail];
    const ShortestPath& b = this->Paths[head];
    const bool isAtSources = a.IsAtSource() && b.IsAtSource();
    if (isAtSources ? this->Surface.IsHeld(side) : a.Source == b.Source)
    {
      this->AcrossTogether(side, a, b);
    }
    else if (!isAtSources) // else the edges of both ends are as short
    {
      this->AcrossApart(side, a, b);
    }
  }

  /// One wavefront reaches both ends of the side.
  void AcrossTogether(int side, const ShortestPath& a, const ShortestPath& b)
  {
    const UnfoldedFace face(this->Surface, side);
    const double bend = std::min(a.Bend, b.Bend);
    const double toA = a.Length - bend, toB = b.Length - bend;
    const double alongA = this->Cosine(this->Surface.Tail(side), a, this->Surface.Direction(side));
    const double alongB = this->Cosine(this->Surface.Head(side), b, this->Surface.Arrival(side));
    if (DoMeet(face.L, a, alongA, b, alongB))
    {
      this->AcrossApart(side, a, b);
      return;
    }
    SquaredDistance square(face.L, toA, alongA, toB, alongB);
    if (toA > 0.0 && toB > 0.0 && IsTorn(square, face.L, toB - toA, 0.5 * (alongA + alongB)))
    {
      const SquaredDistance ofPoint = SquaredDistance::OfPoint(face.L, toA, toB);
      const double first = face.Shortest(square, 0.5), second = face.Shortest(ofPoint, 0.5);
      if (std::abs(toB - toA) > face.L || first < 0.0 || second < 0.0)
      {
        return;
      }
      square = face.LengthAcross(ofPoint, second) > face.LengthAcross(square, first) ? ofPoint : square;
    }
    const double s = face.Shortest(square, face.Crossing(face.SourceOf(toA, toB)));
    if (s >= 0.0)
    {
      const int tail = this->Surface.Tail(side), head = this->Surface.Head(side);
      const double part = PartOfAngle(toA, std::sqrt(std::max(square.At(s), 0.0)), toB, s * face.L, face.L);
      const double outset = toA > 0.0 && toB > 0.0 ? a.Outset + part * AngleBetween(b.Outset, a.Outset)
        : toA > 0.0                                ? a.Outset
                                                   : b.Outset;
      // The error of a way along edges is the curvature in the triangle beside it. Those of both ways cancel in this mean.
      const double fromTail = this->TurnAtApex(side, true), fromHead = this->TurnAtApex(side, false);
      this->Reach(this->Apex(side),
        { bend + face.LengthAcross(square, s), this->ArrivalAtApex(side, face, face.C - s * face.L), outset, bend,
          a.Source, s < 0.5 ? std::array<int, 2>{ tail, head } : std::array<int, 2>{ head, tail },
          AngleBetween(fromTail, -s * AngleBetween(fromHead, fromTail)) });
    }
  }

  /// Whether the wavefronts at the ends of a side run towards each other. From an end that is a source itself, distances rise as the
  /// direction at the other end says, or the latter belongs to another place of the source.
  static bool DoMeet(double length, const ShortestPath& a, double alongA, const ShortestPath& b, double alongB)
  {
    if (a.IsAtSource() && b.IsAtSource())
    {
      return false;
    }
    if (a.IsAtSource() || b.IsAtSource())
    {
      const double slope = a.IsAtSource() ? alongB : alongA;
      return std::abs(b.Length - a.Length - length * slope) > LargestJump * length;
    }
    return alongA - alongB > SmallestMeeting;
  }

  static bool IsTorn(const SquaredDistance& square, double length, double rise, double meanCosine)
  {
    return square.ChangeOfBend() > LargestChange * length * length &&
      std::abs(rise - length * meanCosine) > LargestJump * length;
  }

  /// Two wavefronts meet at the side: each end goes on alone, from the place that it sees as its source, where that is the nearer one.
  void AcrossApart(int side, const ShortestPath& a, const ShortestPath& b)
  {
    const UnfoldedFace face(this->Surface, side);
    const int tail = this->Surface.Tail(side), head = this->Surface.Head(side);
    const Complex fromA = this->SeenFrom(tail, a, this->Surface.Direction(side));
    const Complex fromB = face.L + this->SeenFrom(head, b, this->Surface.Arrival(side));
    this->AcrossAlone(side, face, { a, fromA, tail }, { b, fromB, head });
    this->AcrossAlone(side, face, { b, fromB, head }, { a, fromA, tail });
  }

  /// The place from which a path comes straight to a vertex, against the vertex, in a plane where a direction is that of the x axis.
  Complex SeenFrom(int vertex, const ShortestPath& path, double direction) const
  {
    return -std::polar(path.Length - path.Bend, AngleBetween(path.Arrival, direction) / this->Surface.Stretch(vertex));
  }

  /// A path to an end of a side, and the place from which it comes straight there.
  struct StraightPath
  {
    const ShortestPath& Path;
    Complex From;
    int End;

    double LengthTo(Complex place) const { return this->Path.Bend + std::abs(place - this->From); }
  };

  void AcrossAlone(int side, const UnfoldedFace& face, const StraightPath& path, const StraightPath& other)
  {
    const double crossing = path.From.imag() < 0.0 ? face.Crossing(path.From) : -1.0;
    if (crossing >= 0.0 && crossing <= 1.0 && path.LengthTo(crossing * face.L) <= other.LengthTo(crossing * face.L))
    {
      this->Reach(this->Apex(side),
        { path.LengthTo(face.C), this->ArrivalAtApex(side, face, face.C - path.From), path.Path.Outset, path.Path.Bend,
          path.Path.Source, { path.End, other.End }, this->TurnAtApex(side, path.End == this->Surface.Tail(side)) });
    }
  }

  int Apex(int side) const { return this->Surface.Tail(TriangleMesh::Previous(side)); }

  /// The direction of a ray of the unfolded face at its third corner.
  double ArrivalAtApex(int side, const UnfoldedFace& face, Complex ray) const
  {
    const int toA = TriangleMesh::Previous(side);
    return this->Surface.Direction(toA) + Pi + this->Surface.Stretch(this->Apex(side)) * std::arg(ray / face.C);
  }

  /// The turn at the third corner of a side's face by way of one end of the side.
  double TurnAtApex(int side, bool isByTail) const
  {
    const int back = TriangleMesh::Previous(side), next = TriangleMesh::Next(side);
    return isByTail ? AngleBetween(this->Paths[this->Surface.Tail(side)].Turn, this->Surface.Transport(back))
                    : AngleBetween(this->Paths[this->Surface.Head(side)].Turn, -this->Surface.Transport(next));
  }

  double Cosine(int vertex, const ShortestPath& path, double direction) const
  {
    return path.IsAtSource() ? 0.0 : std::cos(AngleBetween(path.Arrival, direction) / this->Surface.Stretch(vertex));
  }

  /// The angle that a part of a side has for a source, over that of the whole side.
  static double PartOfAngle(double toA, double toPlace, double toB, double part, double whole)
  {
    const auto angle = [](double a, double b, double c)
    { return std::asin(std::sqrt(std::clamp((c - a + b) * (c + a - b) / (4.0 * a * b), 0.0, 1.0))); };
    const double all = angle(toA, toB, whole);
    return all > 0.0 ? std::clamp(angle(toA, toPlace, part) / all, 0.0, 1.0) : part / whole;
  }

  using Entry = std::pair<double, int>;
  const IntrinsicTriangulation& Surface;
  const HalfedgeFans Around;
  std::vector<ShortestPath> Paths; ///< by vertex, the best so far
  std::vector<int> Visits;         ///< how often the wavefront has left the vertex
  std::vector<char> HasPassed;     ///< whether it has left the vertex since its path became better
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> Reached;
};

}

std::vector<ShortestPath> FindShortestPaths(const IntrinsicTriangulation& surface, const std::vector<PathStart>& starts,
  double maximumDistance, const ExecutionContext& context)
{
  Wavefront front(surface);
  for (const PathStart& start : starts)
  {
    front.Start(start);
  }
  front.Run(maximumDistance, context);
  return std::move(front).Result();
}

ShortestPath FindPathTo(int vertex, const IntrinsicTriangulation& surface, std::vector<ShortestPath> paths)
{
  return Wavefront(surface).GoOnTo(vertex, std::move(paths));
}

}
