#include "Prolongation/FineEdgePaths.h"

namespace dmg
{

FineEdgePaths::FineEdgePaths(const LevelTransition& transition)
  : Transition(transition)
  , AlongHalfedge(transition.Fine.NumberOfEdges(), -1)
  , RunsForward(transition.Fine.NumberOfEdges(), true)
  , SlotTails(3 * transition.CoarseFace.size(), -1)
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
}

}
