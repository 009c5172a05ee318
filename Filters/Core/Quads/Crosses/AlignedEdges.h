#ifndef dmgAlignedEdges_h
#define dmgAlignedEdges_h

#include "Constraints/Constraints.h"
#include "Mesh/FramedMesh.h"
#include "Quads/Crosses/CrossField.h"

#include <vector>

namespace dmg
{

/// The boundary, sharp edges and borders of regions that shall become edges of quads.
struct AlignmentOptions
{
  bool AlignBoundary = true;   ///< whether the boundary becomes edges of quads
  bool AlignSharpEdges = true; ///< whether sharp edges become edges of quads
  /// A number for each face, the same in all of a region: edges between regions become edges of quads. Empty: there are no regions.
  std::vector<int> Regions = {};
  double FeatureAngle = 30.0; ///< degrees between the normals of two faces; edges with more are sharp
  /// Lines of sharp edges that are shorter are not followed; relative to the diagonal of the box around the surface.
  double ShortestFeature = 0.1;
  /// Parts of these lines between two ends, branches or bends that are shorter are noise; relative to that diagonal.
  double ShortestPart = 0.02;
  /// Sharp edges at a larger angle to the field, in degrees, are not followed.
  double LargestDeviation = 25.0;
};

/// Directions along the sharp lines that are no noise, on both of their faces, for the field that quads shall follow.
/// \param weight as FeatureOptions::SharpEdgesWeight.
std::vector<Constraint> AlongSharpLines(const FramedMesh& surface, const AlignmentOptions& options, double weight);

/// Directions along the borders of regions, on both of their faces.
std::vector<Constraint> AlongBorders(const FramedMesh& surface, const AlignmentOptions& options, double weight);

/// The edges that shall become lines of edges of quads, as a flag per edge: those of the boundary, of borders and of sharp lines, as the options say.
/// Sharp edges that no direction of the field follows on both of their faces are left out.
std::vector<char> FindAlignedEdges(
  const FramedMesh& surface, const SurfaceAngles& angles, const CrossField& field, const AlignmentOptions& options);

/// The halfedges on an aligned boundary, and one of each edge between regions, at a larger angle to the field than AlignmentOptions::LargestDeviation.
std::vector<int> LinesAgainstField(
  const TriangleMesh& mesh, const SurfaceAngles& angles, const CrossField& field, const AlignmentOptions& options);

/// Whether an edge runs along directions 0 and 2 of the face of its halfedge, rather than along 1 and 3.
bool RunsAlongU(const SurfaceAngles& angles, const CrossField& field, int halfedge);

}

#endif
