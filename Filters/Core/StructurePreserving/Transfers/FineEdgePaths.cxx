#include "StructurePreserving/Transfers/FineEdgePaths.h"

#include "StructurePreserving/Transfers/PathDetours.h"

#include <algorithm>
#include <utility>

namespace dmg
{

namespace
{

/// A place on a halfedge.
std::array<double, 3> WeightsOnHalfedge(int halfedge, double fraction)
{
  std::array<double, 3> weights{ 0.0, 0.0, 0.0 };
  weights[halfedge % 3] = 1.0 - fraction;
  weights[(halfedge + 1) % 3] = fraction;
  return weights;
}

}

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
  MakeDetours(*this, context);
}

std::vector<FineEdgePaths::PieceOfEdge> FineEdgePaths::PiecesIn(int coarseFace) const
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
  const auto bent = this->BentInto.find(coarseFace);
  if (bent != this->BentInto.end())
  {
    edges.insert(edges.end(), bent->second.begin(), bent->second.end());
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  const TriangleMesh& fine = this->Transition.Fine;
  std::vector<PieceOfEdge> pieces;
  for (int edge : edges)
  {
    const int h = fine.HalfedgeOf(edge);
    for (int halfedge : { h, fine.Twin(h) })
    {
      if (halfedge < 0)
      {
        continue;
      }
      const bool forward = fine.EdgeSign(halfedge) > 0;
      int number = 0;
      this->VisitPieces(edge, forward,
        [&](int face, const std::array<double, 3>& from, const std::array<double, 3>& to)
        {
          if (face == coarseFace)
          {
            pieces.push_back({ edge, forward, number, from, to });
          }
          ++number;
        });
    }
  }
  return pieces;
}

void FineEdgePaths::Bend(const PieceOfEdge& piece, int side, double a, double b)
{
  const int face = TriangleMesh::FaceOf(side);
  const int twin = this->Transition.Coarse.Twin(side);
  const auto replace = [&](std::vector<Piece>& pieces, double first, double second, bool forward)
  {
    // Numbers run along the edge, the pieces of its second halfedge from their end to their start.
    const Piece whole = pieces[piece.Number];
    Piece before = whole;
    Piece after = whole;
    Piece inside = { face, WeightsOnHalfedge(side, 1.0 - first), WeightsOnHalfedge(side, 1.0 - second) };
    before.To = WeightsOnHalfedge(twin, first);
    after.From = WeightsOnHalfedge(twin, second);
    if (!forward)
    {
      std::swap(before, after);
    }
    const auto place = pieces.begin() + piece.Number;
    *place = after;
    pieces.insert(pieces.insert(place, inside), before);
  };
  BentEdge& bent = this->MakeBent(piece.Edge);
  replace(bent.Pieces[piece.Forward ? 0 : 1], a, b, piece.Forward);
  if (bent.IsOnePath)
  {
    replace(bent.Pieces[piece.Forward ? 1 : 0], b, a, !piece.Forward);
  }
  this->BentInto[face].push_back(piece.Edge);
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
