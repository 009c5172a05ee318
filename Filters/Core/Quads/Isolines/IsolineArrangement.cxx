#include "Quads/Isolines/IsolineArrangement.h"

#include "Quads/Map/ExactOrder.h"
#include "Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <tuple>

namespace dmg
{

namespace
{

using EdgePoint = IsolineArrangement::EdgePoint;

/// The least half-integer that is larger than a number.
FixedPoint HalfIntegerAbove(FixedPoint number)
{
  const FixedPoint shifted = number + FixedOne / 2;
  return (shifted & ~(FixedOne - 1)) + FixedOne / 2;
}

/// The points of an edge that has coordinate a at its tail and b at its head.
void AddPoints(FixedPoint a, FixedPoint b, int family, std::vector<EdgePoint>& points)
{
  for (FixedPoint level = HalfIntegerAbove(std::min(a, b)); level < std::max(a, b); level += FixedOne)
  {
    points.push_back({ std::llabs(level - a), std::llabs(b - a), level, family });
  }
}

bool IsBefore(const EdgePoint& p, const EdgePoint& q)
{
  const int order = SignOfDifference(p.Numerator, q.Denominator, q.Numerator, p.Denominator);
  return order != 0 ? order < 0 : p.Family < q.Family;
}

/// The seamless transition from the face of a halfedge to that of its twin.
class Transition
{
public:
  Transition(const TriangleMesh& mesh, const CutSurface& cut, const MapOfCorners& map, int halfedge)
    : Turns(cut.Matchings[halfedge])
  {
    const auto& here = map[halfedge];
    const auto& there = map[TriangleMesh::Next(mesh.Twin(halfedge))];
    for (int c = 0; c < 2; ++c)
    {
      const auto [family, level] = this->Turned(c, here[c]);
      this->Shift[family] = there[family] - level;
    }
  }

  /// The isoline beyond the edge: its family and level.
  std::pair<int, FixedPoint> operator()(int family, FixedPoint level) const
  {
    const auto [turned, turnedLevel] = this->Turned(family, level);
    return { turned, turnedLevel + this->Shift[turned] };
  }

private:
  /// Axis 0 to 3 is u, v, -u, -v.
  std::pair<int, FixedPoint> Turned(int family, FixedPoint level) const
  {
    const int axis = (family + this->Turns) % 4;
    return { axis % 2, axis < 2 ? level : -level };
  }

  int Turns;
  std::array<FixedPoint, 2> Shift{ 0, 0 };
};

/// One of the two ends of a piece of an isoline in a face: 2 p + s is edge point p, seen from the face of HalfedgeOf (s = 0) or from the
/// other one (s = 1).
using PieceEnd = int;

/// A piece of an isoline in a face.
struct Piece
{
  std::array<PieceEnd, 2> Ends;
  int FirstCrossing = 0; ///< in the list of crossings along pieces
  int NumberOfCrossings = 0;
};

/// A crossing as it is met along a piece.
struct CrossingOnPiece
{
  int Place; ///< of the other piece's end on the ring: crossings are met in this order
  int Node;
  int Slot; ///< towards the first end of the piece; the opposite one towards the other
};

class Arranger
{
public:
  Arranger(const TriangleMesh& mesh, const CutSurface& cut, const MapOfCorners& map)
    : Mesh(mesh)
    , Cut(cut)
    , Map(map)
  {
  }

  IsolineArrangement Arrange(const ExecutionContext& context)
  {
    this->CrossEdges();
    context.Checkpoint(0.3);
    this->PieceAt.assign(2 * this->Result.Points.size(), -1);
    for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
    {
      this->CrossFace(face);
    }
    context.Checkpoint(0.6);
    this->Result.NumberOfCrossings = static_cast<int>(this->Result.Nodes.size());
    this->EndOnBoundary();
    this->Result.Opposite.assign(this->Result.Nodes.size(), { -1, -1, -1, -1 });
    this->JoinAlongBoundary();
    this->JoinAlongIsolines();
    context.Checkpoint(1.0);
    return std::move(this->Result);
  }

private:
  void CrossEdges()
  {
    this->Result.Offsets.assign(1, 0);
    std::vector<EdgePoint> points;
    for (int edge = 0; edge < this->Mesh.NumberOfEdges(); ++edge)
    {
      const int h = this->Mesh.HalfedgeOf(edge);
      points.clear();
      for (int family = 0; family < 2; ++family)
      {
        AddPoints(this->Map[h][family], this->Map[TriangleMesh::Next(h)][family], family, points);
      }
      std::sort(points.begin(), points.end(), IsBefore);
      this->Result.Points.insert(this->Result.Points.end(), points.begin(), points.end());
      this->Result.Offsets.push_back(static_cast<int>(this->Result.Points.size()));
    }
  }

  /// A place at which an isoline meets the sides of a face.
  struct RingPoint
  {
    int Family;
    FixedPoint Level;
    PieceEnd End;
  };

