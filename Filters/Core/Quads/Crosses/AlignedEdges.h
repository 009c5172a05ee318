#ifndef dmgAlignedEdges_h
#define dmgAlignedEdges_h

#include "Mesh/FramedMesh.h"
#include "Quads/Crosses/CrossField.h"

#include <vector>

namespace dmg
{

/// The boundary and sharp edges that shall become edges of quads.
struct AlignmentOptions
{
  bool AlignBoundary = true;   ///< whether the boundary becomes edges of quads
  bool AlignSharpEdges = true; ///< whether sharp edges become edges of quads
  double FeatureAngle = 30.0;  ///< degrees between the normals of two faces; edges with more are sharp
  /// Lines of sharp edges that are shorter are not followed; relative to the diagonal of the box around the surface.
  double ShortestFeature = 0.1;
  /// Sharp edges at a larger angle to the field, in degrees, are not followed.
  double LargestDeviation = 25.0;
};

/// The edges that shall become lines of edges of quads, as a flag per edge: those of the boundary and sharp ones, as the options say.
/// Lines of sharp edges that are shorter than AlignmentOptions::ShortestFeature are noise; so are sharp edges that no direction of the field
/// follows on both of their faces.
std::vector<char> FindAlignedEdges(
  const FramedMesh& surface, const SurfaceAngles& angles, const CrossField& field, const AlignmentOptions& options);

/// Whether an edge runs along directions 0 and 2 of the face of its halfedge, rather than along 1 and 3.
bool RunsAlongU(const SurfaceAngles& angles, const CrossField& field, int halfedge);

}

#endif
