#ifndef dmgFineEdgePaths_h
#define dmgFineEdgePaths_h

#include "StructurePreserving/Decimation/MeshHierarchy.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace dmg
{

/// The pieces into which the edges of the coarse mesh cut the edges of the fine one. All operators
/// on edges and faces are sums over them.
///
/// Every coarse face is seen by some, in all directions: where the tracked paths leave one hidden,
/// some are bent through it (PathDetours.h).
class FineEdgePaths
{
public:
  /// Cost: O(#E). \param transition must stay.
  explicit FineEdgePaths(const LevelTransition& transition, const ExecutionContext& context = SerialContext());

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

  /// Calls visit(from, to) for the pieces in a coarse face as they were tracked, whatever was bent
  /// since, one for both halfedges of an edge, until it returns false.
  template <class Visit>
  void VisitTrackedPiecesIn(int coarseFace, Visit visit) const
  {
    const int slot = this->SlotOfFace[coarseFace];
    for (int k = 0; k < 3; ++k)
    {
      if (this->Transition.Tracking.FineEdgeAlong(3 * slot + k) >= 0 && !visit(Corner(k), Corner((k + 1) % 3)))
      {
        return;
      }
    }
    this->Transition.Tracking.VisitPiecesIn(
      slot, [this](int slotHalfedge) { return this->SlotTails[slotHalfedge]; },
      [&visit](int, const std::array<double, 3>& from, const std::array<double, 3>& to) { return visit(from, to); });
  }

  /// A piece in some coarse face, and whose it is.
  struct PieceOfEdge
  {
    int Edge;
    bool Forward; ///< of the halfedge along the edge, else of the one against it
    int Number;   ///< in the order of VisitPieces
    std::array<double, 3> From;
    std::array<double, 3> To;
  };

  /// All pieces in a coarse face, of every halfedge that exists; edges ascending.
  std::vector<PieceOfEdge> PiecesIn(int coarseFace) const;

  /// Bends a piece p -> q: it runs p -> a -> b -> q instead, with a -> b inside the face of \p
  /// side, along that side. Its ends stay, and so does its homotopy class. Where both halfedges of
  /// the edge are one path, both take the detour.
  /// \param side a coarse halfedge, whose twin is in the face of the piece.
  /// \param a, b places on the twin, from 0 at its tail to 1 at its head.
  void Bend(const PieceOfEdge& piece, int side, double a, double b);

  /// The number of pieces that were bent.
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
  };

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
      visit(TriangleMesh::FaceOf(h), Corner((h + (reversed ? 1 : 0)) % 3), Corner((h + (reversed ? 0 : 1)) % 3));
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

  BentEdge& MakeBent(int edge);

  static std::array<double, 3> Corner(int k)
  {
    std::array<double, 3> weights{ 0.0, 0.0, 0.0 };
    weights[k] = 1.0;
    return weights;
  }

  const LevelTransition& Transition;
  std::vector<int> AlongHalfedge; // per fine edge: a coarse halfedge, OnPath, or FromBent(number)
  std::vector<bool> RunsForward;  // whether that halfedge runs along the edge's orientation
  std::vector<int> SlotTails;     // per halfedge slot: the fine vertex at its tail, if unmoved
  std::vector<int> SlotOfFace;    // per coarse face
  std::vector<BentEdge> BentEdges;
  std::unordered_map<int, std::vector<int>> BentInto; // per coarse face: edges
  int Detours = 0;
};

}

#endif