  /// The points on the sides of a face, counter-clockwise, in its map.
  std::vector<RingPoint> RingOf(int face) const
  {
    std::vector<RingPoint> ring;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const int edge = this->Mesh.EdgeOf(h);
      const int first = this->Result.Offsets[edge], last = this->Result.Offsets[edge + 1];
      if (this->Mesh.HalfedgeOf(edge) == h)
      {
        for (int p = first; p < last; ++p)
        {
          ring.push_back({ this->Result.Points[p].Family, this->Result.Points[p].Level, 2 * p });
        }
      }
      else if (first < last)
      {
        const Transition across(this->Mesh, this->Cut, this->Map, this->Mesh.Twin(h));
        for (int p = last - 1; p >= first; --p)
        {
          const auto [family, level] = across(this->Result.Points[p].Family, this->Result.Points[p].Level);
          ring.push_back({ family, level, 2 * p + 1 });
        }
      }
    }
    return ring;
  }

  /// A piece by the places of its ends on the ring, the smaller first.
  struct RingPiece
  {
    int First, Last, Number;
  };

  /// Pairs the points of a ring: each isoline has two of them, as the map is linear in a face.
  std::array<std::vector<RingPiece>, 2> PairOnRing(const std::vector<RingPoint>& ring)
  {
    std::vector<int> order(ring.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&ring](int k) { return std::make_tuple(ring[k].Family, ring[k].Level, k); };
    std::sort(order.begin(), order.end(), [&key](int a, int b) { return key(a) < key(b); });
    std::array<std::vector<RingPiece>, 2> pieces;
    for (std::size_t k = 0; k + 1 < order.size(); k += 2)
    {
      const RingPoint &a = ring[order[k]], &b = ring[order[k + 1]];
      if (a.Family != b.Family || a.Level != b.Level)
      {
        throw UnexpectedFailure("an isoline of the map has no end");
      }
      const int number = static_cast<int>(this->Pieces.size());
      this->PieceAt[a.End] = 2 * number;
      this->PieceAt[b.End] = 2 * number + 1;
      this->Pieces.push_back({ { a.End, b.End } });
      pieces[a.Family].push_back({ order[k], order[k + 1], number });
    }
    return pieces;
  }

  void CrossFace(int face)
  {
    const std::vector<RingPoint> ring = this->RingOf(face);
    if (ring.empty())
    {
      return;
    }
    const auto pieces = this->PairOnRing(ring);
    std::array<std::vector<std::vector<CrossingOnPiece>>, 2> met;
    met[0].resize(pieces[0].size());
    met[1].resize(pieces[1].size());
    for (std::size_t i = 0; i < pieces[0].size(); ++i)
    {
      for (std::size_t j = 0; j < pieces[1].size(); ++j)
      {
        const RingPiece &u = pieces[0][i], &v = pieces[1][j];
        const bool holdsFirst = u.First < v.First && v.First < u.Last, holdsLast = u.First < v.Last && v.Last < u.Last;
        if (holdsFirst != holdsLast)
        {
          const int node = this->AddCrossing(face, { ring[u.First].Level, ring[v.First].Level });
          met[0][i].push_back({ holdsFirst ? v.First : v.Last, node, 0 });
          met[1][j].push_back({ holdsFirst ? u.Last : u.First, node, holdsFirst ? 1 : 3 });
        }
      }
    }
    this->KeepInOrder(pieces, met);
  }

  void KeepInOrder(
    const std::array<std::vector<RingPiece>, 2>& pieces, std::array<std::vector<std::vector<CrossingOnPiece>>, 2>& met)
  {
    for (int family = 0; family < 2; ++family)
    {
      for (std::size_t k = 0; k < met[family].size(); ++k)
      {
        std::vector<CrossingOnPiece>& crossings = met[family][k];
        std::sort(crossings.begin(), crossings.end(),
          [](const CrossingOnPiece& a, const CrossingOnPiece& b) { return a.Place < b.Place; });
        Piece& piece = this->Pieces[pieces[family][k].Number];
        piece.FirstCrossing = static_cast<int>(this->Crossings.size());
        piece.NumberOfCrossings = static_cast<int>(crossings.size());
        this->Crossings.insert(this->Crossings.end(), crossings.begin(), crossings.end());
      }
    }
  }

  int AddCrossing(int face, const std::array<FixedPoint, 2>& point)
  {
    this->Result.Nodes.push_back({ face, WeightsInFace(this->Map, face, point) });
    return static_cast<int>(this->Result.Nodes.size()) - 1;
  }

  /// Makes a node of each end of an isoline on the boundary.
  void EndOnBoundary()
  {
    this->EndNodes.assign(this->Result.Points.size(), -1);
    for (int edge = 0; edge < this->Mesh.NumberOfEdges(); ++edge)
    {
      const int h = this->Mesh.HalfedgeOf(edge);
      for (int p = this->Result.Offsets[edge]; this->Mesh.Twin(h) < 0 && p < this->Result.Offsets[edge + 1]; ++p)
      {
        const EdgePoint& point = this->Result.Points[p];
        this->EndNodes[p] = static_cast<int>(this->Result.Nodes.size());
        this->Result.Nodes.push_back(
          OnHalfedge(h, static_cast<double>(point.Numerator) / static_cast<double>(point.Denominator)));
      }
    }
  }

