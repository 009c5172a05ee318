#ifndef dmgFineEdgePaths_h
#define dmgFineEdgePaths_h

#include "Hierarchy/MeshHierarchy.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace dmg
{

/// The pieces into which the edges of the coarse mesh cut the edges of the fine one. All operators
/// on edges and faces are sums over them.
///
/// A coarse face that no piece enters, or pieces in one direction only, would leave the fine level
/// blind for its field or for one component of it, and systems singular (the failures of the
/// thesis's table 7.9). Such faces are few; each gets a detour: a piece p -> q in a neighbour runs
/// p
/// -> a -> b -> q instead, with a -> b along the side between the two, inside the face. Its ends
/// stay and so does its homotopy class, hence whatever the operators keep along any path they keep
/// along this one. The edge's one value cannot show two faces: where the neighbour needed it, the
/// neighbour gets a detour from a third face, and so on until one can spare an edge.
class FineEdgePaths
{
public:
  /// Cost: O(#E). \param transition must stay.
  explicit FineEdgePaths(
    const LevelTransition& transition, const ExecutionContext& context = SerialContext());

  const TriangleMesh& Fine() const { return this->Transition.Fine; }
  const TriangleMesh& Coarse() const { return this->Transition.Coarse; }

  /// Calls visit(coarseFace, from, to) for the pieces of a fine halfedge, in its direction, with
  /// barycentric coordinates in the order of the coarse face's corners. A halfedge that runs along
  /// a coarse edge is one piece, in the coarse face on its own side; on the boundary, in the only
  /// one. Pieces come in the order of the edge's orientation, also for the halfedge against it.
  template <class Visit>
  void VisitPieces(int fineHalfedge, Visit visit) const
  {
    const TriangleMesh& fine = this->Transition.Fine;
    this->VisitPieces(fine.EdgeOf(fineHalfedge), fine.EdgeSign(fineHalfedge) > 0, visit);
  }

  /// How many pieces make a detour.
  int NumberOfDetours() const { return this->Detours; }

private:
  struct Piece
  {
    int Face;
    std::array<double, 3> From;
    std::array<double, 3> To;
  };
  /// The pieces of a fine edge with detours, seen by its halfedge along and the one against it.
  struct BentEdge
  {
    std::array<std::vector<Piece>, 2> Pieces;
    bool IsOnePath; // else the halfedges run on different sides of a coarse edge
    int ReservedFor; // the coarse face that the edge shows; its one value cannot show another
  };
  /// A piece that could make a detour, and between which places of the twin of a side.
  struct Candidate
  {
    int Edge = -1;
    bool Forward = true;
    int PieceNumber = 0;
    int Side = -1;
    double From = 0.0;
    double To = 0.0;
  };

  struct Coverage;

  static constexpr int OnPath = -1;
  static int FromBent(int number) { return -2 - number; }

  template <class Visit>
  void VisitPieces(int edge, bool forward, Visit visit) const
  {
    if (this->AlongHalfedge[edge] >= 0)
    {
      int h = this->AlongHalfedge[edge];
      const bool sameDirection = this->RunsForward[edge] == forward;
      bool reversed = !sameDirection;
      if (reversed && this->Transition.Coarse.Twin(h) >= 0)
      {
        h = this->Transition.Coarse.Twin(h);
        reversed = false;
      }
      std::array<double, 3> from{ 0.0, 0.0, 0.0 };
      std::array<double, 3> to{ 0.0, 0.0, 0.0 };
      from[(h + (reversed ? 1 : 0)) % 3] = 1.0;
      to[(h + (reversed ? 0 : 1)) % 3] = 1.0;
      visit(TriangleMesh::FaceOf(h), from, to);
      return;
    }
    if (this->AlongHalfedge[edge] != OnPath)
    {
      const BentEdge& bent = this->BentEdges[FromBent(this->AlongHalfedge[edge])];
      for (const Piece& piece : bent.Pieces[forward ? 0 : 1])
      {
        visit(piece.Face, piece.From, piece.To);
      }
      return;
    }
    this->Transition.Tracking.VisitPath(
      edge, [this](int slot) { return this->SlotTails[slot]; },
      [&](int slot, const std::array<double, 3>& from, const std::array<double, 3>& to)
      {
        const int face = this->Transition.CoarseFace[slot];
        forward ? visit(face, from, to) : visit(face, to, from);
      });
  }

  /// Calls visit(edge, forward, pieceNumber, from, to) for all pieces in a coarse face, of every
  /// halfedge that exists.
  template <class Visit>
  void VisitPiecesIn(int coarseFace, Visit visit) const;

  std::vector<int> FindWeakFaces(const ExecutionContext& context) const;
  Coverage CoverageOf(int coarseFace, int withoutEdge = -1) const;
  bool Cover(int coarseFace, std::vector<int>& robbed);
  Candidate BestCandidate(int coarseFace, const Vector2& missing) const;
  void Bend(const Candidate& candidate);
  BentEdge& MakeBent(int edge);
  int ReservedFor(int edge) const
  {
    return this->AlongHalfedge[edge] >= OnPath
      ? -1
      : this->BentEdges[FromBent(this->AlongHalfedge[edge])].ReservedFor;
  }

  const LevelTransition& Transition;
  std::vector<int> AlongHalfedge; // per fine edge: a coarse halfedge, OnPath, or FromBent(number)
  std::vector<bool> RunsForward; // whether that halfedge runs along the edge's orientation
  std::vector<int> SlotTails; // per halfedge slot: the fine vertex at its tail, if unmoved
  std::vector<int> SlotOfFace; // per coarse face
  std::vector<BentEdge> BentEdges;
  std::unordered_map<int, std::vector<int>>
    DetoursIn; // per coarse face: edges that detours lead here
  int Detours = 0;
};

}

#endif
