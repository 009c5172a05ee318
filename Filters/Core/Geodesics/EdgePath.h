#ifndef dmgEdgePath_h
#define dmgEdgePath_h

#include "Geodesics/IntrinsicTriangulation.h"
#include "Support/ExecutionContext.h"

#include <utility>
#include <vector>

namespace dmg
{

/// A path along edges of an intrinsic triangulation, from vertex to vertex.
struct EdgePath
{
  /// An edge that the path runs along: the halfedge in its direction, and the other one; -1 where the boundary has none.
  struct Step
  {
    int Along;
    int Against;

    Step Reversed() const { return { this->Against, this->Along }; }
  };
  std::vector<Step> Steps;

  double Length(const IntrinsicTriangulation& surface) const;
};

/// Makes a path locally shortest: at each of its vertices, angles on both sides become at least pi, but for the boundary and held edges.
/// Where an angle is less, edges in it are flipped until the path can take the far side of its triangles (flip-out, Sharp and Crane 2020).
/// Ends stay, and so does the way around holes and handles.
/// \param surface is flipped, so that the path runs along its edges.
/// Cost: real paths take fewer flips than they cross triangles.
/// \throw Cancelled
void MakeShortest(EdgePath& path, IntrinsicTriangulation& surface, const ExecutionContext& context = SerialContext());

}

#endif
