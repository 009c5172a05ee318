#include "Prolongation/FineEdgePaths.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// The least share of a piece in every direction, squared, that a face must hold. With the face
/// drawn as an equilateral triangle with sides of length sqrt 2, one piece along a side counts 2.
constexpr double SmallestCoverage = 1e-4;

/// A detour of less than this share of the side would leave the face weak.
constexpr double SmallestDetour = 0.02;

/// A piece with its face drawn equilateral, so that no shape of the face counts as lack of cover.
Vector2 InEquilateral(const std::array<double, 3>& from, const std::array<double, 3>& to)
{
  const double d0 = to[0] - from[0];
  const double d1 = to[1] - from[1];
  const double d2 = to[2] - from[2];
  return { (d0 - d1) / std::sqrt(2.0), (d0 + d1 - 2.0 * d2) / std::sqrt(6.0) };
}

/// The side k of any face, from its corner k to the next.
Vector2 SideInEquilateral(int k)
{
  std::array<double, 3> from{ 0.0, 0.0, 0.0 };
  std::array<double, 3> to{ 0.0, 0.0, 0.0 };
  from[k] = 1.0;
  to[(k + 1) % 3] = 1.0;
  return InEquilateral(from, to);
}

/// A place on a halfedge.
std::array<double, 3> OnHalfedge(int halfedge, double fraction)
{
  std::array<double, 3> weights{ 0.0, 0.0, 0.0 };
  weights[halfedge % 3] = 1.0 - fraction;
  weights[(halfedge + 1) % 3] = fraction;
  return weights;
}

/// The foot of a place of an equilateral face on one of its halfedges, in [0, 1].
double FootOnHalfedge(int halfedge, const std::array<double, 3>& place)
{
  return place[(halfedge + 1) % 3] + 0.5 * place[(halfedge + 2) % 3];
}

}

/// Sum of p p^T over pieces: in which directions a face is seen.
struct FineEdgePaths::Coverage
{
  double XX = 0.0;
  double XY = 0.0;
  double YY = 0.0;

  void Add(const Vector2& p)
  {
    this->XX += p[0] * p[0];
    this->XY += p[0] * p[1];
    this->YY += p[1] * p[1];
  }
  bool IsWeak() const
  {
    return 0.5 * (this->XX + this->YY) - std::hypot(0.5 * (this->XX - this->YY), this->XY) <
      SmallestCoverage;
  }
  /// The direction that is seen least.
  Vector2 Missing() const
  {
    const double angle = 0.5 * std::atan2(2.0 * this->XY, this->XX - this->YY); // seen most
    return { -std::sin(angle), std::cos(angle) };
  }
};

FineEdgePaths::FineEdgePaths(const LevelTransition& transition, const ExecutionContext& context)
  : Transition(transition)
  , AlongHalfedge(transition.Fine.NumberOfEdges(), OnPath)
  , RunsForward(transition.Fine.NumberOfEdges(), true)
  , SlotTails(3 * transition.CoarseFace.size(), -1)
  , SlotOfFace(transition.Coarse.NumberOfFaces())
{
  std::vector<int> slotOfVertex(transition.Coarse.NumberOfVertices());
  for (std::size_t slot = 0; slot < transition.CoarseVertex.size(); ++slot)
  {
    if (transition.CoarseVertex[slot] >= 0)
    {
      slotOfVertex[transition.CoarseVertex[slot]] = static_cast<int>(slot);
    }
  }
  for (std::size_t slot = 0; slot < transition.CoarseFace.size(); ++slot)
  {
    const int face = transition.CoarseFace[slot];
    if (face >= 0)
    {
      this->SlotOfFace[face] = static_cast<int>(slot);
    }
    for (int k = 0; k < 3 && face >= 0; ++k)
    {
      const int slotHalfedge = 3 * static_cast<int>(slot) + k;
      const int halfedge = 3 * face + k;
      const int tail = slotOfVertex[transition.Coarse.Tail(halfedge)];
      const int head = slotOfVertex[transition.Coarse.Head(halfedge)];
      this->SlotTails[slotHalfedge] = tail;
      const int edge = transition.Tracking.FineEdgeAlong(slotHalfedge);
      if (edge >= 0)
      {
        this->AlongHalfedge[edge] = halfedge;
        this->RunsForward[edge] = tail < head;
      }
    }
  }

  // A face may get cover only after a neighbour has got some, and the neighbour may need a new one.
  std::vector<int> weak = this->FindWeakFaces(context);
  int before = -1;
  while (this->Detours > before)
  {
    before = this->Detours;
    std::vector<int> next;
    for (int face : weak)
    {
      if (!this->Cover(face, next))
      {
        next.push_back(face);
      }
    }
    weak = std::move(next);
  }
}

