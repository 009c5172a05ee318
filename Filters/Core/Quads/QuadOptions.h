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

  int SmoothingSteps = 6; ///< of the vertices along the surface, >= 0
};

}

#endif
