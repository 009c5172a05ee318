#ifndef dmgHalfedgeFans_h
#define dmgHalfedgeFans_h

#include "Geodesics/IntrinsicTriangulation.h"

#include <cstddef>
#include <vector>

namespace dmg
{

/// The halfedges that leave each vertex, in ascending order.
class HalfedgeFans
{
public:
  explicit HalfedgeFans(const IntrinsicTriangulation& surface)
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

}

#endif
