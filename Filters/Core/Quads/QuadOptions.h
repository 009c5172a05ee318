#ifndef dmgQuadOptions_h
#define dmgQuadOptions_h

#include "Support/Types.h"

namespace dmg
{

/// The wishes for a quad mesh.
struct QuadOptions
{
  /// The number of quads that is aimed at, > 0. Thin handles, small holes and small components get more where they would be lost.
  double NumberOfQuads = 4000.0;
  /// The length of edges, in the place of the number of quads; 0: by the number.
  double EdgeLength = 0.0;
  /// The length of edges on each face relative to other faces, > 0; empty: the same everywhere.
  Vector<double> Sizes = {};

  bool AlignBoundary = true;   ///< whether the boundary becomes edges of quads
  bool AlignSharpEdges = true; ///< whether sharp edges become edges of quads
  double FeatureAngle = 30.0;  ///< degrees between the normals of two faces; edges with more are sharp
  /// Lines of sharp edges that are shorter are not followed; relative to the diagonal of the box around the surface.
  double ShortestFeature = 0.1;
  /// Sharp edges at a larger angle to the field, in degrees, are not followed.
  double LargestDeviation = 25.0;

  int SmoothingSteps = 6; ///< of the vertices along the surface, >= 0
};

}

#endif
