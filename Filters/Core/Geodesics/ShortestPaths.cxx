#include "Geodesics/ShortestPaths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
/// Relative differences of lengths below are rounding errors.
constexpr double Rounding = 1e-13;

/// A path to a vertex.
struct Path
{
  double Length = Infinity;
  double Start = 0.0;     ///< its length up to the last vertex through which it leads; straight from there
  double Direction = 0.0; ///< in which it starts

  /// Shorter, or as long and straight for longer.
  bool IsBetterThan(const Path& other) const
  {
    const double difference = Rounding * this->Length;
    return this->Length < other.Length - difference ||
      (this->Length <= other.Length + difference && this->Start < other.Start - difference);
  }
};

/// A triangle in a plane: the side from A = 0 to B > 0, which a wavefront has reached, and C above.
class UnfoldedFace
{
public:
  UnfoldedFace(const IntrinsicTriangulation& surface, int side)
    : L(surface.Length(side))
  {
    const double toA = surface.Length(TriangleMesh::Previous(side));
    const double toB = surface.Length(TriangleMesh::Next(side));
    const double x = 0.5 * (this->L + (toA - toB) * (toA + toB) / this->L);
    this->C = { x, std::sqrt(std::max(toA * toA - x * x, 0.0)) };
  }

  /// The path to C across the side; of infinite length where there is none.
  Path Across(const Path& a, const Path& b) const
  {
    constexpr double Tolerance = 1e-6;
    constexpr double MostSpread = 5.0; // of directions over the angle that the side has for the source
    const double start = std::min(a.Start, b.Start);
    const double toA = a.Length - start, toB = b.Length - start;
    if (!(toA > 0.0) || !(toB > 0.0))
    {
      return {};
    }
    // The source has the distances of A and B; where there is no such place, it is at infinity.
    const double x = 0.5 * (this->L + (toA - toB) * (toA + toB) / this->L);
    const Complex source(x, -std::sqrt(std::max((toA - x) * (toA + x), 0.0)));
    const double place = x - (this->C.real() - x) * source.imag() / (this->C - source).imag();
    const double turn = std::remainder(b.Direction - a.Direction, 2.0 * Pi);
    const double all = std::arg(std::conj(this->L - source) * -source); // clockwise from A to B
    const bool isOneWavefront = turn <= Tolerance && turn >= -Tolerance - MostSpread * all;
    if (!isOneWavefront || !(place >= -Tolerance * this->L && place <= (1.0 + Tolerance) * this->L))
    {
      return {};
    }
    const double part = std::arg(std::conj(this->C - source) * -source);
    const double share = all > 0.0 ? std::clamp(part / all, 0.0, 1.0) : 0.5;
    return { start + std::abs(this->C - source), start, a.Direction + share * turn };
  }

private:
  const double L;
  Complex C;
};

/// The halfedges that leave each vertex.
class Fans
{
public:
  explicit Fans(const IntrinsicTriangulation& surface)
    : Offsets(surface.NumberOfVertices() + 1, 0)
    , Halfedges(surface.NumberOfHalfedges())
  {
    for (int h = 0; h < surface.NumberOfHalfedges(); ++h)
    {
      ++this->Offsets[surface.Tail(h) + 1];
    }
    for (std::size_t k = 1; k < this->Offsets.size(); ++k)
    {
      this->Offsets[k] += this->Offsets[k - 1];
    }
    std::vector<int> next(this->Offsets.begin(), this->Offsets.end() - 1);
    for (int h = 0; h < surface.NumberOfHalfedges(); ++h)
    {
      this->Halfedges[next[surface.Tail(h)]++] = h;
    }
  }

  template <class Visit>
  void VisitFan(int vertex, const Visit& visit) const
  {
    for (int k = this->Offsets[vertex]; k < this->Offsets[vertex + 1]; ++k)
    {
      visit(this->Halfedges[k]);
    }
  }

private:
  std::vector<int> Offsets;
  std::vector<int> Halfedges;
};

/// The number of times that paths may go on from a vertex. Without a limit the search might not end: across thin triangles, a path need
/// not be longer than those to the corners that it comes from.
constexpr int MostVisits = 8;

/// Dijkstra's algorithm, with paths across faces beside those along edges. A vertex whose path becomes shorter is visited again.
class Wavefront
{
public:
  explicit Wavefront(const IntrinsicTriangulation& surface)
    : Surface(surface)
    , Around(surface)
    , Paths(surface.NumberOfVertices())
    , Visits(surface.NumberOfVertices(), 0)
  {
  }

  void Run(int from, const ExecutionContext& context)
  {
    constexpr int Steps = 65536;
    this->Reach(from, { 0.0, 0.0, 0.0 });
    for (int step = 0; !this->Reached.empty(); ++step)
    {
      const auto [length, vertex] = this->Reached.top();
      this->Reached.pop();
      if (step % Steps == 0)
      {
        context.Checkpoint(0.0);
      }
      if (length == this->Paths[vertex].Length)
      {
        ++this->Visits[vertex];
        this->Around.VisitFan(vertex, [this](int h) { this->Leave(h); });
      }
    }
  }

  const std::vector<Path>& Result() const { return this->Paths; }

private:
  void Reach(int vertex, const Path& path)
  {
    if (this->Visits[vertex] < MostVisits && path.IsBetterThan(this->Paths[vertex]))
    {
      this->Paths[vertex] = path;
      this->Reached.emplace(path.Length, vertex);
    }
  }

  /// Goes on from the tail of a halfedge, over its face.
  void Leave(int h)
  {
    const int back = TriangleMesh::Previous(h);
    const int vertex = this->Surface.Tail(h);
    this->Along(vertex, this->Surface.Head(h), this->Surface.Direction(h), h);
    this->Along(vertex, this->Surface.Tail(back), this->Surface.Arrival(back) + Pi, back);
    this->Across(h);
    this->Across(back);
  }

  void Along(int vertex, int to, double direction, int edge)
  {
    const Path& path = this->Paths[vertex];
    this->Reach(
      to, { path.Length + this->Surface.Length(edge), path.Length, path.Length > 0.0 ? path.Direction : direction });
  }

  void Across(int side)
  {
    const int tail = this->Surface.Tail(side), head = this->Surface.Head(side);
    if (this->Visits[tail] > 0 && this->Visits[head] > 0)
    {
      const Path& a = this->Paths[tail];
      const Path& b = this->Paths[head];
      const int opposite = this->Surface.Tail(TriangleMesh::Previous(side));
      this->Reach(opposite, UnfoldedFace(this->Surface, side).Across(a, b));
    }
  }

  using Entry = std::pair<double, int>;
  const IntrinsicTriangulation& Surface;
  const Fans Around;
  std::vector<Path> Paths; ///< by vertex, the best so far
  std::vector<int> Visits; ///< how often paths have gone on from the vertex
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> Reached;
};

}

ShortestPaths FindShortestPaths(const IntrinsicTriangulation& surface, int from, const ExecutionContext& context)
{
  Wavefront front(surface);
  front.Run(from, context);
  const int size = surface.NumberOfVertices();
  ShortestPaths paths{ Vector<double>(size), Vector<double>(size) };
  for (int vertex = 0; vertex < size; ++vertex)
  {
    paths.Lengths[vertex] = front.Result()[vertex].Length;
    paths.Directions[vertex] = front.Result()[vertex].Direction;
  }
  return paths;
}

}