std::vector<int> FineEdgePaths::FindWeakFaces(const ExecutionContext& context) const
{
  constexpr int Grain = 1024;
  const auto isWeak = [this](int face)
  {
    const int slot = this->SlotOfFace[face];
    Coverage coverage;
    for (int k = 0; k < 3; ++k)
    {
      if (this->Transition.Tracking.FineEdgeAlong(3 * slot + k) >= 0)
      {
        coverage.Add(SideInEquilateral(k));
      }
    }
    if (coverage.IsWeak())
    {
      this->Transition.Tracking.VisitPiecesIn(
        slot, [this](int slotHalfedge) { return this->SlotTails[slotHalfedge]; },
        [&](int, const std::array<double, 3>& from, const std::array<double, 3>& to)
        {
          coverage.Add(InEquilateral(from, to));
          return coverage.IsWeak();
        });
    }
    return coverage.IsWeak();
  };
  const int faces = this->Transition.Coarse.NumberOfFaces();
  std::vector<char> flags(faces);
  context.ParallelFor(0, faces, Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        flags[face] = isWeak(face);
      }
    });
  std::vector<int> weak;
  for (int face = 0; face < faces; ++face)
  {
    if (flags[face])
    {
      weak.push_back(face);
    }
  }
  return weak;
}

template <class Visit>
void FineEdgePaths::VisitPiecesIn(int coarseFace, Visit visit) const
{
  const int slot = this->SlotOfFace[coarseFace];
  std::vector<int> edges = this->Transition.Tracking.FineEdgesThrough(slot);
  for (int k = 0; k < 3; ++k)
  {
    const int along = this->Transition.Tracking.FineEdgeAlong(3 * slot + k);
    if (along >= 0)
    {
      edges.push_back(along);
    }
  }
  const auto detours = this->DetoursIn.find(coarseFace);
  if (detours != this->DetoursIn.end())
  {
    edges.insert(edges.end(), detours->second.begin(), detours->second.end());
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  const TriangleMesh& fine = this->Transition.Fine;
  for (int edge : edges)
  {
    const int h = fine.HalfedgeOf(edge);
    for (int halfedge : { h, fine.Twin(h) })
    {
      int number = 0;
      const bool forward = halfedge >= 0 && fine.EdgeSign(halfedge) > 0;
      const auto visitPiece =
        [&](int face, const std::array<double, 3>& from, const std::array<double, 3>& to)
      {
        if (face == coarseFace)
        {
          visit(edge, forward, number, from, to);
        }
        ++number;
      };
      if (halfedge >= 0)
      {
        this->VisitPieces(edge, forward, visitPiece);
      }
    }
  }
}

// What shows the face, of edges that are not reserved for others.
FineEdgePaths::Coverage FineEdgePaths::CoverageOf(int coarseFace, int withoutEdge) const
{
  Coverage coverage;
  this->VisitPiecesIn(coarseFace,
    [&](int edge, bool, int, const std::array<double, 3>& from, const std::array<double, 3>& to)
    {
      const int reserved = this->ReservedFor(edge);
      if (edge != withoutEdge && (reserved < 0 || reserved == coarseFace))
      {
        coverage.Add(InEquilateral(from, to));
      }
    });
  return coverage;
}

// Returns whether the face is covered in all directions now; adds neighbours that no longer are.
bool FineEdgePaths::Cover(int coarseFace, std::vector<int>& robbed)
{
  Coverage coverage = this->CoverageOf(coarseFace);
  while (coverage.IsWeak())
  {
    const Candidate candidate = this->BestCandidate(coarseFace, coverage.Missing());
    if (candidate.Edge < 0)
    {
      return false;
    }
    this->Bend(candidate);
    const int neighbour = TriangleMesh::FaceOf(this->Transition.Coarse.Twin(candidate.Side));
    if (this->CoverageOf(neighbour).IsWeak())
    {
      robbed.push_back(neighbour);
    }
    coverage = this->CoverageOf(coarseFace);
  }
  return true;
}

// The piece in a neighbour whose detour shows most of the missing direction. Edges that the
// neighbour can do without come first.
FineEdgePaths::Candidate FineEdgePaths::BestCandidate(int coarseFace, const Vector2& missing) const
{
  Candidate best;
  double most = 0.0;
  bool bestIsSpare = false;
  for (int k = 0; k < 3; ++k)
  {
    const int side = 3 * coarseFace + k;
    const int twin = this->Transition.Coarse.Twin(side);
    if (twin < 0)
    {
      continue;
    }
    const int neighbour = TriangleMesh::FaceOf(twin);
    const double share = std::abs(SideInEquilateral(k).normalized().dot(missing));
    this->VisitPiecesIn(neighbour,
      [&](int edge, bool forward, int number, const std::array<double, 3>& from,
        const std::array<double, 3>& to)
      {
        const double start = FootOnHalfedge(twin, from);
        const double end = FootOnHalfedge(twin, to);
        const double amount = share * std::abs(end - start);
        if (amount <= SmallestDetour || this->ReservedFor(edge) >= 0)
        {
          return;
        }
        const bool isSpare = !this->CoverageOf(neighbour, edge).IsWeak();
        if (isSpare != bestIsSpare ? isSpare : amount > most)
        {
          most = amount;
          bestIsSpare = isSpare;
          best = { edge, forward, number, side, start, end };
        }
      });
  }
  return best;
}

// Half of the piece's way along the side goes through the face of the side.
void FineEdgePaths::Bend(const Candidate& candidate)
{
  const int face = TriangleMesh::FaceOf(candidate.Side);
  const int twin = this->Transition.Coarse.Twin(candidate.Side);
  const double a = 0.75 * candidate.From + 0.25 * candidate.To;
  const double b = 0.25 * candidate.From + 0.75 * candidate.To;
  const auto replace = [&](std::vector<Piece>& pieces, double first, double second, bool forward)
  {
    // Numbers run along the edge, the pieces of its second halfedge from their end to their start.
    const Piece whole = pieces[candidate.PieceNumber];
    Piece before = whole;
    Piece after = whole;
    Piece inside = { face, OnHalfedge(candidate.Side, 1.0 - first),
      OnHalfedge(candidate.Side, 1.0 - second) };
    before.To = OnHalfedge(twin, first);
    after.From = OnHalfedge(twin, second);
    if (!forward)
    {
      std::swap(before, after);
    }
    const auto place = pieces.begin() + candidate.PieceNumber;
    *place = after;
    pieces.insert(pieces.insert(place, inside), before);
  };
  BentEdge& bent = this->MakeBent(candidate.Edge);
  replace(bent.Pieces[candidate.Forward ? 0 : 1], a, b, candidate.Forward);
  if (bent.IsOnePath)
  {
    replace(bent.Pieces[candidate.Forward ? 1 : 0], b, a, !candidate.Forward);
  }
  bent.ReservedFor = face;
  this->DetoursIn[face].push_back(candidate.Edge);
  ++this->Detours;
}

FineEdgePaths::BentEdge& FineEdgePaths::MakeBent(int edge)
{
  const int present = this->AlongHalfedge[edge];
  if (present >= OnPath)
  {
    BentEdge bent;
    bent.IsOnePath = present == OnPath;
    for (bool forward : { true, false })
    {
      this->VisitPieces(edge, forward,
        [&](int face, const std::array<double, 3>& from, const std::array<double, 3>& to) {
          bent.Pieces[forward ? 0 : 1].push_back({ face, from, to });
        });
    }
    this->AlongHalfedge[edge] = FromBent(static_cast<int>(this->BentEdges.size()));
    this->BentEdges.push_back(std::move(bent));
  }
  return this->BentEdges[FromBent(this->AlongHalfedge[edge])];
}

}
