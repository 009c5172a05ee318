#ifndef dmgQuadOptions_h
#define dmgQuadOptions_h

#include "Quads/Crosses/AlignedEdges.h"
#include "Support/Types.h"

namespace dmg
{

/// The wishes for a quad mesh, with those for the edges that it shall have.
struct QuadOptions : AlignmentOptions
{
  /// The number of quads that is aimed at, > 0. Thin handles, small holes and small components get more where they would be lost.
  double NumberOfQuads = 4000.0;
  /// The length of edges, in the place of the number of quads; 0: by the number.
  double EdgeLength = 0.0;
  /// The length of edges on each face relative to other faces, > 0; empty: the same everywhere.
  Vector<double> Sizes = {};
  /// Edges are shorter where the surface bends, by a part in [0, 1]; 0 is not at all. With 1, they are as long as the radius of the larger curvature
  /// tells, down to about an eighth of those on flat parts (WithSizesAlone). Sharp edges that are aligned do not count.
  double Adaptivity = 0.0;

  int SmoothingSteps = 6; ///< of the vertices along the surface, >= 0
};

}

#endif