  void JoinAlongBoundary()
  {
    std::vector<char> isDone(this->Mesh.NumberOfEdges(), 0);
    for (int first = 0; first < this->Mesh.NumberOfEdges(); ++first)
    {
      const int start = this->Mesh.HalfedgeOf(first);
      if (this->Mesh.Twin(start) >= 0 || isDone[first])
      {
        continue;
      }
      std::vector<int> loop;
      for (int h = start; !isDone[this->Mesh.EdgeOf(h)]; h = this->Mesh.OutgoingHalfedge(this->Mesh.Head(h)))
      {
        const int edge = this->Mesh.EdgeOf(h);
        isDone[edge] = 1;
        for (int p = this->Result.Offsets[edge]; p < this->Result.Offsets[edge + 1]; ++p)
        {
          loop.push_back(this->EndNodes[p]);
        }
      }
      for (std::size_t k = 0; k < loop.size(); ++k)
      {
        const int here = loop[k], next = loop[(k + 1) % loop.size()];
        this->Result.Opposite[here][0] = 4 * next + 2;
        this->Result.Opposite[next][2] = 4 * here;
      }
      this->Result.Loops.push_back(std::move(loop));
      this->Result.LoopHalfedges.push_back(start);
    }
  }

  void JoinAlongIsolines()
  {
    for (int number = 0; number < static_cast<int>(this->Pieces.size()); ++number)
    {
      const Piece& piece = this->Pieces[number];
      for (int k = 0; k < piece.NumberOfCrossings; ++k)
      {
        const CrossingOnPiece& crossing = this->Crossings[piece.FirstCrossing + k];
        this->Walk(4 * crossing.Node + crossing.Slot, number, k, 0);
        this->Walk(4 * crossing.Node + (crossing.Slot + 2) % 4, number, k, 1);
      }
    }
    for (int p = 0; p < static_cast<int>(this->EndNodes.size()); ++p)
    {
      if (this->EndNodes[p] >= 0)
      {
        const int piece = this->PieceAt[2 * p] / 2, towards = 1 - this->PieceAt[2 * p] % 2;
        this->Walk(
          4 * this->EndNodes[p] + 1, piece, towards == 1 ? -1 : this->Pieces[piece].NumberOfCrossings, towards);
      }
    }
  }

  /// Follows the isoline of a dart from crossing k of a piece towards one of its ends, up to the next node.
  void Walk(int dart, int number, int k, int towards)
  {
    while (true)
    {
      const Piece& piece = this->Pieces[number];
      k += towards == 1 ? 1 : -1;
      if (k >= 0 && k < piece.NumberOfCrossings)
      {
        const CrossingOnPiece& crossing = this->Crossings[piece.FirstCrossing + k];
        this->Join(dart, 4 * crossing.Node + (towards == 1 ? crossing.Slot : (crossing.Slot + 2) % 4));
        return;
      }
      const PieceEnd end = piece.Ends[towards];
      EdgePoint& point = this->Result.Points[end / 2];
      point.Dart = dart;
      point.Leaves = end % 2 == 0;
      if (this->EndNodes[end / 2] >= 0)
      {
        this->Join(dart, 4 * this->EndNodes[end / 2] + 1);
        return;
      }
      const int next = this->PieceAt[end ^ 1];
      number = next / 2;
      towards = 1 - next % 2;
      k = towards == 1 ? -1 : this->Pieces[number].NumberOfCrossings;
    }
  }

  void Join(int dart, int opposite) { this->Result.Opposite[dart / 4][dart % 4] = opposite; }

  const TriangleMesh& Mesh;
  const CutSurface& Cut;
  const MapOfCorners& Map;
  std::vector<int> PieceAt; ///< by end: 2 * piece + which of its ends
  std::vector<Piece> Pieces;
  std::vector<CrossingOnPiece> Crossings;
  std::vector<int> EndNodes; ///< by edge point: its node, -1 inside the surface
  IsolineArrangement Result;
};

}

Vector3 WeightsInFace(const MapOfCorners& map, int face, const std::array<FixedPoint, 2>& point)
{
  const auto from = [&map, &point, face](int k)
  {
    const auto& corner = map[3 * face + k];
    return Vector2(static_cast<double>(corner[0] - point[0]), static_cast<double>(corner[1] - point[1]));
  };
  const auto area = [](const Vector2& a, const Vector2& b) { return a[0] * b[1] - a[1] * b[0]; };
  const Vector2 a = from(0), b = from(1), c = from(2);
  const Vector3 areas = (OrientationInMap(map, face) * Vector3(area(b, c), area(c, a), area(a, b))).cwiseMax(0.0);
  return areas.sum() > 0.0 ? Vector3(areas / areas.sum()) : Vector3::Constant(1.0 / 3.0);
}

IsolineArrangement ArrangeIsolines(
  const TriangleMesh& mesh, const CutSurface& cut, const MapOfCorners& map, const ExecutionContext& context)
{
  return Arranger(mesh, cut, map).Arrange(context);
}

}
