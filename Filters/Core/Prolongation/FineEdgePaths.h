#ifndef dmgFineEdgePaths_h
#define dmgFineEdgePaths_h

#include "Hierarchy/MeshHierarchy.h"

#include <array>
#include <vector>

namespace dmg
{

/// The pieces into which the edges of the coarse mesh cut the edges of the fine one. All operators
/// on edges and faces are sums over them.
class FineEdgePaths
{
public:
  explicit FineEdgePaths(const LevelTransition& transition);

  /// Calls visit(coarseFace, from, to) for the pieces of a fine halfedge, in its direction, with
  /// barycentric coordinates in the order of the coarse face's corners. A halfedge that runs along a
  /// coarse edge is one piece, in the coarse face on its own side; on the boundary, in the only one.
  /// Pieces come in the order of the edge's orientation, also for the halfedge against it.
  template <class Visit>
  void VisitPieces(int fineHalfedge, Visit visit) const
  {
    const TriangleMesh& fine = this->Transition.Fine;
    const int edge = fine.EdgeOf(fineHalfedge);
    const bool forward = fine.EdgeSign(fineHalfedge) > 0;
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
    this->Transition.Tracking.VisitPath(
      edge, [this](int slot) { return this->SlotTails[slot]; },
      [&](int slot, const std::array<double, 3>& from, const std::array<double, 3>& to) {
        const int face = this->Transition.CoarseFace[slot];
        forward ? visit(face, from, to) : visit(face, to, from);
      });
  }

private:
  const LevelTransition& Transition;
  std::vector<int> AlongHalfedge; // per fine edge: a coarse halfedge, or -1 where there is a path
  std::vector<bool> RunsForward;  // whether that halfedge runs along the edge's orientation
  std::vector<int> SlotTails;     // per halfedge slot: the fine vertex at its tail, if unmoved
};

}

#endif
